// Thresholds for randomised tests, derived from the probability of a false alarm.
#pragma once

#include <cmath>
#include <cstddef>

namespace pssmlt::test {

// P(chi-square with `degrees` degrees of freedom >= x): the regularised incomplete gamma function
// Q(degrees / 2, x / 2), by series or continued fraction (Abramowitz and Stegun 6.5.29, 6.5.31).
inline double chi_square_tail(double x, double degrees) {
  const double a = 0.5 * degrees, z = 0.5 * x;
  if (!(z > 0.0)) return 1.0;
  const double front = std::exp(a * std::log(z) - z - std::lgamma(a));
  if (z < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > 1e-17 * sum; ++n) {
      term *= z / (a + n);
      sum += term;
    }
    return 1.0 - front * sum;
  }
  constexpr double tiny = 1e-300;
  double b = z + 1.0 - a, c = 1.0 / tiny, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double k = -n * (n - a);
    b += 2.0;
    d = k * d + b;
    d = 1.0 / (std::fabs(d) < tiny ? tiny : d);
    c = b + k / c;
    if (std::fabs(c) < tiny) c = tiny;
    h *= d * c;
    if (std::fabs(d * c - 1.0) < 1e-15) break;
  }
  return front * h;
}

// A chi-square test fails below this tail probability: its false-alarm probability.
inline constexpr double false_alarm = 1e-7;
// |z| of a normal variable above which a test fails: two-sided false-alarm probability 1e-7.
inline constexpr double z_limit = 5.327;

// Chi-square statistic of counts against expected counts, as a tail probability. `lost` degrees of
// freedom: 1 if the totals agree by construction.
template <typename Counts, typename Expected>
double chi_square_p(const Counts& counts, const Expected& expected, int lost = 1) {
  double x = 0.0;
  size_t bins = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] <= 0.0) {
      if (counts[i] > 0) return 0.0;
      continue;
    }
    const double d = static_cast<double>(counts[i]) - expected[i];
    x += d * d / expected[i];
    ++bins;
  }
  return chi_square_tail(x, static_cast<double>(bins) - lost);
}

}  // namespace pssmlt::test
