#include "core/scene/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/color/color_warnings.h"
#include "core/path/path_expression.h"
#include "core/plugin/registry.h"
#include "core/scene/builder_film.h"
#include "core/scene/builder_hashes.h"
#include "core/scene/builder_layers.h"
#include "core/scene/media_check.h"
#include "core/scene/scene_builder.h"

namespace pssmlt {

Transform SceneBuilder::find_to_render() const {
  const Transform& camera_from_world = description_.camera.transform.start;
  if (scene_options_.render_space == SceneOptions::Space::world) return {};
  if (scene_options_.render_space == SceneOptions::Space::camera) {
    // Extinction, edge lengths and the like are lengths of the world.
    const glm::dmat3 m(camera_from_world.matrix());
    const glm::dmat3 square = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i)
      if (glm::distance(square[i], glm::dmat3(1.0)[i]) > 1e-5)
        throw Error(description_.camera.where,
                    "a camera that is scaled cannot be \"rendercoordsys\"");
    return camera_from_world;
  }
  return Transform::translate(-camera_from_world.inverse().point(dvec3(0.0)));
}

glm::dmat3 SceneBuilder::find_normal_axes(bool of_camera) const {
  Transform to_axes = to_render_.inverse();
  if (of_camera) to_axes = description_.camera.transform.start * to_axes;
  const glm::dmat3 normals = glm::transpose(glm::dmat3(to_axes.inverse_matrix()));
  // A camera's scale is no part of its axes.
  return normals / std::cbrt(std::abs(glm::determinant(normals)));
}

void SceneBuilder::read_options() {
  if (scene_options_.seed) built_.seed = *scene_options_.seed;
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
  std::shared_ptr<const Filter> made = make_plugin<Filter>(found, parameters);
  if (!scene_options_.pixel_jitter) made = std::make_shared<const PixelCentreFilter>();
  film.frame.filter_radius = made->radius();
  scene_->frame_ = film.frame;
  built_.raster_map = make_raster_map(film.frame, made, parameters);
  built_.output = film.output;
  built_.film_layers = film.layers;
  built_.normal_axes = find_normal_axes(film.camera_normals);
  built_.max_component = film.max_component;
  built_.exposure = film.sensor.exposure;
  built_.balance = film.sensor.balance;
}

void SceneBuilder::build_camera() {
  Directive camera = description_.camera;
  move_camera();
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
  scene_->pixel_spread_ = scene_options_.texture_filtering ? scene_->camera_->pixel_spread() : 0.f;
  scene_->parallel_ = scene_->camera_->parallel();
  scene_->camera_medium_ = media_.medium(description_.camera.medium, camera.where);
  if (scene_->camera_->measures_irradiance()) {
    built_.log.push_back("camera \"" + camera.type + "\": pixels hold irradiance [W/m^2]");
  }
  if (!description_.camera.given()) {
    built_.log.push_back("the scene has no camera: \"" + camera.type + "\" at the origin is used");
  }
}

// A camera may turn and travel while its shutter is open.
void SceneBuilder::move_camera() {
  const CameraDescription& camera = description_.camera;
  const float interval = camera.end_time - camera.start_time;
  const std::array<float, 2> shutter = shutter_times(camera);
  for (size_t i = 0; i < 2; ++i) {
    scene_->shutter_[i] = interval > 0.f ? (shutter[i] - camera.start_time) / interval : 0.f;
  }
  if (!camera.transform.animated()) return;
  scene_->features_.motion = true;
  auto motion = std::make_unique<const MovingTransform>(
      to_render_ * camera.transform.start.inverse(), to_render_ * camera.transform.end->inverse());
  const auto& [start, end] = motion->poses();
  for (int i = 0; i < 3; ++i) {
    const dvec3 change = glm::abs(start.stretch[i] - end.stretch[i]);
    if (max_component(vec3(change)) > 1e-4f * max_component(glm::abs(vec3(start.stretch[i])))) {
      throw Error(camera.where, "a camera that moves cannot change its scale");
    }
  }
  scene_->camera_motion_ = std::move(motion);
}

void SceneBuilder::add_light(std::shared_ptr<Light> light, const MediumInterface& around) {
  if (around.inside || around.outside) scene_->light_media_[light.get()] = around;
  scene_->light_owners_.push_back(std::move(light));
}

void SceneBuilder::build_lights() {
  for (const LightDescription& light : description_.lights) {
    refuse_animation(light.transform, light.where, "light sources");
    const FoundPlugin found = Registry::instance().find("light", light.type, light.where);
    Parameters parameters(light.parameters, light.where, owner_name("light", light.type),
                          &resolver_);
    parameters.set_transform(to_render_ * light.transform.start);
    parameters.set_world(to_render_);
    const Medium* const medium = media_.medium(light.medium, light.where);
    add_light(make_plugin<Light>(found, parameters), {medium, medium});
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
  scene_->light_table_ = LightTable(lights, bounds);
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
    const bool delta = !traits.hittable();
    f.delta_lights |= delta;
    f.infinite_lights |= !delta && traits.infinite;
    f.area_lights |= !delta && !traits.infinite;
  }
  f.delta_lens = scene_->camera_->traits().delta_position && !scene_->camera_->bare();
  f.textures = resolver_.any_textures();
  if (!f.alpha) f.left_out.push_back("alpha tests");
  if (!f.media) f.left_out.push_back("media");
  if (!f.motion) f.left_out.push_back("motion blur");
  if (!f.instances) f.left_out.push_back("instances");
  if (!f.textures) f.left_out.push_back("textures");
  if (!f.infinite_lights) f.left_out.push_back("environment light");
  for (const std::string& name : resolver_.unused()) f.left_out.push_back("unused " + name);
  scene_->media_ = media_.take_media();
  scene_->interfaces_ = media_.take_interfaces();
  if (f.lights == 0 && !f.emitting_media)
    built_.warnings.push_back("the scene has no light: the picture is black");
  if (scene_->primitives_.empty()) built_.warnings.push_back("the scene has no shapes");
  if (std::string line = contradicting_media(*scene_); !line.empty())
    built_.warnings.push_back(std::move(line));
}

BuiltScene SceneBuilder::build() {
  const auto start = std::chrono::steady_clock::now();
  read_options();
  build_raster();
  std::string settings;
  built_.layers = build_layers(description_, options_, settings, built_.log);
  build_camera();
  build_lights();
  build_shapes();
  tell_coarse_grid();
  tell_touching_interfaces();
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
  other.warnings.clear();
  std::string settings;
  other.layers = build_layers(description, options, settings, other.log);
  set_hashes(other, description, options, settings);
  for (const Layer& layer : other.layers) layer.integrator->prepare(*built.scene);
  return other;
}

}  // namespace pssmlt
