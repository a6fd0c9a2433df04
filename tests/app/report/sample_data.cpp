#include "tests/app/report/sample_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "app/report/report.h"

namespace pssmlt::sample {
namespace {

using nlohmann::json;

constexpr double seconds = 60.0;
constexpr std::array<const char*, 5> metric_ids = {"mse", "relmse", "relmse_trimmed", "smape",
                                                   "flip"};

std::string technique_name(int technique, bool hostile) {
  if (hostile && technique == 1) {
    return "<script>window.hostile = 1</script><img src=x onerror='window.hostile = 2'>";
  }
  constexpr std::array<const char*, 4> names = {"path", "bdpt", "mlt", "mlt(path)"};
  return technique < 4 ? names[static_cast<size_t>(technique)]
                       : "technique " + std::to_string(technique + 1);
}

std::string scene_name(int scene, bool hostile) {
  if (hostile) return "</script><script>window.hostile = 3</script>";
  constexpr std::array<const char*, 4> names = {"door-ajar", "glass-caustics", "bidir-room",
                                                "mirror-maze"};
  return scene < 4 ? names[static_cast<size_t>(scene)] : "scene " + std::to_string(scene + 1);
}

std::string image_id(int scene, int technique, int snapshot) {
  return std::to_string(scene) + "-" + std::to_string(technique) + "-" + std::to_string(snapshot);
}

double time_of(int snapshot, int snapshots) {
  return seconds * std::pow(2.0, 0.5 * (snapshot + 1 - snapshots));
}

// Law of the invented errors: level times seconds^slope.
struct Law {
  double level, slope;
  double at(double t) const { return level * std::pow(t, slope); }
};

Law law_of(int technique, int scene, size_t metric) {
  constexpr std::array<double, 5> scales = {2.0, 1.0, 0.4, 0.9, 0.5};
  const double level = scales[metric] / (1.0 + 1.7 * technique) * (1.0 + 0.5 * scene);
  const double slope = technique == 0 ? -1.0 : technique == 1 ? -1.12 : -0.9 + 0.05 * scene;
  return {level, metric < 3 ? slope : slope / 2};
}

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
    result["at_end"][id] = {{"mean", end}, {"low", end * 0.87}, {"high", end * 1.15}};
    result["speed_up"][id] = {{"value", up}, {"low", up * 0.8}, {"high", up * 1.25}};
    result["efficiency"][id] = 1 / (end * seconds);
    result["time_to"][id] = json::array();
    for (const double factor : {8.0, 2.0, 0.5}) {
      const double target = first.at(seconds) * factor;
      const double t = std::pow(target / law.level, 1 / law.slope);
      const bool reached = t <= seconds;
      result["time_to"][id].push_back({{"error", target},
                                       {"seconds", reached ? json(t) : json()},
                                       {"low", reached ? json(0.9 * t) : json()},
                                       {"high", reached ? json(1.2 * t) : json()}});
    }
  }
}

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
      {"acceptance", technique == 2 ? json{{"large", 0.21}, {"small", 0.58}} : json()},
      {"b", technique == 2 ? json{{"value", 0.431}, {"relative_error", 0.002}} : json()},
      {"non_finite", technique == 1 ? 3 : 0},
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

json scene_result(const Settings& s, int scene) {
  json results = json::array();
  for (int t = 0; t < s.techniques; ++t) results.push_back(technique_result(s, t, scene));
  if (s.bare) return {{"name", scene_name(scene, s.hostile)}, {"techniques", results}};
  json floor;
  for (size_t m = 0; m < metric_ids.size(); ++m) {
    floor[metric_ids[m]] = s.gaps ? json() : json(0.5 * law_of(2, scene, m).at(seconds));
  }
  return {{"name", scene_name(scene, s.hostile)},
          {"file", "scenes/" + std::to_string(scene) + ".txt"},
          {"hash", "5f0c9a7be11d2233"},
          {"width", s.width},
          {"height", s.height},
          {"load_seconds", 0.41},
          {"reference",
           {{"source", "made"},
            {"techniques", {"bdpt", "mlt"}},
            {"seconds", 600.0},
            {"image", std::to_string(scene) + "-reference"},
            {"floor", floor},
            {"agreement",
             {{"blocks", 144},
              {"chi_square", s.biased ? 391.0 : 150.2},
              {"p_value", s.biased ? 1e-24 : 0.34},
              {"biased", s.biased},
              {"text", s.biased ? "bdpt and mlt disagree by 2.1 % in the upper right"
                                : "the halves agree"}}}}},
          {"techniques", results}};
}

