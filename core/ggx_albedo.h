// How much of the light a GGX lobe of single scattering reflects, tabulated once: what lies below
// it gets the rest.
#pragma once

#include <array>

#include "core/base/math.h"

namespace pssmlt {

// Reflected under the Fresnel factor f0 + (f90 - f0) (1 - c)^5 of Schlick 1994: f0 * low + f90 *
// high (the split of Karis 2013, Real Shading in Unreal Engine 4).
struct SchlickAlbedo {
  float low = 0.f, high = 0.f;
  float operator()(float f0, float f90) const { return f0 * low + f90 * high; }
};

class GgxAlbedo {
 public:
  // Made at the first call.
  static const GgxAlbedo& table();
  // For light from a direction, |cosine| to the normal `mu`; alpha: width of the lobe, 0 a mirror.
  SchlickAlbedo at(float mu, float alpha) const;
  // Its mean over a diffuse illumination.
  SchlickAlbedo mean(float alpha) const;

 private:
  GgxAlbedo();
  static constexpr int size = 32;
  using Row = std::array<SchlickAlbedo, size>;  // over sqrt(mu)
  static SchlickAlbedo in_row(const Row& row, float mu);
  std::array<Row, size> rows_{};  // over sqrt(alpha)
  std::array<SchlickAlbedo, size> means_{};
};

}  // namespace pssmlt
