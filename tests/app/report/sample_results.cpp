#include "tests/app/report/sample_results.h"

#include <cmath>
#include <random>

namespace pssmlt::sample {

using nlohmann::json;

std::string technique_name(int technique, bool hostile) {
  if (hostile && technique == 1) {
    return "<script>window.hostile = 1</script><img src=x onerror='window.hostile = 2'>";
  }
  constexpr std::array<const char*, 4> names = {"path", "bdpt", "mlt", "mlt(path)"};
  return technique < 4 ? names[static_cast<size_t>(technique)]
                       : "technique " + std::to_string(technique + 1);
}

std::string image_id(int scene, int technique, int snapshot) {
  return std::to_string(scene) + "-" + std::to_string(technique) + "-" + std::to_string(snapshot);
}

double time_of(int snapshot, int snapshots) {
  return seconds * std::pow(2.0, 0.5 * (snapshot + 1 - snapshots));
}

Law law_of(int technique, int scene, size_t metric) {
  constexpr std::array<double, 5> scales = {2.0, 1.0, 0.4, 0.9, 0.5};
  const double level = scales[metric] / (1.0 + 1.7 * technique) * (1.0 + 0.5 * scene);
  const double slope = technique == 0 ? -1.0 : technique == 1 ? -1.12 : -0.9 + 0.05 * scene;
  return {level, metric < 3 ? slope : slope / 2};
}

namespace {

json curve(const Settings& s, int technique, int scene, size_t metric, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 0.04);
  json mean = json::array(), low = json::array(), high = json::array(), near = json::array();
  for (int k = 0; k < s.snapshots; ++k) {
    const Law law = law_of(technique, scene, metric);
    const double value = law.at(time_of(k, s.snapshots)) * std::exp(normal(random));
    mean.push_back(s.gaps && technique == 1 && k == 2 ? json() : json(value));
    low.push_back(s.runs > 1 ? json(value * 0.85) : json());
    high.push_back(s.runs > 1 ? json(value * 1.18) : json());
    near.push_back(value < 3 * law_of(2, scene, metric).at(seconds));
  }
  return {{"mean", mean}, {"low", low}, {"high", high}, {"near_floor", near}};
}

json runs(const Settings& s, int technique, int scene, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 0.2);
  json all = json::array();
  for (int run = 0; run < s.runs; ++run) {
    json points = json::array();
    for (int k = 0; k < s.snapshots; ++k) {
      const double t = time_of(k, s.snapshots), truth = law_of(technique, scene, 1).at(t);
      const double estimate = truth * (technique == 2 ? 0.7 : 1.05) * std::exp(normal(random));
      points.push_back({{"nominal", t},
                        {"seconds", t * 1.01},
                        {"samples", 1.2e6 * t},
                        {"rays", 4e6 * t},
                        {"metrics", {{"relmse", truth}}},
                        {"mean_bias", 0.002 * normal(random)},
                        {"mean_bias_error", 0.001},
                        {"estimate",
                         {{"known", k > 0},
                          {"relmse", estimate},
                          {"low", estimate * 0.8},
                          {"high", estimate * 1.3}}}});
    }
    all.push_back({{"seed", run}, {"points", points}, {"statistics", {{"large", "left out"}}}});
  }
  return all;
}

json images(const Settings& s, int technique, int scene) {
  json all = json::array();
  for (int k = 0; k < s.snapshots; ++k) {
    all.push_back({{"seconds", time_of(k, s.snapshots)},
                   {"image", image_id(scene, technique, k)},
                   {"precision", k + 1 == s.snapshots ? "exact" : "logarithmic"}});
  }
  return all;
}

void add_metrics(json& result, const Settings& s, int technique, int scene, std::mt19937& random) {
  for (size_t m = 0; m < metric_ids.size(); ++m) {
    const char* id = metric_ids[m];
    const Law law = law_of(technique, scene, m), first = law_of(0, scene, m);
    const double end = law.at(seconds), up = first.at(seconds) / end;
    result["curve"][id] = curve(s, technique, scene, m, random);
    result["slope"][id] = {{"value", law.slope},
                           {"error", 0.03},
                           {"verdict", technique == 0   ? "as independent samples"
                                       : technique == 1 ? "steeper"
                                                        : "has not mixed"}};
    result["at_end"][id] = {
        {"mean", end}, {"low", end * 0.87}, {"high", end * 1.15}, {"near_floor", technique == 2}};
    result["speed_up"][id] = {{"value", up}, {"low", up * 0.8}, {"high", up * 1.25}};
    result["efficiency"][id] = 1 / (end * seconds);
    result["time_to"][id] = json::array();
    for (const double factor : {8.0, 2.0, 0.5}) {
      const double target = first.at(seconds) * factor;
      const double t = std::pow(target / law.level, 1 / law.slope);
      const bool reached = t <= seconds;
      result["time_to"][id].push_back({{"error", target},
                                       {"seconds", reached ? json(t) : json()},
                                       {"at_most", technique == 2 && factor == 8.0},
                                       {"low", reached ? json(0.9 * t) : json()},
                                       {"high", reached ? json(1.2 * t) : json()}});
    }
  }
}

}  // namespace

json technique_result(const Settings& s, int technique, int scene) {
  if (s.bare) {
    return {{"name", technique_name(technique, s.hostile)},
            {"images", images(s, technique, scene)}};
  }
  std::mt19937 random(static_cast<unsigned>(17 * technique + scene));
  json result = {
      {"name", technique_name(technique, s.hostile)},
      {"parameters",
       {{"integrator", {{"maxdepth", 8}, {"rrdepth", 4}, {"regularize", false}}},
        {"sampler", {{"sigma", 0.02}, {"largestepprobability", 0.3}, {"kernel", "gaussian"}}}}},
      {"runs", runs(s, technique, scene, random)},
      {"calibration", {{"ratio", technique == 2 ? 0.7 : 1.04}, {"low", 0.6}, {"high", 1.2}}},
      {"rates", {{"samples_per_second", 1.2e6 / (1 + technique)}, {"rays_per_second", 4.1e6}}},
      {"peak_bytes", 512e6},
      {"film_bytes", 3e6},
      {"acceptance", technique == 2 ? json{{"large", 0.21}, {"small", 0.58}} : json()},
      {"b", technique == 2 ? json{{"value", 0.431}, {"relative_error", 0.002}} : json()},
      {"non_finite", technique == 1 ? 3 : 0},
      {"warnings", technique == 2 && scene == 0 ? json::array({"chains <hardly> move"}) : json()},
      {"images", images(s, technique, scene)}};
  for (int k = 0; k < s.snapshots; ++k) {
    result["curve"]["seconds"].push_back(time_of(k, s.snapshots));
  }
  add_metrics(result, s, technique, scene, random);
  if (s.gaps && technique == 1) {
    for (const char* key : {"slope", "speed_up", "calibration", "rates", "efficiency", "runs"}) {
      result.erase(key);
    }
    result["peak_bytes"] = nullptr;
    result["non_finite"] = nullptr;
  }
  return result;
}

}  // namespace pssmlt::sample
