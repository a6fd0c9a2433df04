// Rays and the offset that keeps them from meeting the surface they start on.
#pragma once

#include <bit>

#include "core/base/math.h"

namespace pssmlt {

// The neighbouring float of a finite number on the side of the sign of `toward`, x itself where
// that is 0. Without branches, which no processor could foresee; std::nextafter is a library call.
inline float next_toward(float x, float toward) {
  const auto bits = std::bit_cast<uint32_t>(x),
             sign = std::bit_cast<uint32_t>(toward) & 0x80000000u;
  const uint32_t moved = bits + 1u - ((bits ^ sign) >> 31 << 1);
  const uint32_t next = x == 0.f ? sign | 1u : moved;
  return toward == 0.f ? x : std::bit_cast<float>(next);
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
  const float d = glm::dot(glm::abs(ng), error);
  const vec3 offset = glm::dot(direction, ng) < 0.f ? -d * ng : d * ng;
  vec3 p = position + offset;
  for (int i = 0; i < 3; ++i) p[i] = next_toward(p[i], offset[i]);
  return p;
}

}  // namespace pssmlt
