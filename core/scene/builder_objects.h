// Objects and their instances, nested ones included: Embree has one level of instances, so that
// each that stands in an object becomes one of the world for every instance of that object.
#pragma once

#include <utility>
#include <vector>

#include "core/scene/scene_builder.h"

namespace pssmlt {

class ObjectsBuilder {
 public:
  // Adds to what the scene has already: shapes in render space, objects, instances of those.
  ObjectsBuilder(SceneBuilder& scene, std::vector<const Primitive*>& top,
                 std::vector<std::vector<const Primitive*>>& objects,
                 std::vector<SceneBuilder::PlacedInstance>& instances);
  void build();

 private:
  // Instances that one instance stands for, itself included.
  double count(uint32_t object);
  // `outer`: of the object that the instance stands in.
  void add(const InstanceDescription& instance, const Transform& outer);
  void add_lamps(const ObjectDescription& object, const Transform& placed);
  // Index of what an instance of the object places; made when first needed. -1: nothing. What
  // moves holds all that its instances hold, and what emits as well, which it then does not.
  int built(uint32_t object, bool moving);
  void add_shapes(const ObjectDescription& object, const Transform& inside, bool moving,
                  std::vector<const Primitive*>& members);
  bool emits(const ShapeDescription& shape) const;

  SceneBuilder& scene_;
  const SceneDescription& description_;
  std::vector<const Primitive*>& top_;
  std::vector<std::vector<const Primitive*>>& objects_;
  std::vector<SceneBuilder::PlacedInstance>& instances_;
  static constexpr int unknown = -2;
  std::vector<std::pair<int, int>> built_;  // at rest, moving
  std::vector<double> counts_;              // 0: not known
};

}  // namespace pssmlt
