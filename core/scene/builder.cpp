#include "core/scene/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/color/color_warnings.h"
#include "core/path/path_expression.h"
#include "core/plugin/registry.h"
#include "core/scene/accel.h"
#include "core/scene/builder_film.h"
#include "core/scene/builder_layers.h"
#include "core/scene/builder_resolver.h"

namespace pssmlt {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void refuse_animation(const TransformPair& transform, const Location& where) {
  if (transform.animated()) throw Error(where, "motion blur is not supported yet");
}

}  // namespace

// Fills a Scene step by step. World space is moved so that the camera's centre is the origin of
// render space: float's resolution is best where the picture looks.
class SceneBuilder {
 public:
  SceneBuilder(const SceneDescription& description, const BuildOptions& options)
      : description_(description),
        options_(options),
        to_render_(find_to_render()),
        resolver_(description, to_render_, options.defaults.material),
        scene_(std::make_unique<Scene>()) {}

  BuiltScene build();

 private:
  Transform find_to_render() const;
  void check_supported() const;
  void read_options();
  void build_raster();
  void build_camera();
  void build_lights();
  void build_shapes();
  static void refuse_beyond_reach(const Shape& shape, const Location& where);
  void check_reach();
  std::vector<const Primitive*> build_object(const ObjectDescription& object);
  std::unique_ptr<Primitive> build_primitive(const ShapeDescription& shape, const Transform& space);
  void attach_area_light(const ShapeDescription& shape, const Transform& space,
                         Primitive& primitive);
  void add_light(std::shared_ptr<Light> light);
  void count(const Primitive& primitive);
  void finish_lights();
  void finish_features();

  const SceneDescription& description_;
  const BuildOptions& options_;
  Transform to_render_;
  BuildResolver resolver_;
  std::unique_ptr<Scene> scene_;
  BuiltScene built_;
};

Transform SceneBuilder::find_to_render() const {
  const Transform& camera_from_world = description_.camera.transform.start;
  return Transform::translate(-camera_from_world.inverse().point(dvec3(0.0)));
}

void SceneBuilder::check_supported() const {
  refuse_animation(description_.camera.transform, description_.camera.where);
  for (const MediumDescription& m : description_.media) {
    throw Error(m.where, "medium \"" + m.type + "\" is not supported yet");
  }
}

void SceneBuilder::read_options() {
  for (const Parameter& p : description_.options) {
    if (p.name == "seed" && p.type == ParameterType::Integer && !p.ints.empty()) {
      built_.seed = static_cast<uint64_t>(p.ints[0]);
    } else {
      built_.log.push_back("option \"" + p.name + "\" has no effect here");
    }
  }
  if (description_.accelerator.given()) {
    built_.log.push_back("accelerator \"" + description_.accelerator.type +
                         "\" is not used: Embree builds the acceleration structure");
  }
}

void SceneBuilder::build_raster() {
  FilmDirective film = read_film(description_, options_, built_.log);
  Directive filter = description_.filter;
  if (filter.type.empty()) filter.type = options_.defaults.filter;
  const FoundPlugin found = Registry::instance().find("filter", filter.type, filter.where);
  Parameters parameters(filter.parameters, filter.where, owner_name("filter", filter.type),
                        &resolver_);
  const auto made = make_plugin<Filter>(found, parameters);
  film.frame.filter_radius = made->radius();
  scene_->frame_ = film.frame;
  built_.raster_map = std::make_shared<const RasterMap>(film.frame, made);
  built_.output = film.output;
  built_.max_component = film.max_component;
  built_.exposure = film.exposure;
}

