// Quantiles and tails of the distributions that intervals and tests are made from (Boost.Math).
#pragma once

namespace pssmlt::compare {

// 0.975 quantile of Student's t: 95 % intervals reach so many standard errors to either side.
double student_95(double degrees);
// P(|t| >= |value|) of Student's t.
double student_tail(double value, double degrees);
// P(chi-square >= value); the number of degrees need not be whole.
double chi_square_tail(double value, double degrees);
// z with P(|normal| >= z) = tail: a two-sided tail as a normal deviation.
double normal_deviation(double tail);

}  // namespace pssmlt::compare
