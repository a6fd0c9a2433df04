#include "app/compare/slope.h"

#include <cmath>
#include <vector>

#include "app/compare/distributions.h"

namespace pssmlt::compare {
namespace {

// A regression line's slope and its standard error.
struct Line {
  double slope = 0.0, error = 0.0;
};

std::optional<Line> regression(const Series& run, const Number& floor) {
  std::vector<double> x, y;
  for (const CurvePoint& p : run) {
    if (!(p.error > 0.0) || !std::isfinite(p.error) || near_floor(p.error, floor)) continue;
    x.push_back(std::log(p.seconds));
    y.push_back(std::log(p.error));
  }
  const auto n = static_cast<double>(x.size());
  if (x.size() < least_slope_points) return std::nullopt;
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, residuals = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0.0)) return std::nullopt;
  Line line{.slope = xy / xx, .error = 0.0};
  for (size_t i = 0; i < x.size(); ++i) {
    const double r = y[i] - mean_y - line.slope * (x[i] - mean_x);
    residuals += r * r;
  }
  line.error = std::sqrt(residuals / (n - 2.0) / xx);
  return line;
}

std::string_view judge(double slope, double half_width) {
  if (slope + half_width < slope_law - slope_tolerance) return "steeper";
  if (slope - half_width > slope_law + slope_tolerance) return "has not mixed";
  // An interval that holds half of the law, or twice it, tells nothing.
  if (half_width > -0.5 * slope_law) return "unknown";
  return "as independent samples";
}

}  // namespace

Slope fit_slope(std::span<const Series> runs, const Number& floor, bool squared) {
  std::vector<Line> lines;
  for (const Series& run : runs) {
    const std::optional<Line> line = regression(run, floor);
    if (!line) return {};
    lines.push_back(*line);
  }
  if (lines.empty()) return {};
  if (lines.size() == 1) return {lines[0].slope, lines[0].error, "unknown"};
  const auto n = static_cast<double>(lines.size());
  double mean = 0.0, squares = 0.0;
  for (const Line& line : lines) mean += line.slope / n;
  for (const Line& line : lines) squares += (line.slope - mean) * (line.slope - mean);
  const double error = std::sqrt(squares / (n - 1.0) / n);
  return {mean, error, squared ? judge(mean, student_95(n - 1.0) * error) : "unknown"};
}

}  // namespace pssmlt::compare
