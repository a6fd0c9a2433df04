// A surface point ready for scattering: hit, shading frame and Bsdf, with the conversions between
// world and local directions that every integrator needs. Reflection and transmission are told
// apart by the sides of the shading normal alone; the geometric normal offsets rays, converts
// densities and corrects importance.
#pragma once

#include <optional>

#include "core/base/frame.h"
#include "core/base/ray.h"
#include "core/scene/scene.h"

namespace pssmlt {

struct ScatterSample {
  vec3 wi{0.f};             // unit, render space
  Rgb weight{0.f};          // f |cos| / pdf, shading-normal correction included [1]
  float pdf = 0.f;          // [1/sr]; delta: probability [1]
  float pdf_reverse = 0.f;  // same measure
  bool delta = false;
  bool transmitted = false;
  float eta = 1.f;
};

// Not copyable: the Bsdf lives inside.
class Surface {
 public:
  Hit hit;
  vec3 wo{0.f};  // unit, toward where the path came from

  // Evaluates the hit's material; false where nothing scatters. Call after filling `hit`.
  bool shade(const Scene& scene, const vec3& wo_world, MaterialNumbers u);
  // f(wo, wi) |cos(ns, wi)| [1/sr]; for importance transport with the adjoint correction of shading
  // normals |wo.ns||wi.ng| / (|wo.ng||wi.ns|) (Veach 1997, eq. 5.19), so that light and camera
  // subpaths see the same scattering.
  Rgb f_cos(const vec3& wi, Transport mode) const;
  // Density of sample() [1/sr], delta lobes excluded.
  float pdf(const vec3& wi) const;
  // f_cos and pdf toward wi, and the density of sampling wo when arriving from wi [1/sr].
  struct Scattering {
    Rgb f_cos{0.f};
    float pdf = 0.f, pdf_reverse = 0.f;
  };
  Scattering scattering(const vec3& wi, Transport mode) const;
  std::optional<ScatterSample> sample(float u_lobe, const vec2& u, Transport mode) const;
  // True if f_cos can be non-zero. Call after a shade() that returned true, as all but hit and wo.
  bool connectible() const { return bsdf_->connectible(); }
  // Ray that leaves toward `direction`, offset from the surface.
  Ray spawn(const vec3& direction) const {
    return {offset_origin(hit.position, hit.error, hit.ng, direction), direction, infinity};
  }
  // Ray to a point of a light or camera, for visibility.
  Ray segment(const Toward& end) const {
    if (!(end.distance < infinity)) return spawn(end.wi);
    return Scene::segment(hit.position, hit.error, hit.ng, end.at.position, end.error,
                          end.at.normal);
  }
  Ray segment(const Surface& other) const {
    return Scene::segment(hit.position, hit.error, hit.ng, other.hit.position, other.hit.error,
                          other.hit.ng);
  }
  // This point as a point of the light that the surface carries.
  EndpointPoint light_point() const { return {hit.position, hit.ng, hit.uv, hit.element}; }
  const Bsdf* bsdf() const { return bsdf_; }
  const Frame& frame() const { return frame_; }

  Surface() = default;
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

 private:
  // Factor of importance transport toward wi, |cos(ns, wi)| included.
  float adjoint_cosine(const vec3& wi) const;
  Frame frame_;
  vec3 wo_local_{0.f};
  const Bsdf* bsdf_ = nullptr;
  BsdfStorage storage_;
};

}  // namespace pssmlt
