// Shapes, objects, instances and what is attached to them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/fibre.h"
#include "core/plugin/registry.h"
#include "core/scene/builder_objects.h"
#include "core/scene/scene_builder.h"

namespace pssmlt {

// Reads "alpha" before the shape does not: it belongs to the primitive, not to the geometry.
static std::shared_ptr<const Texture<float>> read_alpha(const ShapeDescription& shape,
                                                        SceneResolver& resolver) {
  Parameters parameters(shape.parameters, shape.where, owner_name("shape", shape.type), &resolver);
  if (!parameters.has("alpha")) return nullptr;
  auto texture = parameters.float_texture("alpha", 1.f, "", "opacity, for cut-outs");
  if (texture->constant() && texture->evaluate(Hit{}) >= 1.f) return nullptr;
  return texture;
}

// True if the shape has a form for fibres, its material is one of fibres and the scene does not
// say which form it wants.
static bool becomes_fibre(const ShapeDescription& shape, const Material& material,
                          const PluginDescriptor& plugin) {
  const auto names_it = [](const auto& p) { return p.name == fibre_parameter; };
  if (!is_of_fibres(material)) return false;
  if (std::ranges::any_of(shape.parameters, names_it)) return false;
  static thread_local std::map<const PluginDescriptor*, bool> known;
  const auto [entry, is_new] = known.try_emplace(&plugin, false);
  if (is_new) entry->second = std::ranges::any_of(describe(plugin), names_it);
  return entry->second;
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
  add_light(std::move(light), media_.sides(shape, *primitive.material));
}

// The parameters of a displaced shape with its longest edge scaled (1 m if it gives none); nullopt
// where there is nothing to scale.
static std::optional<ParameterSet> scale_edges(const ParameterSet& set, float scale) {
  constexpr const char* length = "displacement.edgelength";
  const auto displaced = std::ranges::find(set, "displacement", &Parameter::name);
  if (scale == 1.f || displaced == set.end()) return std::nullopt;
  ParameterSet scaled = set;
  if (const auto given = std::ranges::find(scaled, length, &Parameter::name);
      given != scaled.end()) {
    for (float& x : given->floats) x *= scale;
    return scaled;
  }
  Parameter edge;
  edge.type = ParameterType::Float;
  edge.name = length;
  edge.where = displaced->where;
  edge.floats = {scale};
  scaled.push_back(edge);
  return scaled;
}

std::unique_ptr<Primitive> SceneBuilder::build_primitive(const ShapeDescription& shape,
                                                         const Transform& placed) {
  auto primitive = std::make_unique<Primitive>();
  primitive->material = resolver_.material(shape.material);
  primitive->media = media_.around(shape, *primitive->material);
  primitive->transmits = primitive->material->traits().transmits;
  if (primitive->material->traits().passes_through) {
    if (shape.area_light >= 0) {
      built_.log.push_back(to_string(shape.where) + ": an interface emits nothing");
    }
    if (!primitive->media) return nullptr;
    primitive->bounds_medium = true;
  }
  primitive->alpha = read_alpha(shape, resolver_);
  primitive->derivatives = !primitive->material->isotropic() ||
                           (primitive->alpha && primitive->alpha->reads_derivatives());
  const FoundPlugin found = Registry::instance().find("shape", shape.type, shape.where);
  std::optional<ParameterSet> changed =
      scale_edges(shape.parameters, scene_options_.displacement_edge_scale);
  if (becomes_fibre(shape, *primitive->material, *found.descriptor)) {
    if (!changed) changed = shape.parameters;
    Parameter& sheet = changed->emplace_back();
    sheet.type = ParameterType::Bool;
    sheet.name = fibre_parameter;
    sheet.where = shape.where;
    sheet.bools = {1};
  }
  Parameters parameters(changed ? *changed : shape.parameters, shape.where,
                        owner_name("shape", shape.type), &resolver_);
  parameters.set_transform(placed);
  parameters.set_reverse_orientation(shape.reverse_orientation);
  primitive->shape = make_plugin<Shape>(found, parameters);
  primitive->grain = primitive->shape->grain();
  check_place(*primitive->shape, placed, shape.where);
  primitive->name = shape.type + " " + to_string(shape.where);
  return primitive;
}

void SceneBuilder::count(const Primitive& primitive) {
  SceneFeatures& f = scene_->features_;
  if (const TriangleMesh* const mesh = primitive.shape->mesh()) {
    f.triangles += mesh->triangles.size();
  } else {
    ++f.user_shapes;
  }
  f.alpha |= primitive.alpha != nullptr;
  if (primitive.bounds_medium) return;
  const MaterialTraits traits = primitive.material->traits();
  f.connectible |= traits.diffuse_lobes;
  f.specular |= traits.delta_lobes;
  f.transmissive |= traits.transmits;
  f.material_numbers |= traits.draws_numbers;
  f.dispersion |= traits.disperses;
}

void SceneBuilder::build_shapes() {
  std::vector<const Primitive*> top;
  std::vector<std::vector<const Primitive*>> objects;
  std::vector<PlacedInstance> instances;
  for (const ShapeDescription& shape : description_.shapes) {
    if (shape.transform.animated()) {
      build_moving_shape(shape, objects, instances);
      continue;
    }
    if (const Primitive* const p = build_placed(shape, to_render_)) top.push_back(p);
  }
  ObjectsBuilder(*this, top, objects, instances).build();
  build_accel(top, objects, std::move(instances));
}

// A shape of its own, which may emit.
const Primitive* SceneBuilder::build_placed(const ShapeDescription& shape, const Transform& space) {
  auto primitive = build_primitive(shape, space * shape.transform.start);
  if (!primitive) return nullptr;
  if (shape.area_light >= 0 && !primitive->bounds_medium) {
    attach_area_light(shape, space, *primitive);
  }
  return keep(std::move(primitive));
}

const Primitive* SceneBuilder::keep(std::unique_ptr<Primitive> primitive) {
  count(*primitive);
  scene_->primitives_.push_back(std::move(primitive));
  return scene_->primitives_.back().get();
}

// A shape that moves is an object of its own, placed once.
void SceneBuilder::build_moving_shape(const ShapeDescription& shape,
                                      std::vector<std::vector<const Primitive*>>& objects,
                                      std::vector<PlacedInstance>& instances) {
  auto primitive = build_primitive(shape, Transform());
  if (!primitive) return;
  if (shape.area_light >= 0) {
    built_.log.push_back(to_string(shape.where) +
                         ": area lights that move are not supported: not emitting");
  }
  instances.push_back(place(static_cast<uint32_t>(objects.size()), shape.transform, shape.where));
  objects.push_back({keep(std::move(primitive))});
}

SceneBuilder::PlacedInstance SceneBuilder::place(uint32_t object, const TransformPair& transform,
                                                 const Location& where) {
  PlacedInstance placed{{object, to_render_ * transform.start, nullptr}, where};
  if (transform.animated()) {
    scene_->features_.motion = true;
    placed.instance.motion = std::make_shared<const MovingTransform>(placed.instance.to_render,
                                                                     to_render_ * *transform.end);
  }
  return placed;
}

void SceneBuilder::build_accel(const std::vector<const Primitive*>& top,
                               const std::vector<std::vector<const Primitive*>>& objects,
                               std::vector<PlacedInstance> placed) {
  std::vector<Accel::Instance> instances;
  std::vector<Location> places;
  for (PlacedInstance& p : placed) {
    instances.push_back(std::move(p.instance));
    places.push_back(std::move(p.where));
  }
  placed = {};
  const auto start = std::chrono::steady_clock::now();
  scene_->accel_ = std::make_unique<Accel>();
  SceneFeatures& f = scene_->features_;
  f.instances = !instances.empty();
  f.instance_count = instances.size();
  scene_->accel_->build(top, objects, std::move(instances));
  f.accel_seconds = seconds_since(start);
  f.accel_bytes = scene_->accel_->bytes();
  check_reach(places);
}

// The shapes have been checked in their own space; rays must be able to start on them in those of
// the instances.
void SceneBuilder::check_reach(const std::vector<Location>& places) {
  const SceneBounds bounds = scene_->accel_->bounds();
  const double extent = static_cast<double>(max_component(glm::abs(bounds.center))) +
                        static_cast<double>(bounds.radius);
  for (size_t i = 0; i < places.size(); ++i) {
    if (extent > Accel::reach_of(scene_->accel_->instances()[i].to_render)) {
      throw Error(places[i], "this instance is too small, or too far away, for the scene's size");
    }
  }
}

}  // namespace pssmlt
