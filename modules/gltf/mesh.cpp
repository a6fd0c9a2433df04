#include "modules/gltf/mesh.h"

#include <glm/matrix.hpp>

#include "modules/gltf/attributes.h"
#include "modules/gltf/parameters.h"

namespace pssmlt::gltf {
namespace {

// Sequential vertices of a strip or fan as triangles; their sides alternate in strips.
std::vector<int> triangles(const std::vector<uint32_t>& order, int mode) {
  std::vector<int> result;
  const auto add = [&](size_t a, size_t b, size_t c) {
    for (const size_t i : {a, b, c}) result.push_back(static_cast<int>(order[i]));
  };
  const size_t n = order.size();
  result.reserve(mode == TINYGLTF_MODE_TRIANGLES ? n : 3 * n);
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (size_t i = 0; i + 3 <= n; i += 3) add(i, i + 1, i + 2);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (size_t i = 1; i + 2 <= n; ++i) add(0, i, i + 1);
  } else {
    for (size_t i = 0; i + 3 <= n; ++i) i % 2 == 0 ? add(i, i + 1, i + 2) : add(i, i + 2, i + 1);
  }
  return result;
}

vec3 at(const std::vector<float>& values, size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}
void put(std::vector<float>& values, size_t i, const dvec3& v) {
  for (int c = 0; c < 3; ++c) values[3 * i + static_cast<size_t>(c)] = static_cast<float>(v[c]);
}

// Adds the weighted differences of one attribute's morph targets.
void morph(const Attributes& from, const tinygltf::Primitive& primitive, const char* name,
           const std::vector<double>& weights, std::vector<float>& values) {
  for (size_t t = 0; t < primitive.targets.size() && t < weights.size(); ++t) {
    const auto target = primitive.targets[t].find(name);
    if (weights[t] == 0.0 || target == primitive.targets[t].end()) continue;
    const std::vector<float> difference = from.target(target->second, name);
    const auto weight = static_cast<float>(weights[t]);
    for (size_t i = 0; i < values.size(); ++i) values[i] += weight * difference[i];
  }
}

// The first three of every four numbers.
std::vector<float> without_last(const std::vector<float>& four) {
  std::vector<float> three;
  three.reserve(four.size() / 4 * 3);
  for (size_t i = 0; i < four.size(); ++i)
    if (i % 4 != 3) three.push_back(four[i]);
  return three;
}

class Skinner {
 public:
  Skinner(const Document& document, const Attributes& from, const std::vector<dmat4>& joints,
          const std::string& pointer)
      : joints_(joints) {
    for (int set = 0; from.has("JOINTS_" + std::to_string(set)); ++set) {
      const std::string number = std::to_string(set);
      if (!from.has("WEIGHTS_" + number))
        document.fail(pointer + ".attributes",
                      "has JOINTS_" + number + " without WEIGHTS_" + number);
      indices_.push_back(from.floats("JOINTS_" + number, 4));
      weights_.push_back(from.floats("WEIGHTS_" + number, 4));
      for (const float joint : indices_.back())
        if (!(joint >= 0.f && joint < static_cast<float>(joints.size())))
          document.fail(pointer + ".attributes.JOINTS_" + number, "a joint is out of range");
    }
  }
  // Of a vertex, to the world. Without any weight it stays where it is.
  dmat4 matrix(size_t vertex) const {
    dmat4 sum(0.0);
    double total = 0.0;
    for (size_t set = 0; set < indices_.size(); ++set) {
      for (size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
        const auto weight = static_cast<double>(weights_[set][k]);
        if (weight != 0.0) sum += weight * joints_[static_cast<size_t>(indices_[set][k])];
        total += weight;
      }
    }
    return total > 0.0 ? sum / total : dmat4(1.0);
  }

