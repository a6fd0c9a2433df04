#include "app/compare/curve.h"

#include <algorithm>
#include <cmath>

namespace pssmlt::compare {
namespace {

bool has_logarithm(double error) { return error > 0.0 && std::isfinite(error); }

// y at x on the line through two points, all in logarithms.
double on_line(double x0, double y0, double x1, double y1, double x) {
  const double t = (std::log(x) - std::log(x0)) / (std::log(x1) - std::log(x0));
  return std::exp(std::log(y0) + t * (std::log(y1) - std::log(y0)));
}

}  // namespace

bool near_floor(double error, const Number& floor) { return floor && *floor > floor_share * error; }

Number error_at(const Series& run, double seconds) {
  const auto after = std::ranges::lower_bound(run, seconds, {}, &CurvePoint::seconds);
  if (after == run.end()) return std::nullopt;
  if (after->seconds == seconds) return after->error;
  if (after == run.begin()) return std::nullopt;
  const CurvePoint& a = *(after - 1);
  const CurvePoint& b = *after;
  if (!has_logarithm(a.error) || !has_logarithm(b.error)) return std::nullopt;
  return on_line(a.seconds, a.error, b.seconds, b.error, seconds);
}

Curve mean_curve(std::span<const Series> runs, std::span<const double> seconds,
                 const Number& floor) {
  Curve curve;
  for (const double s : seconds) {
    std::vector<double> values;
    for (const Series& run : runs) {
      if (const Number v = error_at(run, s)) values.push_back(*v);
    }
    const bool all = values.size() == runs.size();
    const Interval mean = all ? geometric_mean(values) : Interval{};
    curve.seconds.push_back(s);
    curve.errors.push_back(mean);
    curve.near_floor.push_back(mean.value && near_floor(*mean.value, floor));
  }
  return curve;
}

Crossing first_time(const Series& run, double error) {
  for (size_t i = 0; i < run.size(); ++i) {
    if (!(run[i].error <= error)) continue;
    if (i == 0) return {run[0].seconds, true};
    const CurvePoint &a = run[i - 1], &b = run[i];
    // An error of exactly 0 has no place on the line: the point itself is what is known.
    if (!has_logarithm(a.error) || !has_logarithm(b.error)) return {b.seconds, true};
    return {on_line(a.error, a.seconds, b.error, b.seconds, error), false};
  }
  return {};
}

TimeTo time_to(std::span<const Series> runs, double error) {
  TimeTo result;
  result.error = error;
  std::vector<double> times;
  for (const Series& run : runs) {
    const Crossing crossing = first_time(run, error);
    if (!crossing.seconds) return {.error = error, .seconds = {}, .at_most = false};
    times.push_back(*crossing.seconds);
    result.at_most = result.at_most || crossing.at_most;
  }
  result.seconds = geometric_mean(times);
  if (result.at_most) result.seconds.low.reset();  // a bound from above has no lower end
  return result;
}

}  // namespace pssmlt::compare
