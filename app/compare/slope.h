// How fast the error falls: the slope of log error over log time.
#pragma once

#include <span>
#include <string_view>

#include "app/compare/curve.h"

namespace pssmlt::compare {

// Slope of independent samples: -1 for mean squares. Other metrics saturate and have no law.
inline constexpr double slope_law = -1.0;
// Deviations below this have no practical meaning, however well they are measured.
inline constexpr double slope_tolerance = 0.1;
inline constexpr int least_slope_points = 3;

struct Slope {
  Number value;
  Number error;  // standard error
  std::string_view verdict = "unknown";
};

// Least squares in each run over its own points that are not near the floor; then the mean over
// runs, whose error comes from their spread, since points of one run are not independent. A single
// run's error is that of its residuals, which is too small for the same reason: no verdict then.
// `squared`: the metric is a mean of squares, slope_law holds.
Slope fit_slope(std::span<const Series> runs, const Number& floor, bool squared);

}  // namespace pssmlt::compare
