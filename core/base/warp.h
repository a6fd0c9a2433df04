// Maps from the unit square to domains that endpoints sample; each preserves relative area.
#pragma once

#include <algorithm>

#include "core/base/math.h"

namespace pssmlt {

// A point of the unit disk, uniformly: the concentric map of Shirley and Chiu (1997), which keeps
// neighbours together.
template <typename T>
glm::vec<2, T> concentric_disk(const glm::vec<2, T>& u) {
  const T x = T(2) * u.x - T(1), y = T(2) * u.y - T(1);
  if (x == T(0) && y == T(0)) return {T(0), T(0)};
  constexpr T quarter = std::numbers::pi_v<T> / T(4);
  const bool wide = std::abs(x) > std::abs(y);
  const T r = wide ? x : y;
  const T phi = wide ? quarter * (y / x) : T(2) * quarter - quarter * (x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

// A direction about +z with density cos(theta) / pi [1/sr].
inline vec3 cosine_hemisphere(const vec2& u) {
  const vec2 p = concentric_disk(u);
  return {p.x, p.y, safe_sqrt(1.f - p.x * p.x - p.y * p.y)};
}

// The direction at height z about the axis +z, turned by 2 pi u.
inline vec3 direction_at_height(float z, float u) {
  const float r = safe_sqrt((1.f - z) * (1.f + z));
  const float phi = 2.f * pi * u;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// A direction with density 1 / (4 pi) [1/sr].
inline vec3 uniform_sphere(const vec2& u) { return direction_at_height(1.f - 2.f * u.x, u.y); }

// Two numbers below 1 in single precision, whatever rounding does.
inline vec2 to_float_below_one(const dvec2& u) {
  return {std::min(static_cast<float>(u.x), one_minus_epsilon),
          std::min(static_cast<float>(u.y), one_minus_epsilon)};
}

}  // namespace pssmlt
