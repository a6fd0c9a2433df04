// The weighted average of images, layer by layer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace pssmlt {

struct MergedImage {
  Image image;
  std::vector<std::string> left_out;  // layers that not all images have, or that would be wrong
};

// Sum of weight * image of every channel that all images have by the same name, in the first one's
// order; weights sum to 1. Halves stay independent of each other by the same formula. Layers
// "variance" and "error" (a deviation) are sum(w^2 variance) and sqrt(sum(w^2 error^2)), and are
// left out unless the images are independent. Throws Error if sizes differ or no colours remain.
MergedImage merge_images(std::span<const Image> images, std::span<const double> weights,
                         bool independent);

}  // namespace pssmlt