void SceneBuilder::build_camera() {
  Directive camera = description_.camera;
  if (camera.type.empty()) camera.type = options_.defaults.camera;
  const FoundPlugin found = Registry::instance().find("camera", camera.type, camera.where);
  apply_assignments(options_.set, "camera", describe(*found.descriptor), camera);
  Parameters parameters(camera.parameters, camera.where, owner_name("camera", camera.type),
                        &resolver_);
  parameters.set_transform(to_render_ * camera.transform.start.inverse());
  PluginArguments arguments;
  arguments.frame = &scene_->frame_;
  scene_->camera_ = make_plugin<Camera>(found, parameters, arguments);
  scene_->camera_center_ = scene_->camera_->center();
  scene_->pixel_spread_ = scene_->camera_->pixel_spread();
  scene_->parallel_ = scene_->camera_->parallel();
  if (!description_.camera.given()) {
    built_.log.push_back("the scene has no camera: \"" + camera.type + "\" at the origin is used");
  }
}

void SceneBuilder::add_light(std::shared_ptr<Light> light) {
  scene_->light_owners_.push_back(std::move(light));
}

void SceneBuilder::build_lights() {
  for (const LightDescription& light : description_.lights) {
    refuse_animation(light.transform, light.where);
    const FoundPlugin found = Registry::instance().find("light", light.type, light.where);
    Parameters parameters(light.parameters, light.where, owner_name("light", light.type),
                          &resolver_);
    parameters.set_transform(to_render_ * light.transform.start);
    add_light(make_plugin<Light>(found, parameters));
  }
}

// Takes "alpha" off a shape's parameters: it belongs to the primitive, not to the geometry.
static std::shared_ptr<const Texture<float>> take_alpha(ParameterSet& set,
                                                        const ShapeDescription& shape,
                                                        SceneResolver& resolver) {
  ParameterSet alpha_only;
  const auto found = std::ranges::find(set, "alpha", &Parameter::name);
  if (found == set.end()) return nullptr;
  alpha_only.push_back(*found);
  set.erase(found);
  Parameters parameters(alpha_only, shape.where, owner_name("shape", shape.type), &resolver);
  auto texture = parameters.float_texture("alpha", 1.f, "", "opacity, for cut-outs");
  if (texture->constant() && texture->evaluate(Hit{}) >= 1.f) return nullptr;
  return texture;
}

void SceneBuilder::attach_area_light(const ShapeDescription& shape, const Transform& space,
                                     Primitive& primitive) {
  const Directive& area = description_.area_lights[static_cast<size_t>(shape.area_light)];
  const FoundPlugin found = Registry::instance().find("arealight", area.type, area.where);
  for (const Parameter& p : area.parameters) p.was_read = false;
  Parameters parameters(area.parameters, area.where, owner_name("area light", area.type),
                        &resolver_);
  parameters.set_transform(space * area.transform.start);
  PluginArguments arguments;
  arguments.shape = primitive.shape;
  arguments.alpha = primitive.alpha;
  auto light = make_plugin<Light>(found, parameters, arguments);
  primitive.light = light.get();
  add_light(std::move(light));
}

std::unique_ptr<Primitive> SceneBuilder::build_primitive(const ShapeDescription& shape,
                                                         const Transform& space) {
  refuse_animation(shape.transform, shape.where);
  auto primitive = std::make_unique<Primitive>();
  primitive->material = resolver_.material(shape.material);
  if (primitive->material->traits().passes_through) {
    if (shape.area_light >= 0) {
      built_.log.push_back(to_string(shape.where) + ": an interface emits nothing: left out");
    }
    return nullptr;
  }
  ParameterSet set = shape.parameters;
  primitive->alpha = take_alpha(set, shape, resolver_);
  const FoundPlugin found = Registry::instance().find("shape", shape.type, shape.where);
  Parameters parameters(set, shape.where, owner_name("shape", shape.type), &resolver_);
  parameters.set_transform(space * shape.transform.start);
  parameters.set_reverse_orientation(shape.reverse_orientation);
  primitive->shape = make_plugin<Shape>(found, parameters);
  refuse_beyond_reach(*primitive->shape, shape.where);
  primitive->name = shape.type + " " + to_string(shape.where);
  return primitive;
}

