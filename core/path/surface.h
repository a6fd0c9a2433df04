// A point where paths scatter, on a surface or inside a medium: hit, frame and Bsdf, with the
// conversions between world and local directions that every integrator needs. On surfaces
// reflection and transmission are told apart by the sides of the shading normal alone; the
// geometric normal offsets rays, converts densities and corrects importance. Points of media have
// no normal: where a surface has a cosine they have 1, and their Bsdf is the phase function.
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
  const DiffusionProfile* beneath = nullptr;  // as BsdfSample's
};

// Not copyable: the Bsdf lives inside.
class Surface {
 public:
  Hit hit;                         // in a medium: position and distance only, no primitive
  vec3 wo{0.f};                    // unit, toward where the path came from
  const Medium* medium = nullptr;  // that the path came through; null: vacuum
  float time = 0.f;                // of the rays that leave (Ray::time)

  // Evaluates the hit's material; false where nothing scatters. Call after filling `hit`.
  bool shade(const Scene& scene, const vec3& wo_world, MaterialNumbers u);
  // Makes this a point of the medium, or one of a surface that is reached through it.
  void place(const Medium& in, const vec3& position, float distance) {
    hit = Hit();
    hit.position = position;
    hit.distance = distance;
    medium = &in;
    in_medium_ = true;
    point_ = in.at(position);
  }
  void leave_medium(const Medium* through) {
    medium = through;
    in_medium_ = false;
  }
  // Before it is filled by an edge.
  void arrive(float ray_time) {
    time = ray_time;
    emerging_ = false;
  }
  // Makes this the point `at`, where light that diffused beneath the surface leaves on the side of
  // the shading normal (1 or -1); in place of shade().
  void emerge(const Scene& scene, const Hit& at, const DiffusionProfile& profile, float side);
  bool emerging() const { return emerging_; }
  // Of the direction given to shade(): the side of the shading normal, 1 or -1.
  float side() const { return wo_local_.z < 0.f ? -1.f : 1.f; }
  bool in_medium() const { return in_medium_; }
  // Light is scattered by its wavelength here, and the path has one from here on.
  bool disperses(const Scene& scene) const {
    return scene.features().dispersion && !in_medium_ &&
           hit.primitive->material->traits().disperses;
  }
  const MediumPoint& point() const { return point_; }  // if in_medium()
  // The medium that a ray enters that leaves toward `direction`.
  const Medium* medium_toward(const vec3& direction) const {
    if (in_medium_ || !hit.primitive->media) return medium;
    return hit.primitive->media->toward(direction, hit.ng);
  }
  // Converts a density per solid angle at the other end of an edge, times its squared length, to
  // this point's: |cos| to the geometric normal, times the probability that the edge gets here
  // through media [1]; inside one the density of stopping there instead [1/m].
  float arrival(const vec3& direction, const Rgb& transmittance) const {
    return in_medium_ ? mean(point_.extinction * transmittance)
                      : std::abs(glm::dot(hit.ng, direction)) * mean(transmittance);
  }
  // f(wo, wi) |cos(ns, wi)| [1/sr], in media sigma_s times the phase function [1/(m sr)]; for
  // importance transport with the adjoint correction of shading normals
  // |wo.ns||wi.ng| / (|wo.ng||wi.ns|) (Veach 1997, eq. 5.19), so that light and camera subpaths see
  // the same scattering.
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
    return {offset_origin(hit.position, hit.error, hit.ng, direction), direction, infinity, time};
  }
  // Ray to a point of a light or camera, for visibility.
  Ray segment(const Toward& end) const {
    if (!(end.distance < infinity)) return spawn(end.wi);
    return Scene::segment(hit.position, hit.error, hit.ng, end.at.position, end.error,
                          end.at.normal, time);
  }
  Ray segment(const Surface& other) const {
    return Scene::segment(hit.position, hit.error, hit.ng, other.hit.position, other.hit.error,
                          other.hit.ng, time);
  }
  // This point as a point of the light that the surface carries.
  EndpointPoint light_point() const { return {hit.position, hit.ng, hit.uv, hit.element}; }
  // The shading normal, turned to the side of the direction given to shade().
  vec3 facing_normal() const { return side() * frame_.n; }
  const Bsdf* bsdf() const { return bsdf_; }
  const Frame& frame() const { return frame_; }

  Surface() = default;
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

 private:
  // Factor of importance transport toward wi, |cos(ns, wi)| included.
  float importance_cosine(const vec3& wi) const;
  // The part of it that belongs to wo.
  float entering_correction() const;
  // What f_cos() of a surface multiplies the Bsdf with.
  float cosine_factor(const vec3& wi, const vec3& local, Transport mode) const;
  Frame frame_;
  vec3 wo_local_{0.f};
  const Bsdf* bsdf_ = nullptr;
  bool in_medium_ = false;
  bool emerging_ = false;
  MediumPoint point_;
  BsdfStorage storage_;
};

}  // namespace pssmlt
