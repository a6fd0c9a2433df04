#include "app/compare/run_record.h"

#include <limits>

#include "app/metrics/metrics.h"

namespace pssmlt::compare {
namespace {

using nlohmann::json;

Number number_of(const json& j) {
  if (j.is_null()) return std::nullopt;
  return j.get<double>();
}

// A metric that is not finite is written as null.
double value_of(const json& j) {
  return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>();
}

RunPoint point_from_json(const json& j) {
  RunPoint p;
  p.nominal = j.at("nominal");
  p.seconds = j.at("seconds");
  p.samples = j.at("samples");
  p.rays = j.at("rays");
  for (const Metric& m : metrics()) {
    p.metrics.push_back(value_of(j.at("metrics").at(std::string(m.id))));
  }
  p.mean_bias = value_of(j.at("mean_bias"));
  p.mean_bias_error = number_of(j.at("mean_bias_error"));
  const json& estimate = j.at("estimate");
  p.estimate_known = estimate.at("known");
  if (p.estimate_known) {
    p.estimate = value_of(estimate.at("relmse"));
    p.estimate_low = value_of(estimate.at("low"));
    p.estimate_high = value_of(estimate.at("high"));
  }
  return p;
}

}  // namespace

json to_json(const RunPoint& p) {
  json values = json::object();
  const auto all = metrics();
  for (size_t m = 0; m < all.size(); ++m) {
    values[std::string(all[m].id)] = to_json(Number(p.metrics[m]));
  }
  const auto known = [&](double v) { return p.estimate_known ? json(v) : json(); };
  return {{"nominal", p.nominal},
          {"seconds", p.seconds},
          {"samples", p.samples},
          {"rays", p.rays},
          {"metrics", values},
          {"mean_bias", to_json(Number(p.mean_bias))},
          {"mean_bias_error", to_json(p.mean_bias_error)},
          {"estimate",
           {{"known", p.estimate_known},
            {"relmse", known(p.estimate)},
            {"low", known(p.estimate_low)},
            {"high", known(p.estimate_high)}}}};
}

json run_json(const RunRecord& run) {
  json points = json::array();
  for (const RunPoint& p : run.points) points.push_back(to_json(p));
  return {{"seed", run.seed}, {"points", points}, {"statistics", run.statistics}};
}

json record_to_json(const RunRecord& run) {
  json j = run_json(run);
  j["nominal"] = run.nominal;
  j["images"] = json::array();
  for (const RunImage& i : run.images) {
    j["images"].push_back({{"seconds", i.seconds}, {"image", i.image}, {"exact", i.exact}});
  }
  return j;
}

RunRecord record_from_json(const json& j) {
  RunRecord run;
  run.seed = j.at("seed");
  run.nominal = j.at("nominal").get<std::vector<double>>();
  for (const json& p : j.at("points")) run.points.push_back(point_from_json(p));
  for (const json& i : j.at("images")) {
    run.images.push_back({i.at("seconds"), i.at("image"), i.at("exact")});
  }
  run.statistics = j.at("statistics");
  return run;
}

std::vector<Series> series_of(const std::vector<RunRecord>& runs, size_t metric) {
  std::vector<Series> all;
  for (const RunRecord& run : runs) {
    Series& series = all.emplace_back();
    for (const RunPoint& p : run.points) series.push_back({p.seconds, p.metrics[metric]});
  }
  return all;
}

}  // namespace pssmlt::compare
