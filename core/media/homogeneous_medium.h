// A medium that is the same everywhere. Free flight is exact, by inversion of the exponential
// (Pharr, Jakob, Humphreys 2023, section 11.4.1).
#pragma once

#include "core/medium.h"
#include "core/phase_function.h"

namespace pssmlt {

class HomogeneousMedium : public Medium {
 public:
  // g of Henyey's and Greenstein's phase function, in (-1, 1).
  HomogeneousMedium(const MediumPoint& point, float g) : point_(point), g_(g) {}

  MediumTraits traits() const final {
    return {.scatters = !is_black(point_.scattering), .emits = !is_black(point_.emission)};
  }
  Rgb optical_depth(const Ray& ray) const final {
    Rgb depth(0.f);
    for (int c = 0; c < 3; ++c) {
      if (point_.extinction[c] > 0.f) depth[c] = point_.extinction[c] * ray.t_max;
    }
    return depth;
  }
  std::optional<float> distance(const Ray& ray, int channel, float depth) const final {
    const float sigma = point_.extinction[channel];
    if (!(sigma > 0.f)) return std::nullopt;
    const float t = depth / sigma;
    return t < ray.t_max ? std::optional(t) : std::nullopt;
  }
  MediumPoint at(const vec3&) const final { return point_; }
  const Bsdf* phase(const vec3&, BsdfStorage& storage) const final {
    return storage.make<HenyeyGreenstein>(g_);
  }

 private:
  MediumPoint point_;
  float g_;
};

}  // namespace pssmlt
