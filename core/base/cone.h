// Cones of directions: what is known of the normals of a surface, or of many.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/frame.h"
#include "core/base/math.h"

namespace pssmlt {

// All directions whose cosine with the axis is at least `cosine`.
struct DirectionCone {
  vec3 axis{0.f, 0.f, 1.f};  // unit
  float cosine = -1.f;       // of the half angle; -1: all directions; above 1: none

  static DirectionCone none() { return {vec3(0.f, 0.f, 1.f), 2.f}; }
  bool is_empty() const { return cosine > 1.f; }
  bool is_all() const { return cosine <= -1.f; }
  // The smallest cone around this one and another.
  void add(const DirectionCone& other);
};

inline void DirectionCone::add(const DirectionCone& other) {
  if (other.is_empty() || is_all()) return;
  if (is_empty() || other.is_all()) {
    *this = other;
    return;
  }
  const dvec3 a(axis), b(other.axis);
  const double own = std::acos(static_cast<double>(cosine));
  const double others = std::acos(static_cast<double>(other.cosine));
  const double between = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  if (between + others <= own) return;
  if (between + own <= others) {
    *this = other;
    return;
  }
  const double angle = 0.5 * (own + between + others);
  if (angle >= std::numbers::pi) {
    *this = DirectionCone();
    return;
  }
  const dvec3 across = b - a * glm::dot(a, b);
  const double length = glm::length(across);
  const dvec3 side = length > 1e-9 ? across / length : dvec3(Frame(axis).s);
  axis = vec3(glm::normalize(std::cos(angle - own) * a + std::sin(angle - own) * side));
  cosine = static_cast<float>(std::cos(angle));
}

}  // namespace pssmlt
