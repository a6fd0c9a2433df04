// What a run of one technique leaves: points of its error curves, statistics, names of pictures.
// As JSON they are the report's "runs" and what --resume reads.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/compare/curve.h"
#include "core/render/render.h"

namespace pssmlt::compare {

struct RunPoint {
  double nominal = 0.0, seconds = 0.0;  // when it was due, when it was taken [s]
  double samples = 0.0, rays = 0.0;
  std::vector<double> metrics;  // in the order of metrics()
  double mean_bias = 0.0;       // of the luminance's mean, relative to the reference's
  Number mean_bias_error;       // its standard error
  bool estimate_known = false;
  double estimate = 0.0, estimate_low = 0.0, estimate_high = 0.0;  // relMSE, without reference
};

struct RunImage {
  double seconds = 0.0;
  std::string image;  // id in the report
  bool exact = false;
};

struct RunRecord {
  uint64_t seed = 0;
  std::vector<double> nominal;  // times that snapshots were due [s]
  std::vector<RunPoint> points;
  std::vector<RunImage> images;
  nlohmann::json statistics;
};

nlohmann::json to_json(const RunPoint& point);
// What data.json shows of a run.
nlohmann::json run_json(const RunRecord& run);
// All of it, and back. Throws nlohmann::json::exception if it is not such a record.
nlohmann::json record_to_json(const RunRecord& run);
RunRecord record_from_json(const nlohmann::json& json);

// The points of one metric over time, of each run.
std::vector<Series> series_of(const std::vector<RunRecord>& runs, size_t metric);

}  // namespace pssmlt::compare
