// Parts of the invented data that sample_data.cpp and sample_results.cpp share.
#pragma once

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/report/sample_data.h"

namespace pssmlt::sample {

inline constexpr double seconds = 60.0;
inline constexpr std::array<const char*, 5> metric_ids = {"mse", "relmse", "relmse_trimmed",
                                                          "smape", "flip"};

std::string technique_name(int technique, bool hostile);
std::string image_id(int scene, int technique, int snapshot);
double time_of(int snapshot, int snapshots);

// Law of the invented errors: level times seconds^slope.
struct Law {
  double level, slope;
  double at(double t) const { return level * std::pow(t, slope); }
};

Law law_of(int technique, int scene, size_t metric);

nlohmann::json technique_result(const Settings& s, int technique, int scene);

}  // namespace pssmlt::sample
