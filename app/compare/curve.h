// Error over time: interpolation in a run, mean curve over runs, times at which an error is
// reached.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/compare/interval.h"

namespace pssmlt::compare {

struct CurvePoint {
  double seconds = 0.0, error = 0.0;
};
using Series = std::vector<CurvePoint>;  // one run, ascending in time

// Above this share of a value, the reference's own error spoils it.
inline constexpr double floor_share = 0.25;
bool near_floor(double error, const Number& floor);

// The error at a time, by straight lines in log-log between the run's own points. nullopt before
// the first and after the last point (nothing is extrapolated) and beside errors that have no
// logarithm.
Number error_at(const Series& run, double seconds);

struct Curve {
  std::vector<double> seconds;
  std::vector<Interval> errors;  // geometric mean over runs; unknown unless all runs reach there
  std::vector<bool> near_floor;
};
Curve mean_curve(std::span<const Series> runs, std::span<const double> seconds,
                 const Number& floor);

// When a run first has an error, by straight lines in log-log.
struct Crossing {
  Number seconds;        // nullopt: not reached
  bool at_most = false;  // the run's first point is already below: it was reached then or before
};
Crossing first_time(const Series& run, double error);

// Geometric mean over runs of the times at which they first have an error.
struct TimeTo {
  double error = 0.0;
  Interval seconds;      // unknown unless all runs reach the error
  bool at_most = false;  // an upper bound, since a run had reached it at its first point
};
TimeTo time_to(std::span<const Series> runs, double error);

}  // namespace pssmlt::compare
