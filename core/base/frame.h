// Orthonormal frame around a normal.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

// Columns s, t, n, all unit length; local z is n.
struct Frame {
  vec3 s{1.f, 0.f, 0.f}, t{0.f, 1.f, 0.f}, n{0.f, 0.f, 1.f};

  Frame() = default;
  Frame(const vec3& s_in, const vec3& t_in, const vec3& n_in) : s(s_in), t(t_in), n(n_in) {}
  // Duff et al. 2017, Building an Orthonormal Basis, Revisited. `normal` is unit length.
  explicit Frame(const vec3& normal) : n(normal) {
    const float sign = std::copysign(1.f, n.z);
    const float a = -1.f / (sign + n.z);
    const float b = n.x * n.y * a;
    s = vec3(1.f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    t = vec3(b, sign + n.y * n.y * a, -n.y);
  }
  // s along the part of `tangent` that is perpendicular to `normal`; falls back to the frame of the
  // normal alone where the two are parallel.
  static Frame from_tangent(const vec3& normal, const vec3& tangent) {
    const vec3 along = tangent - normal * glm::dot(normal, tangent);
    const float l2 = length_squared(along);
    if (!(l2 > 1e-12f * length_squared(tangent))) return Frame(normal);
    const vec3 unit = along / std::sqrt(l2);
    return {unit, glm::cross(normal, unit), normal};
  }
  vec3 to_local(const vec3& v) const { return {glm::dot(v, s), glm::dot(v, t), glm::dot(v, n)}; }
  vec3 to_world(const vec3& v) const { return v.x * s + v.y * t + v.z * n; }
};

}  // namespace pssmlt
