// Rays and the offset that keeps them from meeting the surface they start on.
#pragma once

#include <bit>

#include "core/base/four.h"
#include "core/base/math.h"

namespace pssmlt {

// The neighbouring floats of finite numbers on the side of the sign of `toward`, x itself where
// that is 0. Without branches, which no processor could foresee; std::nextafter is a library call.
inline Four next_toward(Four x, Four toward) {
  const auto bits = std::bit_cast<FourBits>(x),
             sign = std::bit_cast<FourBits>(toward) & 0x80000000u;
  const FourBits moved = bits + 1u - ((bits ^ sign) >> 31 << 1);
  const FourBits next = x == 0.f ? sign | 1u : moved;
  return std::bit_cast<Four>(toward == 0.f ? bits : next);
}

struct Ray {
  vec3 origin{0.f};
  vec3 direction{0.f, 0.f, 1.f};  // unit length
  float t_max = infinity;         // [m]
  float time = 0.f;               // in the motion's interval, from 0 to 1
};

// Origin for a ray leaving `position` toward `direction`: moved along the geometric normal to the
// side of `direction` by the position's error bound [m per axis], then rounded away, so that it
// can't lie behind the surface (Pharr, Jakob, Humphreys 2023, section 6.8.6). No absolute epsilon.
inline vec3 offset_origin(const vec3& position, const vec3& error, const vec3& ng,
                          const vec3& direction) {
  const float d = std::abs(ng.x) * error.x + std::abs(ng.y) * error.y + std::abs(ng.z) * error.z;
  const vec3 offset = (glm::dot(direction, ng) < 0.f ? -d : d) * ng;
  const Four toward = {offset.x, offset.y, offset.z, 0.f};
  const Four p = next_toward(Four{position.x, position.y, position.z, 0.f} + toward, toward);
  return {p[0], p[1], p[2]};
}

}  // namespace pssmlt
