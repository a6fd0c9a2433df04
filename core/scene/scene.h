// The immutable scene that integrators see. Built by core/scene/builder; Embree stays behind
// core/scene/accel.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/frame.h"
#include "core/camera.h"
#include "core/light.h"
#include "core/material.h"
#include "core/scene/features.h"
#include "core/scene/light_table.h"
#include "core/shape.h"

namespace pssmlt {

class Accel;
struct RawHit;

// A shape with what is attached to it.
struct Primitive {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<const Material> material;     // never null
  std::shared_ptr<const Texture<float>> alpha;  // null: opaque
  const Light* light = nullptr;                 // emission of this surface, or null
  std::string name;                             // for messages: `sphere "file:line"`
};

class Scene {
 public:
  Scene();
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // Nearest surface along the ray. `u_alpha` decides cut-outs by inversion along the sorted hits.
  // False if nothing is met. The hit is complete (footprint included).
  bool intersect(const Ray& ray, float u_alpha, Hit& hit) const;
  // Fraction of light that passes along the ray up to t_max: 1 or 0, and the product of (1 - alpha)
  // with cut-outs.
  float visibility(const Ray& ray) const;
  // Ray between two surface points, shortened so that neither end's surface blocks it. Errors and
  // normals are zero for points that lie on no surface.
  static Ray segment(const vec3& from, const vec3& from_error, const vec3& from_normal,
                     const vec3& to, const vec3& to_error, const vec3& to_normal);

  // Radiance that a surface emits at the hit toward `direction` (unit, away) [W/(m^2 sr)].
  Rgb emitted(const Hit& hit, const vec3& direction) const;
  // Radiance of all infinite lights along a leaving ray.
  Rgb background(const vec3& direction) const;

  const Camera& camera() const { return *camera_; }
  const RasterFrame& frame() const { return frame_; }
  const LightTable& lights() const { return light_table_; }
  const SceneFeatures& features() const { return features_; }
  const SceneBounds& bounds() const { return bounds_; }
  const std::vector<std::unique_ptr<Primitive>>& primitives() const { return primitives_; }
  // For benchmarks: the acceleration structure alone.
  const Accel& accel() const { return *accel_; }
  // Shading frame at a hit: the shading normal bent by the material's displacement, tangent along
  // dpdu.
  Frame shading_frame(const Hit& hit) const;

 private:
  friend class SceneBuilder;
  std::unique_ptr<Accel> accel_;
  // Diameter of a pixel at a point [m].
  float footprint(const vec3& position) const;
  void complete(const RawHit& raw, Hit& hit) const;
  bool intersect_cut_outs(const Ray& ray, float u_alpha, Hit& hit) const;

  std::shared_ptr<const Camera> camera_;
  // What the footprint needs of the camera, which is asked for at every hit.
  vec3 camera_center_{0.f};
  float pixel_spread_ = 0.f;
  bool parallel_ = false;
  RasterFrame frame_;
  std::vector<std::unique_ptr<Primitive>> primitives_;
  std::vector<std::shared_ptr<Light>> light_owners_;
  LightTable light_table_;
  SceneFeatures features_;
  SceneBounds bounds_;
};

// Rays traced by this thread since it started (statistics).
struct RayCounters {
  uint64_t nearest = 0, shadow = 0;
};
RayCounters& ray_counters();

}  // namespace pssmlt
