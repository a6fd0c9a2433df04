// Colour of glowing matter over temperature.
#pragma once

#include <vector>

#include "core/base/rgb.h"

namespace pssmlt {

// A black body's spectrum scaled to a maximum of 1, in linear Rec.709 with negative components
// clipped; a spectrum of constant 1 would have luminance 1 (pbrt-v4's emission of media). Tabulated
// between the temperatures given at construction [K], interpolated linearly, 0 outside.
class BlackbodyRgb {
 public:
  BlackbodyRgb(float from, float to);
  Rgb operator()(float temperature) const;

 private:
  float from_, step_;
  std::vector<Rgb> table_;
};

}  // namespace pssmlt
