#include "app/compare/interval.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/compare/distributions.h"

namespace pssmlt::compare {

nlohmann::json to_json(const Number& number) {
  if (!number || !std::isfinite(*number)) return nullptr;
  return *number;
}

Interval geometric_mean(std::span<const double> values) {
  if (values.empty()) return {};
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double v : values) {
    if (!(v > 0.0) || !std::isfinite(v)) return {};
    mean += std::log(v) / n;
  }
  if (values.size() == 1) return {.value = values[0], .low = {}, .high = {}};
  Interval result{.value = std::exp(mean), .low = {}, .high = {}};
  double squares = 0.0;
  for (const double v : values) squares += (std::log(v) - mean) * (std::log(v) - mean);
  const double half = student_95(n - 1.0) * std::sqrt(squares / (n - 1.0) / n);
  result.low = std::exp(mean - half);
  result.high = std::exp(mean + half);
  return result;
}

}  // namespace pssmlt::compare
