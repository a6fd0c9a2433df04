// Two pictures made comparable: colours of one size, and which of the pixels count.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/rgb.h"
#include "core/image/image.h"

namespace pssmlt {

// Row-major, upper row first.
struct PicturePair {
  // Throws Error where sizes differ or an image has no colours.
  PicturePair(const Image& first, const Image& second);
  size_t pixels() const { return reference.size(); }

  int width = 0, height = 0;
  std::vector<Rgb> picture, reference;
  std::vector<uint8_t> counts;  // 0: a channel of either is not finite
  int64_t non_finite = 0;
  double reference_mean = 0.0;  // luminance, over the pixels that count
};

}  // namespace pssmlt
