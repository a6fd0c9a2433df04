#include "tests/app/report/sample_data.h"

#include <limits>

#include "app/report/report.h"
#include "tests/app/report/sample_results.h"

namespace pssmlt::sample {
namespace {

using nlohmann::json;

std::string scene_name(int scene, bool hostile) {
  if (hostile) return "</script><script>window.hostile = 3</script>";
  constexpr std::array<const char*, 4> names = {"door-ajar", "glass-caustics", "bidir-room",
                                                "mirror-maze"};
  return scene < 4 ? names[static_cast<size_t>(scene)] : "scene " + std::to_string(scene + 1);
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
          {"warnings", scene == 1 ? json::array({"media contradict"}) : json::array()},
          {"end_seconds", 59.5},
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
      const double ratio = 1.0 + 0.8 * t;  // speed-up
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
