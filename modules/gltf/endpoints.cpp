#include "modules/gltf/endpoints.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "modules/gltf/parameters.h"

namespace pssmlt::gltf {
namespace {

constexpr int height = 720;            // of pictures, unless the command line says otherwise
constexpr double most_aspect = 16.0;   // of pictures
constexpr double overview_fov = 40.0;  // degrees, of the camera that sees all
const dvec3 overview_direction(0.6, 0.35, 1.0);  // from what it sees to it

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

const tinygltf::Node& node_of(const Document& d, const PlacedNode& placed) {
  return d.model().nodes[static_cast<size_t>(placed.node)];
}

// Where a node stands and where it looks, without its scales. Camera space is glTF's with z turned:
// it looks along +z here.
dmat4 camera_to_world(const dmat4& m) {
  dvec3 back(m[2]), up(m[1]);
  if (!(glm::length(back) > 0.0)) back = {0.0, 0.0, 1.0};
  back = glm::normalize(back);
  up -= back * glm::dot(up, back);
  if (!(glm::length(up) > 1e-9)) up = std::abs(back.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  up = glm::normalize(up - back * glm::dot(up, back));
  const dvec3 right = glm::cross(up, back);
  dmat4 result(1.0);
  result[0] = {right, 0.0};
  result[1] = {up, 0.0};
  result[2] = {-back, 0.0};
  result[3] = {dvec3(m[3]), 1.0};
  return result;
}

struct View {
  std::string type;
  ParameterSet parameters;
  double aspect = 16.0 / 9.0;
};

double sensible(double aspect) {
  return aspect > 0.0 && std::isfinite(aspect) ? std::clamp(aspect, 1.0 / most_aspect, most_aspect)
                                               : 16.0 / 9.0;
}

View perspective(const Document& d, const tinygltf::PerspectiveCamera& camera,
                 const std::string& pointer) {
  View view{"perspective", {}, sensible(camera.aspectRatio)};
  if (!(camera.yfov > 0.0 && camera.yfov < std::numbers::pi))
    d.fail(pointer + ".perspective", "yfov must lie between 0 and pi");
  // The angle of view is that of the shorter side.
  double half = std::tan(0.5 * camera.yfov);
  if (view.aspect < 1.0) half *= view.aspect;
  view.parameters =
      ParameterWriter(d.at(pointer)).number("fov", degrees(2.0 * std::atan(half))).take();
  return view;
}

View orthographic(const Document& d, const tinygltf::OrthographicCamera& camera,
                  const std::string& pointer) {
  const auto x = static_cast<float>(camera.xmag), y = static_cast<float>(camera.ymag);
  if (!(x != 0.f && y != 0.f && std::isfinite(x) && std::isfinite(y)))
    d.fail(pointer + ".orthographic", "xmag and ymag must not be 0");
  View view{"orthographic", {}, sensible(std::abs(camera.xmag / camera.ymag))};
  view.parameters = ParameterWriter(d.at(pointer))
                        .floats(ParameterType::Float, "screenwindow", {-x, x, -y, y})
                        .take();
  return view;
}

void declare(const Document& d, const ImportTarget& target, View view, const dmat4& to_world,
             const Location& where) {
  const int width = std::max(1, static_cast<int>(std::lround(height * view.aspect)));
  const std::string stem = std::filesystem::path(d.path()).stem().string();
  target.state.film("rgb",
                    ParameterWriter(where)
                        .integer("xresolution", width)
                        .integer("yresolution", height)
                        .text("filename", stem + ".exr")
                        .take(),
                    where);
  target.state.replace(glm::inverse(to_world), where);
  target.state.camera(view.type, std::move(view.parameters), where);
}

void declare_overview(const Document& d, const ImportTarget& target, const Bounds& bounds) {
  const bool empty = !(bounds.min.x <= bounds.max.x);
  const dvec3 low(empty ? vec3(-1.f) : bounds.min), high(empty ? vec3(1.f) : bounds.max);
  const dvec3 center = 0.5 * (low + high);
  double radius = 0.5 * glm::length(high - low);
  if (!(radius > 0.0)) radius = 1.0;
  dmat4 place(1.0);
  const dvec3 back = glm::normalize(overview_direction);
  const double half = 0.5 * overview_fov * std::numbers::pi / 180.0;
  place[2] = {back, 0.0};
  place[3] = {center + back * (1.02 * radius / std::sin(half)), 1.0};
  const Location where = d.at("the camera that sees all");
  View view{"perspective", ParameterWriter(where).number("fov", overview_fov).take()};
  declare(d, target, std::move(view), camera_to_world(place), where);
  target.log.push_back(d.path() + ": there is no camera: one that sees everything is used");
}

constexpr const char* punctual = "KHR_lights_punctual";

void declare_light(const Document& d, const ImportTarget& target, const tinygltf::Light& light,
                   const std::string& pointer) {
  const Location where = d.at(pointer);
  const vec3 color = light.color.size() == 3
                         ? vec3(dvec3(light.color[0], light.color[1], light.color[2]))
                         : vec3(1.f);
  ParameterWriter out(where);
  out.number("scale", light.intensity);
  if (light.type == "directional") {
    out.rgb("L", color).point("from", vec3(0.f)).point("to", {0.f, 0.f, -1.f});
    return target.state.light("distant", out.take(), where);
  }
  out.rgb("I", color);
  if (light.type == "point") return target.state.light("point", out.take(), where);
  if (light.type != "spot") d.fail(pointer, "has the unknown type \"" + light.type + "\"");
  const double outer = light.spot.outerConeAngle, inner = light.spot.innerConeAngle;
  if (!(inner >= 0.0 && inner < outer && outer <= 0.5 * std::numbers::pi + 1e-6))
    d.fail(pointer + ".spot", "0 <= innerConeAngle < outerConeAngle <= pi / 2 is needed");
  out.number("coneangle", degrees(outer)).number("conedeltaangle", degrees(outer - inner));
  out.point("from", vec3(0.f)).point("to", {0.f, 0.f, -1.f});
  target.state.light("spot", out.take(), where);
}

}  // namespace

std::vector<std::string> camera_names(const Document& d, const std::vector<PlacedNode>& nodes) {
  std::vector<std::string> names;
  for (const PlacedNode& placed : nodes) {
    const int index = node_of(d, placed).camera;
    if (index < 0 || placed.copy) continue;
    const std::string pointer = element("nodes", placed.node);
    const std::string& name = d.get(d.model().cameras, index, "cameras", pointer).name;
    names.push_back(pointer + (name.empty() ? "" : " \"" + name + "\""));
  }
  return names;
}

void declare_camera(const Document& d, const ImportTarget& target,
                    const std::vector<PlacedNode>& nodes, const Bounds& bounds) {
  const auto found = std::ranges::find_if(
      nodes, [&](const PlacedNode& placed) { return node_of(d, placed).camera >= 0; });
  if (found == nodes.end()) return declare_overview(d, target, bounds);
  const int index = node_of(d, *found).camera;
  const std::string pointer = element("cameras", index);
  const tinygltf::Camera& camera =
      d.get(d.model().cameras, index, "cameras", element("nodes", found->node));
  View view = camera.type == "orthographic" ? orthographic(d, camera.orthographic, pointer)
                                            : perspective(d, camera.perspective, pointer);
  const dmat4 to_world = camera_to_world(found->world);
  if (!Transform::is_invertible(to_world))
    d.fail(element("nodes", found->node), "places its camera nowhere");
  declare(d, target, std::move(view), to_world, d.at(pointer));
  std::vector<std::string> names = camera_names(d, nodes);
  if (names.size() < 2) return;
  std::string others;
  for (size_t i = 1; i < names.size(); ++i) others += (i > 1 ? ", " : "") + names[i];
  target.log.push_back(d.path() + ": the first camera is used; there are others: " + others);
}

int declare_lights(const Document& d, const ImportTarget& target,
                   const std::vector<PlacedNode>& nodes) {
  int count = 0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Value* const v = extension(node_of(d, placed).extensions, punctual);
    if (!v || placed.copy) continue;
    const int index = integer(*v, "light", -1);
    const tinygltf::Light& light =
        d.get(d.model().lights, index, "lights", element("nodes", placed.node));
    // Scales do not change a light; what a scale of 0 makes singular could not be placed.
    const dmat4 place =
        camera_to_world(placed.world) * dmat4(Transform::scale({1, 1, -1}).matrix());
    const Location where = d.at(element("nodes", placed.node));
    if (!Transform::is_invertible(place)) throw Error(where, "places its light nowhere");
    target.state.push(SceneState::Nested::Attribute, where);
    target.state.concatenate(place, where);
    declare_light(d, target, light, element("extensions.KHR_lights_punctual.lights", index));
    target.state.pop(SceneState::Nested::Attribute, where);
    ++count;
  }
  return count;
}

}  // namespace pssmlt::gltf
