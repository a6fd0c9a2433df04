// The report's data: data.json as docs/compare.md and docs/report.md describe it, curves.csv.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/compare/analysis.h"
#include "app/compare/compare_options.h"
#include "app/compare/reference.h"

namespace pssmlt::compare {

// What is kept of a scene when its geometry is gone.
struct SceneReport {
  std::string name, file, hash;
  int width = 0, height = 0;
  double load_seconds = 0.0;
  std::vector<std::string> warnings;       // of the scene
  Reference reference;                     // without its pictures
  std::string reference_image;             // id in the report
  std::vector<nlohmann::json> parameters;  // by technique: {"integrator": {..}, "sampler": {..}}
  std::vector<std::string> integrators, samplers;  // by technique, as found
  std::vector<std::vector<RunRecord>> runs;        // [run][technique]
  SceneResult result;
};

// The plugins of a technique in a scene with all their parameters.
nlohmann::json parameters_json(const std::vector<Layer>& layers);
// "bdpt", or "path + bdpt" for two layers.
std::string integrator_names(const std::vector<Layer>& layers);
std::string sampler_names(const std::vector<Layer>& layers);

// `why_partial`: "" if the comparison is complete.
nlohmann::json report_json(const CompareOptions& options, const std::vector<SceneReport>& scenes,
                           const std::string& why_partial);

// Geometric means over scenes of the speed-ups over the first technique, by metric and technique:
// Student's t over scenes. null for fewer than two scenes.
nlohmann::json suite_json(const CompareOptions& options, const std::vector<SceneReport>& scenes);
Interval suite_mean(const std::vector<SceneReport>& scenes, size_t technique, size_t metric);

// One line for every point of every run; what is not known is empty.
std::string curves_csv(const CompareOptions& options, const std::vector<SceneReport>& scenes);

}  // namespace pssmlt::compare