// Embree would leave out silently what its arithmetic cannot reach.
void SceneBuilder::refuse_beyond_reach(const Shape& shape, const Location& where) {
  Bounds bounds;
  if (const TriangleMesh* const mesh = shape.mesh()) {
    for (const vec3& p : mesh->positions) bounds.add(p);
  } else {
    bounds = shape.bounds();
  }
  const vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  if (bounds.min.x <= bounds.max.x && !(max_component(farthest) <= Accel::max_reach)) {
    throw Error(where, fmt::format("this shape reaches further than {:g} from the camera: that is "
                                   "too far",
                                   Accel::max_reach));
  }
}

void SceneBuilder::count(const Primitive& primitive) {
  SceneFeatures& f = scene_->features_;
  if (const TriangleMesh* const mesh = primitive.shape->mesh()) {
    f.triangles += mesh->triangles.size();
  } else {
    ++f.user_shapes;
  }
  const MaterialTraits traits = primitive.material->traits();
  f.alpha |= primitive.alpha != nullptr;
  f.connectible |= traits.diffuse_lobes;
  f.specular |= traits.delta_lobes;
  f.transmissive |= traits.transmits;
  f.material_numbers |= traits.draws_numbers;
}

std::vector<const Primitive*> SceneBuilder::build_object(const ObjectDescription& object) {
  std::vector<const Primitive*> members;
  for (const ShapeDescription& shape : object.shapes) {
    auto primitive = build_primitive(shape, Transform());
    if (!primitive) continue;
    if (shape.area_light >= 0) {
      built_.log.push_back(to_string(shape.where) +
                           ": area lights in object instances are not supported: not emitting");
    }
    count(*primitive);
    members.push_back(primitive.get());
    scene_->primitives_.push_back(std::move(primitive));
  }
  return members;
}

void SceneBuilder::build_shapes() {
  std::vector<const Primitive*> top;
  for (const ShapeDescription& shape : description_.shapes) {
    auto primitive = build_primitive(shape, to_render_);
    if (!primitive) continue;
    if (shape.area_light >= 0) attach_area_light(shape, to_render_, *primitive);
    count(*primitive);
    top.push_back(primitive.get());
    scene_->primitives_.push_back(std::move(primitive));
  }
  // Objects that nothing instantiates are not built.
  std::vector<std::vector<const Primitive*>> objects;
  std::vector<int> built_index(description_.objects.size(), -1);
  std::vector<Accel::Instance> instances;
  for (const InstanceDescription& instance : description_.instances) {
    refuse_animation(instance.transform, instance.where);
    int& index = built_index[instance.object];
    if (index < 0) {
      index = static_cast<int>(objects.size());
      objects.push_back(build_object(description_.objects[instance.object]));
    }
    instances.push_back({static_cast<uint32_t>(index), to_render_ * instance.transform.start});
  }
  const auto start = Clock::now();
  scene_->accel_ = std::make_unique<Accel>();
  scene_->accel_->build(top, objects, instances);
  SceneFeatures& f = scene_->features_;
  f.accel_seconds = seconds_since(start);
  f.accel_bytes = scene_->accel_->bytes();
  f.instances = !instances.empty();
  f.instance_count = instances.size();
  check_reach();
}

// The shapes have been checked in their own space; rays must be able to start on them in those of
// the instances.
void SceneBuilder::check_reach() {
  const SceneBounds bounds = scene_->accel_->bounds();
  const double extent = static_cast<double>(max_component(glm::abs(bounds.center))) +
                        static_cast<double>(bounds.radius);
  for (const InstanceDescription& instance : description_.instances) {
    if (extent > Accel::reach_of(to_render_ * instance.transform.start)) {
      throw Error(instance.where,
                  "this instance is too small, or too far away, for the scene's size");
    }
  }
}

void SceneBuilder::finish_lights() {
  SceneBounds& bounds = scene_->bounds_;
  bounds = scene_->accel_->bounds();
  if (!(bounds.radius > 0.f)) bounds.radius = 1.f;
  std::vector<const Light*> lights;
  double power = 0.0;
  for (const auto& light : scene_->light_owners_) {
    light->prepare(bounds);
    power += static_cast<double>(light->power());
    lights.push_back(light.get());
  }
  scene_->light_table_ = LightTable(lights);
  // Mean radiance if the light filled a diffuse enclosure of the scene's size.
  const double radius = static_cast<double>(bounds.radius);
  const double radiance = power / (4.0 * sqr(std::numbers::pi * radius));
  if (radiance > 0.0 && std::isfinite(radiance)) {
    built_.radiance_scale = std::exp2(std::round(std::log2(radiance)));
  }
}

