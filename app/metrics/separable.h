// Filtering with kernels that are products of a row's and a column's: 2 (2 r + 1) instead of
// (2 r + 1)^2 products a pixel. Beyond its border an image goes on with its outermost pixels.
#pragma once

#include <span>
#include <vector>

namespace pssmlt {

struct Plane {
  Plane(int w, int h)
      : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  std::span<float> row(int y) {
    return {values.data() + static_cast<size_t>(y) * static_cast<size_t>(width),
            static_cast<size_t>(width)};
  }
  std::span<const float> row(int y) const {
    return {values.data() + static_cast<size_t>(y) * static_cast<size_t>(width),
            static_cast<size_t>(width)};
  }
  int width, height;
  std::vector<float> values;
};

// 2 r + 1 weights, the middle one for offset 0.
using Kernel = std::vector<float>;

// out[x] = sum over k of kernel[k + r] * in[x + k]. `padded` is scratch.
void filter_row(std::span<const float> in, const Kernel& kernel, std::vector<float>& padded,
                std::span<float> out);
// out[x] = sum over k of kernel[k + r] * in(x, y + k).
void filter_column(const Plane& in, int y, const Kernel& kernel, std::span<float> out);

}  // namespace pssmlt
