// The equal-area map between the sphere and the unit square, on which environment maps, measured
// light distributions and pictures of a whole sphere are stored.
//
// Source: Clarberg 2008, Fast Equal-Area Mapping of the (Hemi)Sphere Using SIMD. The square's
// centre is +z, its corners are -z, the middles of its right and lower edge +x and +y. Equal areas
// of the square are equal solid angles: 4 pi [sr] times as much.
#pragma once

#include <algorithm>

#include "core/base/math.h"

namespace pssmlt {

// The direction, unit, of a point of the unit square.
inline dvec3 square_to_sphere(const dvec2& uv) {
  const double x = 2.0 * uv.x - 1.0, y = 2.0 * uv.y - 1.0;
  const double signed_distance = 1.0 - (std::abs(x) + std::abs(y));
  const double r = 1.0 - std::abs(signed_distance);
  const double phi =
      r == 0.0 ? 0.0 : ((std::abs(y) - std::abs(x)) / r + 1.0) * (0.25 * std::numbers::pi);
  const double radial = r * std::sqrt(std::max(0.0, 2.0 - r * r));
  return {std::copysign(std::cos(phi), x) * radial, std::copysign(std::sin(phi), y) * radial,
          std::copysign(1.0 - r * r, signed_distance)};
}

// Its inverse, for unit directions.
inline dvec2 sphere_to_square(const dvec3& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  // sqrt(1 - z) without cancellation near the poles.
  const double r = std::sqrt((x * x + y * y) / (1.0 + z));
  const double phi = std::atan2(y, x) * (2.0 / std::numbers::pi);
  dvec2 q{r - phi * r, phi * r};
  if (d.z < 0.0) q = {1.0 - q.y, 1.0 - q.x};
  return 0.5 * (dvec2(std::copysign(q.x, d.x), std::copysign(q.y, d.y)) + 1.0);
}

// The point of the unit square that a point outside stands for: across an edge the map continues
// turned by half a turn.
inline dvec2 wrap_to_square(const dvec2& uv) {
  const dvec2 tile = glm::floor(uv), inside = uv - tile;
  const double parity = tile.x + tile.y;
  return parity == 2.0 * std::floor(0.5 * parity) ? inside : 1.0 - inside;
}

}  // namespace pssmlt
