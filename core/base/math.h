// Vector types, constants and small helpers that every part of the renderer uses.
// float for geometry and radiance; double (dvec) where values are composed or accumulated.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

namespace pssmlt {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::ivec3;
using glm::mat3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float pi = std::numbers::pi_v<float>;
inline constexpr float inv_pi = std::numbers::inv_pi_v<float>;
inline constexpr float infinity = std::numeric_limits<float>::infinity();
// The largest float below 1: what a number of primary sample space may be at most.
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

inline float sqr(float x) { return x * x; }
inline double sqr(double x) { return x * x; }
// Square root of what rounding may have made slightly negative. (std::fmax and std::fmin are
// library calls where NaN is allowed for.)
inline float safe_sqrt(float x) { return x > 0.f ? std::sqrt(x) : 0.f; }
inline float length_squared(const vec3& v) { return glm::dot(v, v); }
inline bool is_finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
// The first of equal ones; a NaN in z stays.
inline float max_component(const vec3& v) {
  const float yz = v.y > v.z ? v.y : v.z;
  return v.x > yz ? v.x : yz;
}

}  // namespace pssmlt
