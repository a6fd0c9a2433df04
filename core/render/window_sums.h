// Sums over any rectangle of a picture in constant time (Crow 1984, summed-area tables).
#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace pssmlt {

// N numbers a pixel. Differences of sums: what is small beside the sum of all above and to the left
// is known to 1e-16 of that sum.
template <size_t N>
class WindowSums {
 public:
  using Values = std::array<double, N>;

  // value(x, y) gives a pixel's numbers.
  template <typename Value>
  WindowSums(int width, int height, const Value& value)
      : width_(width), height_(height), table_(at(0, height + 1)) {
    for (int y = 0; y < height; ++y) {
      Values row{};
      for (int x = 0; x < width; ++x) {
        const Values own = value(x, y);
        const Values& above = table_[at(x + 1, y)];
        Values& sum = table_[at(x + 1, y + 1)];
        for (size_t i = 0; i < N; ++i) {
          row[i] += own[i];
          sum[i] = above[i] + row[i];
        }
      }
    }
  }

  // Mean over the pixels that are at most `reach` away in x and in y; `count` of them there are.
  Values mean(int x, int y, int reach, double& count) const {
    const int x0 = std::max(x - reach, 0), x1 = std::min(x + reach + 1, width_);
    const int y0 = std::max(y - reach, 0), y1 = std::min(y + reach + 1, height_);
    const Values &a = table_[at(x0, y0)], &b = table_[at(x1, y0)];
    const Values &c = table_[at(x0, y1)], &d = table_[at(x1, y1)];
    count = static_cast<double>(x1 - x0) * static_cast<double>(y1 - y0);
    Values mean;
    for (size_t i = 0; i < N; ++i) mean[i] = (d[i] - c[i] - b[i] + a[i]) / count;
    return mean;
  }

 private:
  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * (static_cast<size_t>(width_) + 1) + static_cast<size_t>(x);
  }
  int width_, height_;
  std::vector<Values> table_;  // of all pixels above and to the left
};

}  // namespace pssmlt
