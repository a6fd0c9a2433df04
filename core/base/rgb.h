// Colour as three linear Rec.709 components. The same type carries radiance [W/(m^2 sr)],
// reflectance [1] and importance; the name of the variable says which.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

using Rgb = glm::vec3;

// Luminance with the Rec.709 weights: positively weighted sum over channels, so that it vanishes
// only where all channels do.
inline float luminance(const Rgb& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
inline bool is_black(const Rgb& c) { return c.x == 0.f && c.y == 0.f && c.z == 0.f; }
// True if the value may enter a film, a chain state or an acceptance ratio.
inline bool is_valid(const Rgb& c) {
  return is_finite(c) && c.x >= 0.f && c.y >= 0.f && c.z >= 0.f;
}

}  // namespace pssmlt