void SceneBuilder::finish_features() {
  SceneFeatures& f = scene_->features_;
  f.lights = static_cast<int>(scene_->light_table_.all().size());
  for (const Light* light : scene_->light_table_.all()) {
    const EndpointTraits traits = light->traits();
    const bool delta = traits.delta_position || traits.delta_direction;
    f.delta_lights |= delta;
    f.infinite_lights |= !delta && traits.infinite;
    f.area_lights |= !delta && !traits.infinite;
  }
  f.delta_lens = scene_->camera_->traits().delta_position;
  f.textures = resolver_.any_textures();
  if (!f.alpha) f.left_out.push_back("alpha tests");
  if (!f.instances) f.left_out.push_back("instances");
  if (!f.textures) f.left_out.push_back("textures");
  if (!f.infinite_lights) f.left_out.push_back("environment light");
  for (const std::string& name : resolver_.unused()) f.left_out.push_back("unused " + name);
  if (f.lights == 0) built_.log.push_back("warning: the scene has no light: the picture is black");
  if (scene_->primitives_.empty()) built_.log.push_back("warning: the scene has no shapes");
}

// `settings`: of the layers, as build_layers() collects them.
static void set_hashes(BuiltScene& built, const SceneDescription& description,
                       const BuildOptions& options, std::string settings) {
  built.scene_hash = description.hash[0] ^ mix_bits(description.hash[1]);
  const RasterFrame& r = built.raster_map->frame();
  const std::string raster =
      fmt::format("{} {} {} {} {} {} {}", r.resolution.x, r.resolution.y, r.crop_min.x,
                  r.crop_min.y, r.crop_max.x, r.crop_max.y, built.max_component);
  for (const std::string& assignment : options.set) settings += assignment + "\n";
  std::array<uint64_t, 2> state{};
  hash_text(state, settings + raster);
  built.settings_hash = state[0] ^ mix_bits(state[1]);
  std::string shown = fmt::format("{:016x} {}\n", built.scene_hash, raster);
  for (const Layer& layer : built.layers) {
    const PathLimits& limits = layer.integrator->limits();
    shown += fmt::format("{} {} {}\n", limits.min_bounces, limits.max_bounces, limits.paths.text());
  }
  for (const std::string& set : options.set) {
    if (!set.starts_with("integrator.") && !set.starts_with("sampler.")) shown += set + "\n";
  }
  state = {};
  hash_text(state, shown);
  built.picture_hash = state[0] ^ mix_bits(state[1]);
}

BuiltScene SceneBuilder::build() {
  const auto start = Clock::now();
  check_supported();
  read_options();
  build_raster();
  std::string settings;
  built_.layers = build_layers(description_, options_, settings, built_.log);
  build_camera();
  build_lights();
  build_shapes();
  finish_lights();
  finish_features();
  set_hashes(built_, description_, options_, settings);
  for (std::string& line : take_color_warnings()) built_.log.push_back(std::move(line));
  for (const Layer& layer : built_.layers) layer.integrator->prepare(*scene_);
  scene_->features_.load_seconds = seconds_since(start) - scene_->features_.accel_seconds;
  built_.scene = std::move(scene_);
  return std::move(built_);
}

BuiltScene build_scene(const SceneDescription& description, const BuildOptions& options) {
  return SceneBuilder(description, options).build();
}

BuiltScene with_layers(const BuiltScene& built, const SceneDescription& description,
                       const BuildOptions& options) {
  BuiltScene other = built;
  other.log.clear();
  std::string settings;
  other.layers = build_layers(description, options, settings, other.log);
  set_hashes(other, description, options, settings);
  for (const Layer& layer : other.layers) layer.integrator->prepare(*built.scene);
  return other;
}

}  // namespace pssmlt