json suite_of(const Settings& s) {
  json suite;
  for (size_t m = 0; m < metric_ids.size(); ++m) {
    for (int t = 0; t < s.techniques; ++t) {
      const double ratio = 1 / (1.0 + 0.8 * t);
      suite[metric_ids[m]][technique_name(t, s.hostile)] = {
          {"geometric_mean", ratio}, {"low", 0.9 * ratio}, {"high", 1.1 * ratio}};
    }
  }
  return suite;
}

}  // namespace

json data(const Settings& s) {
  json metrics = json::array(), techniques = json::array(), scenes = json::array();
  constexpr std::array<const char*, 5> names = {"MSE", "relative MSE", "relative MSE, trimmed",
                                                "SMAPE", "HDR-FLIP"};
  for (size_t m = 0; m < metric_ids.size(); ++m) {
    metrics.push_back({{"id", metric_ids[m]},
                       {"name", names[m]},
                       {"formula", m == 1 ? "mean of (x − r)² / (r² + ε)" : "invented"},
                       {"note", "in units of nothing"}});
  }
  for (int t = 0; t < s.techniques; ++t) {
    techniques.push_back({{"name", technique_name(t, s.hostile)},
                          {"integrator", t == 0 || t == 3 ? "path" : "bdpt"},
                          {"sampler", t < 2 ? "sobol" : "pssmlt"},
                          {"settings", {"integrator.maxdepth=8"}}});
  }
  for (int scene = 0; scene < s.scenes; ++scene) scenes.push_back(scene_result(s, scene));
  if (s.bare) return {{"format", 1}, {"techniques", techniques}, {"scenes", scenes}};
  return {
      {"format", 1},
      {"program", {{"version", "0.1.0"}, {"libraries", {{"Embree", "3.13.5"}}}}},
      {"machine", {{"processor", "An invented processor"}, {"threads", 2}, {"memory_bytes", 16e9}}},
      {"command", "pssmlt compare scenes/0.txt --techniques path,bdpt,mlt --time 60s --runs 3"},
      {"created", "2026-01-02T03:04:05Z"},
      {"partial", s.partial},
      {"why_partial", s.partial ? "Interrupted after 2 of 3 runs." : ""},
      {"settings",
       {{"seconds", seconds},
        {"runs", s.runs},
        {"snapshots", s.snapshots},
        {"threads", 2},
        {"seed", 0}}},
      {"metrics", metrics},
      {"techniques", techniques},
      {"scenes", scenes},
      {"suite", s.scenes > 1 ? suite_of(s) : json()}};
}

void write_report(const std::filesystem::path& folder, const Settings& s) {
  ReportWriter writer(folder);
  for (int scene = 0; scene < s.scenes; ++scene) {
    const Pictures pictures(s.width, s.height, scene);
    Image image(s.width, s.height, 3);
    image.data = pictures.render(0, std::numeric_limits<double>::infinity());
    writer.add_image(std::to_string(scene) + "-reference", image, Precision::exact);
    for (int t = 0; t < s.techniques; ++t) {
      for (int k = 0; k < s.snapshots; ++k) {
        image.data = pictures.render(t, time_of(k, s.snapshots));
        const bool last = k + 1 == s.snapshots;
        // Something to be marked: a pixel that is not a number.
        if (last && t == 0) image.data[0] = std::numeric_limits<float>::quiet_NaN();
        writer.add_image(image_id(scene, t, k), image,
                         last ? Precision::exact : Precision::logarithmic);
      }
    }
  }
  writer.finish(data(s));
}

}  // namespace pssmlt::sample
