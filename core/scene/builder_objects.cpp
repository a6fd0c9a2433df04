#include "core/scene/builder_objects.h"

#include <fmt/format.h>

namespace pssmlt {
namespace {

// More would not fit into memory, and are meant by nobody: a few nested objects multiply quickly.
constexpr double most_instances = 5e7;

// True if it keeps shapes: motion followed by it is the motion between the products' poses.
bool keeps_shapes(const Transform& t) {
  const glm::dmat3 m(t.matrix());
  const glm::dmat3 squares = glm::transpose(m) * m;
  const double scale2 = squares[0][0];
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      if (std::abs(squares[c][r] - (c == r ? scale2 : 0.0)) > 1e-9 * scale2) return false;
  return true;
}

}  // namespace

ObjectsBuilder::ObjectsBuilder(SceneBuilder& scene, std::vector<const Primitive*>& top,
                               std::vector<std::vector<const Primitive*>>& objects,
                               std::vector<SceneBuilder::PlacedInstance>& instances)
    : scene_(scene),
      description_(scene.description_),
      top_(top),
      objects_(objects),
      instances_(instances),
      built_(description_.objects.size(), {unknown, unknown}),
      counts_(description_.objects.size(), 0.0) {}

// Objects that nothing instantiates are not built.
void ObjectsBuilder::build() {
  double all = 0.0;
  for (const InstanceDescription& instance : description_.instances) {
    all += count(instance.object);
    if (all > most_instances) {
      throw Error(instance.where, fmt::format("this would be instance {:.3g}, nested ones counted: "
                                              "more than {:.0e} are not supported",
                                              all, most_instances));
    }
  }
  instances_.reserve(instances_.size() + static_cast<size_t>(all));
  for (const InstanceDescription& instance : description_.instances) add(instance, Transform());
}

double ObjectsBuilder::count(uint32_t object) {
  if (counts_[object] > 0.0) return counts_[object];
  double sum = 1.0;
  for (const InstanceDescription& inner : description_.objects[object].instances) {
    sum += count(inner.object);
  }
  return counts_[object] = sum;
}

void ObjectsBuilder::add(const InstanceDescription& instance, const Transform& outer) {
  TransformPair transform = instance.transform;
  transform.start = outer * instance.transform.start;
  const bool moving = instance.transform.animated();
  if (moving) {
    if (!keeps_shapes(outer)) {
      throw Error(instance.where,
                  "an instance that moves cannot stand in an object that is stretched");
    }
    transform.end = std::make_shared<const Transform>(outer * *instance.transform.end);
  }
  const int index = built(instance.object, moving);
  if (index >= 0) {
    instances_.push_back(scene_.place(static_cast<uint32_t>(index), transform, instance.where));
  }
  if (moving) return;
  const ObjectDescription& object = description_.objects[instance.object];
  add_lamps(object, transform.start);
  for (const InstanceDescription& inner : object.instances) add(inner, transform.start);
}

// Shapes that emit stand in the world, so that each is a light of its own.
void ObjectsBuilder::add_lamps(const ObjectDescription& object, const Transform& placed) {
  for (const ShapeDescription& shape : object.shapes) {
    if (!emits(shape)) continue;
    refuse_animation(shape.transform, shape.where, "shapes of objects (but not objects)");
    if (const Primitive* const p = scene_.build_placed(shape, scene_.to_render_ * placed)) {
      top_.push_back(p);
    }
  }
}

bool ObjectsBuilder::emits(const ShapeDescription& shape) const {
  return shape.area_light >= 0 &&
         !scene_.resolver_.material(shape.material)->traits().passes_through;
}

int ObjectsBuilder::built(uint32_t object, bool moving) {
  int& index = moving ? built_[object].second : built_[object].first;
  if (index != unknown) return index;
  std::vector<const Primitive*> members;
  add_shapes(description_.objects[object], Transform(), moving, members);
  index = members.empty() ? -1 : static_cast<int>(objects_.size());
  if (!members.empty()) objects_.push_back(std::move(members));
  return index;
}

void ObjectsBuilder::add_shapes(const ObjectDescription& object, const Transform& inside,
                                bool moving, std::vector<const Primitive*>& members) {
  for (const ShapeDescription& shape : object.shapes) {
    refuse_animation(shape.transform, shape.where, "shapes of objects (but not objects)");
    if (emits(shape)) {
      if (!moving) continue;
      scene_.built_.log.push_back(to_string(shape.where) +
                                  ": area lights that move are not supported: not emitting");
    }
    auto primitive = scene_.build_primitive(shape, inside * shape.transform.start);
    if (primitive) members.push_back(scene_.keep(std::move(primitive)));
  }
  if (!moving) return;
  for (const InstanceDescription& inner : object.instances) {
    refuse_animation(inner.transform, inner.where, "instances in objects that move");
    add_shapes(description_.objects[inner.object], inside * inner.transform.start, true, members);
  }
}

}  // namespace pssmlt