 private:
  const std::vector<dmat4>& joints_;
  std::vector<std::vector<float>> indices_, weights_;
};

struct Vertices {
  std::vector<float> positions, normals, tangents;
};

void skin(const Skinner& skinner, Vertices& v) {
  for (size_t i = 0; i < v.positions.size() / 3; ++i) {
    const dmat4 m = skinner.matrix(i);
    put(v.positions, i, dvec3(m * glm::dvec4(dvec3(at(v.positions, i)), 1.0)));
    const glm::dmat3 linear(m);
    if (!v.tangents.empty()) put(v.tangents, i, linear * dvec3(at(v.tangents, i)));
    if (v.normals.empty()) continue;
    // The cofactors: the inverse transpose but for a factor, of singular matrices as well.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const dvec3 n = cofactors * dvec3(at(v.normals, i));
    const double length = glm::length(n);
    put(v.normals, i, length > 0.0 ? n / length : dvec3(0.0));
  }
}

Vertices read_vertices(const Document& document, const Attributes& from,
                       const tinygltf::Primitive& primitive, const MeshNeeds& needs,
                       const Pose& pose, const std::string& pointer) {
  Vertices v;
  v.positions = from.floats("POSITION", 3);
  morph(from, primitive, "POSITION", pose.weights, v.positions);
  if (from.has("NORMAL")) {
    v.normals = from.floats("NORMAL", 3);
    morph(from, primitive, "NORMAL", pose.weights, v.normals);
  }
  if (needs.tangents && from.has("TANGENT")) {
    v.tangents = without_last(from.floats("TANGENT", 4));
    morph(from, primitive, "TANGENT", pose.weights, v.tangents);
  }
  if (!pose.joints.empty()) skin(Skinner(document, from, pose.joints, pointer), v);
  return v;
}

// Images begin at the top in glTF: v is turned over to grow upward.
void write_uvs(const Attributes& from, int set, const char* parameter, ParameterWriter& out) {
  const std::string name = "TEXCOORD_" + std::to_string(set);
  if (!from.has(name)) return;
  std::vector<float> uvs = from.floats(name, 2);
  for (size_t i = 1; i < uvs.size(); i += 2) uvs[i] = 1.f - uvs[i];
  out.floats(ParameterType::Point2, parameter, std::move(uvs));
}

void write_colors(const Attributes& from, ParameterWriter& out) {
  const int components = from.components("COLOR_0");
  std::vector<float> colors = from.floats("COLOR_0", components == 4 ? 4 : 3);
  if (components == 4) {
    std::vector<float> opacities;
    for (size_t i = 3; i < colors.size(); i += 4) opacities.push_back(colors[i]);
    colors = without_last(colors);
    out.floats(ParameterType::Float, "coloralpha", std::move(opacities));
  }
  out.floats(ParameterType::Rgb, "color", std::move(colors));
}

}  // namespace

std::string primitive_pointer(int mesh, size_t primitive) {
  return element("meshes", mesh) + "." + element("primitives", static_cast<int>(primitive));
}

std::optional<MeshPiece> read_primitive(const Document& document, int mesh, size_t index,
                                        const MeshNeeds& needs, const Pose& pose) {
  const tinygltf::Primitive& primitive =
      document.model().meshes[static_cast<size_t>(mesh)].primitives[index];
  const std::string pointer = primitive_pointer(mesh, index);
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  if (mode > TINYGLTF_MODE_TRIANGLE_FAN) document.fail(pointer, "has an unknown mode");
  if (mode < TINYGLTF_MODE_TRIANGLES) return std::nullopt;
  const Attributes from(document, primitive, pointer);
  if (!from.has("POSITION") || from.vertices() == 0) return std::nullopt;
  std::vector<int> order = triangles(from.indices(), mode);
  if (order.empty()) return std::nullopt;

  Vertices v = read_vertices(document, from, primitive, needs, pose, pointer);
  MeshPiece piece;
  for (size_t i = 0; i < from.vertices(); ++i) piece.bounds.add(at(v.positions, i));
  ParameterWriter out(document.at(pointer));
  out.integers("indices", std::move(order));
  out.floats(ParameterType::Point3, "P", std::move(v.positions));
  if (!v.normals.empty()) out.floats(ParameterType::Normal, "N", std::move(v.normals));
  if (!v.tangents.empty()) out.floats(ParameterType::Vector3, "S", std::move(v.tangents));
  write_uvs(from, needs.uv_sets[0], "uv", out);
  write_uvs(from, needs.uv_sets[1], "uv1", out);
  if (needs.colors && from.has("COLOR_0")) write_colors(from, out);
  piece.parameters = out.take();
  return piece;
}

}  // namespace pssmlt::gltf
