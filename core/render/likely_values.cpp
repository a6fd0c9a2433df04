#include "core/render/likely_values.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/rgb.h"

namespace pssmlt {
namespace {

constexpr std::array reaches = {0, 1, 2, 3, 5, 8, 12, 18, 27};  // of windows to each side [pixels]
// A window is known well enough if the variance of its mean over the mean's square is below this.
// For the pixel alone, whose variance is from two numbers, the limit is the lower one.
constexpr double alone_enough = 0.02, window_enough = 0.1;
constexpr double confidence = 3.0;  // half width of the intervals [standard deviations]

// Values of the three channels and the variances of their means.
struct Known {
  std::array<double, 3> value{}, variance{};
};

// Sums over any window in constant time (Crow 1984, summed-area tables).
class WindowSums {
 public:
  WindowSums(const Image& picture, const Image& half0, const Image& half1)
      : width_(picture.width), height_(picture.height), table_(at(0, height_ + 1)) {
    for (int y = 0; y < height_; ++y) {
      Known row;
      for (int x = 0; x < width_; ++x) {
        Known& sum = table_[at(x + 1, y + 1)];
        sum = table_[at(x + 1, y)];
        for (size_t c = 0; c < 3; ++c) {
          const size_t p =
              3 * (static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)) +
              c;
          row.value[c] += static_cast<double>(picture.data[p]);
          row.variance[c] += 0.25 * sqr(static_cast<double>(half0.data[p] - half1.data[p]));
          sum.value[c] += row.value[c];
          sum.variance[c] += row.variance[c];
        }
      }
    }
  }

  // Of the window around (x, y), cut off at the borders.
  Known mean(int x, int y, int reach) const {
    const int x0 = std::max(x - reach, 0), x1 = std::min(x + reach + 1, width_);
    const int y0 = std::max(y - reach, 0), y1 = std::min(y + reach + 1, height_);
    const Known &a = table_[at(x0, y0)], &b = table_[at(x1, y0)];
    const Known &c = table_[at(x0, y1)], &d = table_[at(x1, y1)];
    const double one = 1.0 / (static_cast<double>(x1 - x0) * static_cast<double>(y1 - y0));
    Known mean;
    for (size_t i = 0; i < 3; ++i) {
      mean.value[i] = one * (d.value[i] - c.value[i] - b.value[i] + a.value[i]);
      const double sum = d.variance[i] - c.variance[i] - b.variance[i] + a.variance[i];
      mean.variance[i] = one * one * std::max(sum, 0.0);  // differences of sums may round below 0
    }
    return mean;
  }

 private:
  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * (static_cast<size_t>(width_) + 1) + static_cast<size_t>(x);
  }
  int width_, height_;
  std::vector<Known> table_;  // of all pixels above and to the left
};

// Intervals in which the value lies, as far as the windows so far say.
struct Intervals {
  std::array<double, 3> low, high;
  Intervals() { low.fill(-INFINITY), high.fill(INFINITY); }
  // Narrows them by this one's; false if nothing is left.
  bool meet(const Known& known) {
    for (size_t c = 0; c < 3; ++c) {
      const double width = confidence * std::sqrt(known.variance[c]);
      low[c] = std::max(low[c], known.value[c] - width);
      high[c] = std::min(high[c], known.value[c] + width);
      if (low[c] > high[c]) return false;
    }
    return true;
  }
};

bool known_to(const Known& known, double enough) {
  double square = 0.0, variance = 0.0;
  for (size_t c = 0; c < 3; ++c) {
    square += sqr(known.value[c]);
    variance += known.variance[c];
  }
  return variance <= enough * square;
}

std::array<double, 3> likely_value(const WindowSums& sums, int x, int y,
                                   std::array<double, 3> likely) {
  Intervals intervals;
  for (const int reach : reaches) {
    const Known known = sums.mean(x, y, reach);
    if (!intervals.meet(known)) break;
    if (reach > 0) likely = known.value;
    if (known_to(known, reach == 0 ? alone_enough : window_enough)) break;
  }
  return likely;
}

}  // namespace

Image likely_values(const Image& picture, const Image& half0, const Image& half1) {
  const WindowSums sums(picture, half0, half1);
  Image result = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      float* to = result.pixel(x, y);
      const float *a = half0.pixel(x, y), *b = half1.pixel(x, y);
      const float* darker = luminance({a[0], a[1], a[2]}) < luminance({b[0], b[1], b[2]}) ? a : b;
      const auto likely = likely_value(sums, x, y, {to[0], to[1], to[2]});
      for (size_t c = 0; c < 3; ++c) {
        to[c] = std::max(static_cast<float>(likely[c]), darker[c]);
      }
    }
  }
  return result;
}

}  // namespace pssmlt
