// A dielectric coat over a Lambertian base, as sums over all reflections between the two.
//
// A coat of thickness h [mean free paths of the medium inside, which only absorbs] transmits T(w)
// of the light from a direction, of which the base reflects rho; of what the base emits the coat
// sends back R. By reciprocity it leaves with T / eta^2 per radiance inside, so that
//   f(wo, wi) = coat lobe + T(wo) T(wi) rho / (pi eta^2 (1 - rho R)).
// With a smooth coat that does not absorb T = 1 - F, and 1 - R = (1 - mean F) / eta^2: nothing is
// lost. Rough coats scatter once (GGX) and lose what they shadow.
#pragma once

#include <array>

#include "core/base/rgb.h"
#include "core/microfacet.h"

namespace pssmlt {

class Coat {
 public:
  // alpha: width of the GGX lobe; smooth below Ggx::smooth_below.
  Coat(float eta, float thickness, float alpha);

  // Of light from a direction outside, |cosine| to the normal `mu`: what the coat reflects itself,
  // and what reaches the base [1].
  float reflected(float mu) const;
  float transmitted(float mu) const;
  // Mean of transmitted() over a diffuse illumination; what comes back of diffuse light from the
  // base [1].
  float mean_transmitted() const { return mean_transmitted_; }
  float sent_back() const { return sent_back_; }
  // The base that reflects, seen through a coat of this index under diffuse light, the albedo
  // `seen` beside what the coat reflects itself; white at most.
  Rgb base_of(const Rgb& seen, float eta) const {
    const float through = mean_transmitted_ * mean_transmitted_ / (eta * eta);
    return glm::min(seen / (through + seen * sent_back_), Rgb(1.f));
  }

 private:
  static constexpr int size = 64;
  using Table = std::array<float, size>;  // over sqrt(mu), from 0 to 1
  static float at(const Table& table, float mu);
  void tabulate();
  void integrate();
  // Of light from w (z < 0: from inside): reflected fraction without absorption; with all
  // absorption on the way, what stays inside (z < 0) or gets in (z > 0).
  struct Fractions {
    float reflected = 0.f, inside = 0.f;
  };
  Fractions smooth(const vec3& w) const;
  Fractions rough(const vec3& w) const;
  Fractions fractions(const vec3& w) const { return smooth_ ? smooth(w) : rough(w); }
  // What is left after crossing the coat along a direction.
  float left(float z) const { return thickness_ > 0.f ? std::exp(-thickness_ / std::abs(z)) : 1.f; }

  float eta_, thickness_;
  Ggx ggx_;
  bool smooth_;
  Table reflected_{}, transmitted_{};
  float mean_transmitted_ = 0.f, sent_back_ = 0.f;
};

}  // namespace pssmlt
