// Means over independent runs with 95 % intervals.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

namespace pssmlt::compare {

// nullopt: not known. It becomes null in data.json and an empty field in curves.csv.
using Number = std::optional<double>;
nlohmann::json to_json(const Number& number);  // null too where not finite

struct Interval {
  Number value, low, high;
};

// Geometric mean of positive values; the interval is Student's t on their logarithms, unknown for a
// single value. All unknown without values, or if one is not positive or not finite.
Interval geometric_mean(std::span<const double> values);

}  // namespace pssmlt::compare
