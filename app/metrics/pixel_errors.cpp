#include "app/metrics/pixel_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/render/error_estimate.h"

namespace pssmlt {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

double ratio(double numerator, double denominator) {
  return numerator == 0.0 ? 0.0 : numerator / denominator;
}

// error(x, r): of one channel.
template <typename Error>
ErrorMap map_of(const PicturePair& pair, const Error& error) {
  ErrorMap map(pair.pixels(), nan_value);
  for (size_t i = 0; i < map.size(); ++i) {
    if (!pair.counts[i]) continue;
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) {
      sum +=
          error(static_cast<double>(pair.picture[i][c]), static_cast<double>(pair.reference[i][c]));
    }
    map[i] = sum / 3.0;
  }
  return map;
}

}  // namespace

ErrorMap squared_errors(const PicturePair& pair) {
  return map_of(pair, [](double x, double r) { return sqr(x - r); });
}

ErrorMap relative_squared_errors(const PicturePair& pair) {
  const double epsilon = relative_mse_epsilon * sqr(pair.reference_mean);
  return map_of(pair, [=](double x, double r) { return ratio(sqr(x - r), sqr(r) + epsilon); });
}

ErrorMap trimmed_relative_squared_errors(const PicturePair& pair) {
  ErrorMap map = relative_squared_errors(pair);
  std::vector<size_t> order;
  for (size_t i = 0; i < map.size(); ++i) {
    if (pair.counts[i]) order.push_back(i);
  }
  const auto out = static_cast<std::ptrdiff_t>(order.size() / 1000);
  std::ranges::nth_element(order, order.begin() + out, [&map](size_t a, size_t b) {
    return map[a] > map[b] || (map[a] == map[b] && a < b);
  });
  for (std::ptrdiff_t i = 0; i < out; ++i) map[order[static_cast<size_t>(i)]] = nan_value;
  return map;
}

ErrorMap symmetric_errors(const PicturePair& pair) {
  const double epsilon = smape_epsilon * std::abs(pair.reference_mean);
  return map_of(pair, [=](double x, double r) {
    return ratio(std::abs(x - r), std::abs(x) + std::abs(r) + epsilon);
  });
}

double mean_error(const ErrorMap& map) {
  double sum = 0.0, count = 0.0;
  for (const double value : map) {
    if (std::isnan(value)) continue;
    sum += value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : nan_value;
}

}  // namespace pssmlt
