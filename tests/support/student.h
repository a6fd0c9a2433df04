// Statistics that tests of random quantities decide by: Student's t, the normal distribution,
// chi-square.
#pragma once

#include <cmath>
#include <numbers>
#include <span>

namespace pssmlt::test {

// Two-sided p-value of Student's t with n degrees of freedom: with t = sqrt(n) tan(theta) its
// density is proportional to cos(theta)^(n-1), integrated by Simpson's rule.
inline double student_p(double t, double n) {
  constexpr int steps = 2000;
  const double begin = std::atan(std::abs(t) / std::sqrt(n));
  const double h = (std::numbers::pi / 2 - begin) / steps;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {  // the last term, cos(pi/2), is 0
    const double weight = i == 0 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(std::cos(begin + i * h), n - 1.0);
  }
  const double norm =
      std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2)) / std::sqrt(std::numbers::pi);
  return 2.0 * norm * sum * h / 3.0;
}

// |t| that is exceeded with probability p.
inline double student_limit(double p, double n) {
  double low = 0.0, high = 1e4;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (student_p(middle, n) > p ? low : high) = middle;
  }
  return high;
}

inline double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Mean and variance of the mean over independent values.
struct Estimate {
  double mean = 0.0, variance = 0.0;
  double error() const { return std::sqrt(variance); }
};

inline Estimate estimate(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  Estimate e;
  for (const double v : values) e.mean += v / n;
  for (const double v : values) e.variance += (v - e.mean) * (v - e.mean) / (n - 1.0) / n;
  return e;
}

}  // namespace pssmlt::test
