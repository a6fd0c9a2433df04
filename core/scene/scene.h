// The immutable scene that integrators see. Built by core/scene/builder; Embree stays behind
// core/scene/accel.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/base/frame.h"
#include "core/base/motion.h"
#include "core/camera.h"
#include "core/light.h"
#include "core/material.h"
#include "core/medium.h"
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
  const MediumInterface* media = nullptr;       // on its sides; null: as before the surface
  bool transmits = false;                       // light may pass to the other side
  bool derivatives = true;                      // of hits are read (Hit::with_derivatives)
  float grain = 0.f;                            // Shape::grain()
  bool bounds_medium = false;                   // cannot be seen and only separates media
  std::string name;                             // for messages: `sphere "file:line"`
};

class Scene {
 public:
  Scene();
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // Nearest surface along the ray. `u_alpha` decides cut-outs by inversion along the sorted hits.
  // False if nothing is met. The hit is complete (footprint included). Passes through surfaces that
  // only bound media; core/path/flight.h follows rays through media.
  bool intersect(const Ray& ray, float u_alpha, Hit& hit) const;
  // The same, but stops at surfaces that bound media. Leaves in u_alpha what the next surface along
  // the ray is decided by.
  bool intersect_any(const Ray& ray, float& u_alpha, Hit& hit) const;
  // The nearest surface of any kind, cut-outs included, for walks that count as one shadow ray.
  bool nearest(const Ray& ray, Hit& hit) const;
  // Alpha of the surface at a hit, in [0, 1].
  static float opacity(const Hit& hit);
  static bool bounds_medium(const Hit& hit) { return hit.primitive->bounds_medium; }
  // Fraction of light that surfaces let pass along the ray up to t_max: 1 or 0, and the product of
  // (1 - alpha) with cut-outs.
  float visibility(const Ray& ray) const;
  // Ray between two surface points, shortened so that neither end's surface blocks it. Errors and
  // normals are zero for points that lie on no surface.
  static Ray segment(const vec3& from, const vec3& from_error, const vec3& from_normal,
                     const vec3& to, const vec3& to_error, const vec3& to_normal, float time = 0.f);

  // Radiance that a surface emits at the hit toward `direction` (unit, away) [W/(m^2 sr)].
  Rgb emitted(const Hit& hit, const vec3& direction) const;
  // Radiance of all infinite lights along a leaving ray.
  Rgb background(const vec3& direction) const;

  // The camera where it stands when its exposure opens: for what needs no moment in time.
  const Camera& camera() const { return *camera_; }
  // When a path is followed (Ray::time), from a number in [0, 1): uniform over the exposure.
  float time(float u) const {
    return glm::clamp(shutter_[0] + u * (shutter_[1] - shutter_[0]), 0.f, 1.f);
  }
  // The camera's emit(), toward() and pdf_toward() at a time.
  std::optional<Emission> camera_emit(const vec2& u_lens, const dvec2& raster, float time) const {
    return camera_motion_ ? moving_emit(u_lens, raster, time) : camera_->emit(u_lens, raster);
  }
  std::optional<Toward> camera_toward(const vec3& reference, const vec2& u, float time) const {
    return camera_motion_ ? moving_toward(reference, u, time) : camera_->toward(reference, u);
  }
  float camera_pdf_toward(const vec3& reference, const EndpointPoint& at, float time) const;
  // Where paths start: around the camera, and around a light on the side of `direction`. Null:
  // vacuum.
  const Medium* camera_medium() const { return camera_medium_; }
  const Medium* light_medium(const Light& light, const EndpointPoint& at,
                             const vec3& direction) const;
  const RasterFrame& frame() const { return frame_; }
  const LightTable& lights() const { return light_table_; }
  const SceneFeatures& features() const { return features_; }
  const SceneBounds& bounds() const { return bounds_; }
  const std::vector<std::unique_ptr<Primitive>>& primitives() const { return primitives_; }
  // For benchmarks: the acceleration structure alone.
  const Accel& accel() const { return *accel_; }
  // Shading frame at a hit: the shading normal as the material bends it, tangent along dpdu.
  Frame shading_frame(const Hit& hit) const;

 private:
  friend class SceneBuilder;
  std::unique_ptr<Accel> accel_;
  // Diameter of a pixel at a point [m].
  float footprint(const vec3& position) const;
  void complete(const Ray& ray, const RawHit& raw, Hit& hit) const;
  bool intersect_cut_outs(const Ray& ray, float& u_alpha, Hit& hit) const;
  float visibility_of_cut_outs(const Ray& ray) const;
  // From where the camera stands at a time to where camera_ does.
  Transform camera_offset(float time) const;
  std::optional<Emission> moving_emit(const vec2& u_lens, const dvec2& raster, float time) const;
  std::optional<Toward> moving_toward(const vec3& reference, const vec2& u, float time) const;

  std::shared_ptr<const Camera> camera_;
  std::vector<std::shared_ptr<const Medium>> media_;
  std::vector<std::unique_ptr<const MediumInterface>> interfaces_;
  std::unordered_map<const Light*, MediumInterface> light_media_;  // of lights not in vacuum
  const Medium* camera_medium_ = nullptr;
  std::unique_ptr<const MovingTransform> camera_motion_;  // camera to render space; null: at rest
  std::array<float, 2> shutter_{0.f, 0.f};                // Ray::time when it opens and closes
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
