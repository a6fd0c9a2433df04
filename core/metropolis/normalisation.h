// b, the integral of the target over primary sample space: the mean of independent uniform samples.
#pragma once

#include <cmath>
#include <cstdint>

namespace pssmlt {

// Mean of independent values and its standard error. Merging in a fixed order gives fixed bits.
struct MeanTally {
  uint64_t count = 0;
  double sum = 0.0, sum_squares = 0.0;

  void add(double value) {
    ++count;
    sum += value;
    sum_squares += value * value;
  }
  void merge(const MeanTally& other) {
    count += other.count;
    sum += other.sum;
    sum_squares += other.sum_squares;
  }
  // 0 without values.
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
  // Of the mean; 0 with fewer than two values.
  double standard_error() const {
    if (count < 2) return 0.0;
    const double n = static_cast<double>(count);
    const double variance = std::fmax(0.0, (sum_squares - sum * sum / n) / (n - 1.0));
    return std::sqrt(variance / n);
  }
};

}  // namespace pssmlt
