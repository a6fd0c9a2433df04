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

// Probability of a larger chi-square with n degrees of freedom (upper regularised gamma function,
// by its series or Lentz's continued fraction; Press et al. 2007, Numerical Recipes, 6.2).
inline double chi_square_p(double value, double n) {
  const double a = 0.5 * n, x = 0.5 * value;
  if (x <= 0.0) return 1.0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (double k = a + 1.0; term > sum * 1e-16; k += 1.0) sum += term *= x / k;
    return 1.0 - front * sum;
  }
  double b = x + 1.0 - a, c = 1e300, d = 1.0 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return front * h;
}

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
