// How far the picture is from the truth, estimated without knowing the truth: from two half images
// (pixels) and from groups of rounds or chains (the picture's mean).
#pragma once

#include <span>
#include <string>
#include <vector>

namespace pssmlt {

// relMSE is the mean over pixels and channels of variance / (value^2 + epsilon), where value is
// what the truth is likely to be (core/render/relative_denominators.h) and epsilon =
// relative_mse_epsilon * (the picture's mean luminance)^2, so that it does not change with
// exposure.
inline constexpr double relative_mse_epsilon = 0.01;
// Fewer groups than this say nothing.
inline constexpr int least_groups = 8;
// Fewer contributing bootstrap samples than this, and nothing is known about b: of n independent
// finds n is known to a relative error of 1 / sqrt(n), a third here, and what n = 3 missed is not.
inline constexpr int least_bootstrap = 10;

// 95 % intervals. What cannot be estimated is not known, and `why` says so.
struct ErrorEstimate {
  bool known = false;
  std::string why;
  double relative_mse = 0.0, low = 0.0, high = 0.0;
  bool mean_known = false;
  double mean = 0.0, mean_low = 0.0, mean_high = 0.0;  // of the luminance
  double mean_error = 0.0;                             // its standard error
};

// What one layer's groups say about the mean.
struct GroupMean {
  double mean = 0.0;    // estimate of the whole layer's mean by this group alone
  double weight = 0.0;  // proportional to its number of samples; 0: nothing yet
};
struct MeanEstimate {
  double mean = 0.0, variance = 0.0;
  int groups = 0;
};
MeanEstimate estimate_mean(std::span<const GroupMean> groups);

// 0.975 quantile of Student's t with n >= 3 degrees of freedom (Abramowitz and Stegun 26.7.5).
double student_quantile(double degrees);

// Sums of pixel contributions variance / (value^2 + epsilon) over cells of pixels whose errors are
// independent from cell to cell. `common` is the relMSE of a factor common to the picture (b).
void estimate_relative_mse(std::span<const double> cells, double count, double common,
                           ErrorEstimate& estimate);

}  // namespace pssmlt
