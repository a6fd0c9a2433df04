// Colour spaces of FLIP. RGB is linear Rec.709; its white is the reference white.
#pragma once

#include <glm/matrix.hpp>

#include "core/base/rgb.h"

namespace pssmlt::flip {

// XYZ over the white's XYZ, from linear Rec.709: rows scaled so that (1, 1, 1) maps to itself.
inline mat3 rgb_to_relative_xyz() {
  const glm::dmat3 rows(0.4123908, 0.3575843, 0.1804808,   //
                        0.2126390, 0.7151687, 0.0721923,   //
                        0.0193308, 0.1191948, 0.9505322);  // IEC 61966-2-1
  glm::dmat3 scaled = rows;
  for (int i = 0; i < 3; ++i) scaled[i] /= rows[i].x + rows[i].y + rows[i].z;
  return mat3(glm::transpose(scaled));
}
inline const mat3 to_relative_xyz = rgb_to_relative_xyz();
inline const mat3 from_relative_xyz = mat3(glm::inverse(glm::dmat3(to_relative_xyz)));

// Linear opponent space (FLIP, section 4.1): luminance in [-16, 100], red-green, blue-yellow.
inline vec3 to_ycxcz(const Rgb& rgb) {
  const vec3 v = to_relative_xyz * rgb;
  return {116.f * v.y - 16.f, 500.f * (v.x - v.y), 200.f * (v.y - v.z)};
}
inline Rgb from_ycxcz(const vec3& c) {
  const float y = (c.x + 16.f) / 116.f;
  return from_relative_xyz * vec3(y + c.y / 500.f, y, y - c.z / 200.f);
}
// Y over the white's.
inline float relative_luminance(const vec3& ycxcz) { return (ycxcz.x + 16.f) / 116.f; }

// CIELAB's f.
inline float lab_root(float t) {
  constexpr float delta = 6.f / 29.f;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.f * delta * delta) + 4.f / 29.f;
}
// L*, and a*, b* times 0.01 L*: colourfulness falls with luminance (Hunt effect).
inline vec3 to_hunt_lab(const Rgb& rgb) {
  const vec3 v = to_relative_xyz * rgb;
  const vec3 f(lab_root(v.x), lab_root(v.y), lab_root(v.z));
  const float l = 116.f * f.y - 16.f;
  return {l, 0.01f * l * 500.f * (f.x - f.y), 0.01f * l * 200.f * (f.y - f.z)};
}
// City-block distance in lightness plus Euclidean distance in colour (Abasi et al. 2020).
inline float hyab(const vec3& p, const vec3& q) {
  const vec3 d = p - q;
  return std::fabs(d.x) + std::sqrt(sqr(d.y) + sqr(d.z));
}

}  // namespace pssmlt::flip
