// The plane of a flat surface: whether its outside can be seen from a point.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

struct FacingPlane {
  // Normals of a flat surface may differ by this much: more than their rounding [rad].
  static constexpr float angle = 1e-5f;

  vec3 point{0.f};
  vec3 normal{0.f};   // unit, outside; zero: not flat, every point may face it
  float slack = 0.f;  // how far the surface is from the plane, and its size times the angle [m]

  // False only if the surface shows `reference` its inside everywhere.
  bool may_face(const vec3& reference) const {
    const vec3 d = reference - point;
    return glm::dot(d, normal) + 2.f * angle * glm::length(d) + slack >= 0.f;
  }
  // Slack that a point of the surface asks for [m].
  float slack_of(const vec3& at) const {
    const vec3 d = at - point;
    return std::abs(glm::dot(d, normal)) + 2.f * angle * glm::length(d);
  }
};

}  // namespace pssmlt
