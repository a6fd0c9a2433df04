// The lobe of fibres that stand up from cloth: the "Charlie" distribution and its shadowing
// (Estevez, Kulla 2017, Production Friendly Microfacet Sheen BRDF), as KHR_materials_sheen of glTF
// has it, with the albedo that a base below it is reduced by, tabulated once.
//
// The fitted shadowing reflects more than it gets at grazing angles if the roughness is low: there
// the lobe is divided by its largest albedo, the same for all directions, so that it stays
// reciprocal.
#pragma once

#include <array>

#include "core/base/math.h"

namespace pssmlt {

class Sheen {
 public:
  static constexpr float least_roughness = 0.1f;

  // Made at the first call.
  static const Sheen& table();
  // f(wo, wi) [1/sr] of a white lobe, both on one side.
  float value(const vec3& wo, const vec3& wi, float roughness) const;
  // Fraction that it reflects of light from a direction, |cosine| to the normal `mu`.
  float albedo(float mu, float roughness) const;

 private:
  Sheen();
  static constexpr int size = 20;
  float factor(float roughness) const;
  std::array<std::array<float, size>, size> albedo_{};  // over roughness, then sqrt(mu)
  std::array<float, size> factors_{};
};

}  // namespace pssmlt
