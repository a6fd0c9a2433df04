// Light between a dielectric boundary and an opaque base, with a medium in between, all parallel
// and of no width (Guo, Hasan, Zhao 2018, Position-Free Monte Carlo Simulation for Arbitrary
// Layered BSDFs; Pharr, Jakob, Humphreys 2023, section 14.3). Each walk gives one estimate of f
// from numbers that belong to the vertex, so that f(wo, wi) is a deterministic function of the
// sample; integrated over the numbers it is exact up to the number of events.
#pragma once

#include "core/base/warp.h"
#include "core/layered/walk_numbers.h"
#include "core/phase_function.h"
#include "core/rough_interface.h"
#include "core/rough_mirror.h"

namespace pssmlt {

// What the points of a surface share.
struct LayerMedium {
  float eta = 1.5f;       // index of the medium over that outside
  float thickness = 0.f;  // in mean free paths; 0: no medium
  Rgb albedo{0.f};        // of a scattering event
  float g = 0.f;          // of its phase function (Henyey and Greenstein)
  int events = 10;        // that a walk has at most, entry and exit not counted
  bool scatters() const { return thickness > 0.f && max_component(albedo) > 0.f; }
};

// The opaque base: Lambertian or metal.
struct LayerBase {
  bool lambertian = false;
  Rgb reflectance{0.f};  // Lambertian
  RoughMirror metal{{}, Ggx(0.f, 0.f)};

  bool is_delta() const { return !lambertian && metal.ggx().is_smooth(); }
  // Directions above the base.
  Rgb eval(const vec3& wo, const vec3& wi) const;
  float pdf(const vec3& wo, const vec3& wi) const;
  struct Draw {
    vec3 wi{0.f};
    Rgb weight{0.f};
    float pdf = 0.f;  // 0: delta
  };
  std::optional<Draw> draw(const vec3& wo, const vec2& u) const;
};

class LayerWalk {
 public:
  LayerWalk(const LayerMedium& medium, const Ggx& boundary, const LayerBase& base)
      : medium_(medium),
        ggx_(boundary),
        smooth_(refracts_sharply(medium.eta, boundary)),
        interface_(medium.eta, boundary),
        base_(base) {}

  // One estimate of f(a, b) [1/sr], without what the boundary itself reflects; both above. In the
  // mean symmetric.
  Rgb estimate(const vec3& a, const vec3& b, const WalkNumbers& n) const;

 private:
  // A direction below the boundary that one above refracts into.
  struct Crossing {
    vec3 inside{0.f};    // unit, z < 0
    float weight = 0.f;  // as importance: f |cos| / pdf [1]
    float pdf = 0.f;     // [1/sr]; 0: delta
  };
  // Where the walk stands: flying along `w` at height z [mean free paths] above the base.
  struct Walker {
    vec3 w{0.f};
    float z = 0.f;
    Rgb throughput{1.f};
    Rgb sum{0.f};
  };
  std::optional<Crossing> cross(const vec3& outside, const vec2& u) const;
  // f of the boundary as importance, from outside into a direction inside, and its density.
  std::pair<float, float> refracted(const vec3& outside, const vec3& inside) const;
  // What is left after a height dz along w.
  float left(float dz, const vec3& w) const {
    return medium_.thickness > 0.f ? std::exp(-dz / std::abs(w.z)) : 1.f;
  }
  // Each does one event and returns false if the walk ends.
  bool scatter(Walker& at, const EventNumbers& n, const vec3& b,
               const std::optional<Crossing>& exit) const;
  bool reflect_at_base(Walker& at, const EventNumbers& n, const vec3& b,
                       const std::optional<Crossing>& exit) const;
  bool reflect_at_boundary(Walker& at, const EventNumbers& n) const;
  // Moves to the next event: true if that is in the medium.
  bool fly(Walker& at, float u) const;

  const LayerMedium& medium_;
  const Ggx& ggx_;
  bool smooth_;
  RoughInterface interface_;
  const LayerBase& base_;
};

}  // namespace pssmlt
