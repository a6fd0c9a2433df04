// The only door to Embree: nearest hits and occlusion over primitives and instances.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/motion.h"
#include "core/base/ray.h"
#include "core/scene/scene.h"

namespace pssmlt {

// Where a ray meets something, before its surface is computed.
struct RawHit {
  float t = 0.f;    // along the ray [m]
  vec2 where{0.f};  // barycentric or the shape's own coordinates
  uint32_t element = 0;
  int instance = -1;  // into the instances, -1: none
  float time = 0.f;   // the ray's
  const Primitive* primitive = nullptr;
};

class Accel {
 public:
  // A set of primitives placed once (identity) or by every one of its instances.
  struct Instance {
    uint32_t object = 0;
    Transform to_render;                            // if it does not move, or when it starts
    std::shared_ptr<const MovingTransform> motion;  // null: it does not move
    Transform at(float time) const { return motion ? motion->at(time) : to_render; }
  };
  Accel();
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  // primitives: in render space; objects: in the space their instances start from. The primitives
  // outlive the Accel. Throws Failure if memory runs out.
  void build(const std::vector<const Primitive*>& primitives,
             const std::vector<std::vector<const Primitive*>>& objects,
             std::vector<Instance> instances);
  const std::vector<Instance>& instances() const;

  // A ray that is not finite, or starts beyond reach(), meets nothing and sees nothing.
  bool intersect(const Ray& ray, RawHit& hit) const;
  bool occluded(const Ray& ray) const;
  // Completes the hit of a ray in render space (footprint left to the scene).
  void fill(const Ray& ray, const RawHit& raw, Hit& hit) const;

  SceneBounds bounds() const;  // of everything, radius 0 if empty
  // Largest coordinate of geometry.
  static constexpr float max_reach = 1e18f;
  // Largest coordinate where rays may start: max_reach, less with tiny instances.
  float reach() const { return reach_; }
  // What one instance leaves of it: its own space must hold the ray too, and directions.
  static double reach_of(const Transform& to_render);
  uint64_t bytes() const;  // Embree's own memory

 private:
  void refine(const Ray& ray, const RawHit& raw, Hit& hit) const;
  void to_render(const RawHit& raw, Hit& hit) const;
  float reach_ = 0.f;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pssmlt
