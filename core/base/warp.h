// Maps from the unit square to domains that endpoints sample; each preserves relative area.
#pragma once

#include <algorithm>
#include <type_traits>

#include "core/base/math.h"

namespace pssmlt {

template <typename T>
struct SineCosine {
  T sine, cosine;
};
// Of an angle in [-pi/4, pi/4] [rad], to rounding: Taylor polynomials, which unlike the library's
// functions need no call and no reduction.
template <typename T>
SineCosine<T> small_angle(T a) {
  if constexpr (std::is_same_v<T, double>) {
    return {std::sin(a), std::cos(a)};
  } else {
    const T x = a * a;
    const T s = T(-1. / 6) + x * (T(1. / 120) + x * (T(-1. / 5040) + x * T(1. / 362880)));
    const T c = T(-1. / 2) + x * (T(1. / 24) + x * (T(-1. / 720) + x * T(1. / 40320)));
    return {a + a * (x * s), T(1) + x * c};
  }
}

// A point of the unit disk, uniformly: the concentric map of Shirley and Chiu (1997), which keeps
// neighbours together.
template <typename T>
glm::vec<2, T> concentric_disk(const glm::vec<2, T>& u) {
  const T x = T(2) * u.x - T(1), y = T(2) * u.y - T(1);
  if (x == T(0) && y == T(0)) return {T(0), T(0)};
  constexpr T quarter = std::numbers::pi_v<T> / T(4);
  if (std::abs(x) > std::abs(y)) {
    const SineCosine<T> phi = small_angle(quarter * (y / x));
    return {x * phi.cosine, x * phi.sine};
  }
  const SineCosine<T> rest = small_angle(quarter * (x / y));  // to a right angle
  return {y * rest.sine, y * rest.cosine};
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
