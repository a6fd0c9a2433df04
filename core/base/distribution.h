// Piecewise-constant distributions over [0,1) and [0,1)^2, sampled by inversion. Sums are kept in
// double: a float could not tell a million cells apart.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace pssmlt {

// Over cells of equal width with probabilities proportional to weights, which are finite and not
// negative. If all are zero, nothing can be sampled: sum() == 0.
class Distribution1D {
 public:
  Distribution1D() = default;
  template <typename T>
  explicit Distribution1D(std::span<const T> weights) : cdf_(weights.size() + 1) {
    for (size_t i = 0; i < weights.size(); ++i)
      cdf_[i + 1] = cdf_[i] + static_cast<double>(weights[i]);
    sum_ = cdf_.back();
    if (sum_ > 0.0)
      for (double& c : cdf_) c /= sum_;
  }

  struct Cell {
    uint32_t index = 0;
    double probability = 0.0;  // of the cell [1]
    double offset = 0.0;       // in [0,1): what is left of u, uniform in the cell
  };
  // The cell for u in [0,1); one of positive probability. Precondition: sum() > 0.
  Cell sample(double u) const {
    // The last cell whose lower bound is at or below u: cells without probability are skipped.
    const auto above = std::upper_bound(cdf_.begin(), cdf_.end() - 1, u);
    auto i = static_cast<size_t>(std::max<std::ptrdiff_t>(above - cdf_.begin() - 1, 0));
    while (i > 0 && cdf_[i + 1] <= cdf_[i]) --i;  // u beyond the last sum by rounding
    const double p = cdf_[i + 1] - cdf_[i];
    const double offset = std::min((u - cdf_[i]) / p, 1.0 - 0x1p-53);
    return {static_cast<uint32_t>(i), p, offset};
  }
  double probability(size_t i) const { return cdf_[i + 1] - cdf_[i]; }
  double sum() const { return sum_; }
  size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }

 private:
  std::vector<double> cdf_;
  double sum_ = 0.0;
};

// Over a grid of equal cells, row by row: marginal over y, conditional over x.
class Distribution2D {
 public:
  Distribution2D() = default;
  Distribution2D(std::span<const float> weights, int width, int height) : width_(width) {
    std::vector<double> rows;
    for (int y = 0; y < height; ++y) {
      rows_.emplace_back(weights.subspan(static_cast<size_t>(y) * static_cast<size_t>(width),
                                         static_cast<size_t>(width)));
      rows.push_back(rows_.back().sum());
    }
    marginal_ = Distribution1D(std::span<const double>(rows));
  }

  struct Point {
    dvec2 uv{0.0};
    double pdf = 0.0;  // with respect to the unit square [1]
  };
  // Precondition: sum() > 0.
  Point sample(const dvec2& u) const {
    const auto y = marginal_.sample(u.y);
    const auto x = rows_[y.index].sample(u.x);
    return {{(x.index + x.offset) / width_, (y.index + y.offset) / height()},
            x.probability * y.probability * width_ * height()};
  }
  // Density of sample() at a point of [0,1]^2.
  double pdf(const dvec2& uv) const {
    if (!(sum() > 0.0)) return 0.0;
    const auto cell = [](double t, int n) {
      return static_cast<size_t>(std::clamp(static_cast<int>(t * n), 0, n - 1));
    };
    const size_t y = cell(uv.y, height());
    if (!(rows_[y].sum() > 0.0)) return 0.0;
    return marginal_.probability(y) * rows_[y].probability(cell(uv.x, width_)) * width_ * height();
  }
  double sum() const { return marginal_.sum(); }
  int height() const { return static_cast<int>(rows_.size()); }

 private:
  int width_ = 0;
  std::vector<Distribution1D> rows_;
  Distribution1D marginal_;
};

}  // namespace pssmlt
