// The numbers of a session for the summary and --json.
#include <sys/resource.h>

#include <cmath>

#include "core/render/session.h"

namespace pssmlt {
namespace {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0;  // Linux counts kilobytes
}

nlohmann::json error_statistics(const ErrorEstimate& e) {
  nlohmann::json json;
  json["known"] = e.known;
  if (e.known) {
    json["relative_mse"] = e.relative_mse;
    json["interval"] = {e.low, e.high};
  } else {
    json["why"] = e.why;
  }
  if (e.mean_known) {
    json["mean"] = e.mean;
    json["mean_interval"] = {e.mean_low, e.mean_high};
  }
  return json;
}

nlohmann::json efficiency_statistics(const ChainEfficiency& e) {
  const PixelRegion& p = e.worst.pixels;
  return {{"median", e.median},
          {"regions", e.regions},
          {"worst", e.worst.effective},
          {"worst_pixels", {p.x0, p.y0, p.x1, p.y1}},
          {"worst_share", e.worst.share},
          {"between_over_within", {{"median", 1.0 / e.median}, {"worst", 1.0 / e.worst.effective}}},
          {"collapsed", e.collapsed()}};
}

}  // namespace

nlohmann::json Session::layer_statistics(const LayerState& layer) const {
  nlohmann::json json;
  json["name"] = layer.layer->name;
  json["integrator"] = layer.layer->integrator_name;
  json["sampler"] = layer.layer->sampler_name;
  json["rounds"] = layer.rounds;
  json["samples"] = layer.samples;
  json["samples_per_pixel"] = layer.samples / film_.pixels();
  json["chain"] = layer.layer->sampler->is_chain();
  nlohmann::json report = nlohmann::json::object();
  layer.layer->sampler->report(report);
  json["report"] = report;
  return json;
}

RejectionLog::Culprits Session::all_culprits() const {
  RejectionLog::Culprits all = earlier_culprits_;
  for (const auto& [of, count] : rejections_.culprits()) all[of] += count;
  return all;
}

nlohmann::json Session::rejection_statistics() const {
  nlohmann::json json;
  uint64_t total = 0;
  nlohmann::json causes = nlohmann::json::object();
  for (int c = 0; c < rejection_count; ++c) {
    const auto cause = static_cast<Rejection>(c);
    const uint64_t count = rejections_.of(cause) + earlier_rejections_[static_cast<size_t>(c)];
    total += count;
    if (count != 0) causes[std::string(to_string(cause))] = count;
  }
  json["total"] = total;
  json["causes"] = causes;
  json["plugins"] = nlohmann::json::array();
  for (const auto& [of, count] : all_culprits()) {
    json["plugins"].push_back(
        {{"plugin", of.first}, {"cause", to_string(of.second)}, {"count", count}});
  }
  json["examples"] = nlohmann::json::array();
  for (const ReplayKey& key : rejections_.examples()) {
    json["examples"].push_back({{"replay", key.text},
                                {"cause", to_string(key.cause)},
                                {"raster", {key.raster.x, key.raster.y}}});
  }
  return json;
}

nlohmann::json Session::statistics(const RenderResult& result) const {
  nlohmann::json json;
  const SceneFeatures& features = scene_.scene->features();
  double bootstrap = 0.0;
  for (const LayerState& l : layers_) bootstrap += l.start_seconds;
  const double render = result.seconds - bootstrap;
  json["seconds"] = {
      {"load", features.load_seconds},   {"acceleration_structure", features.accel_seconds},
      {"bootstrap", bootstrap},          {"render", render},
      {"checkpoints", checkpoint_cost_}, {"earlier_runs", earlier_seconds_}};
  json["threads"] = pool_.threads();
  json["seed"] = settings_.seed;
  json["stopped_by"] = to_string(result.stop);
  json["resumed"] = resumed_;
  json["samples"] = result.samples;
  json["layers"] = nlohmann::json::array();
  for (size_t l = 0; l < layers_.size(); ++l) {
    json["layers"].push_back(layer_statistics(layers_[l]));
    if (l < result.efficiency.size() && result.efficiency[l]) {
      json["layers"].back()["efficiency"] = efficiency_statistics(*result.efficiency[l]);
    }
  }
  json["warnings"] = result.warnings;
  RayCounters rays = earlier_rays_;
  for (const RayCounters& r : rays_) {
    rays.nearest += r.nearest;
    rays.shadow += r.shadow;
  }
  const auto total = static_cast<double>(rays.nearest + rays.shadow);
  json["rays"] = {{"nearest", rays.nearest},
                  {"shadow", rays.shadow},
                  {"per_second", result.seconds > 0.0 ? total / result.seconds : 0.0}};
  json["error"] = error_statistics(result.error);
  json["rejected"] = rejection_statistics();
  json["memory"] = {{"peak_bytes", peak_memory()},
                    {"film_bytes", film_.bytes()},
                    {"acceleration_structure_bytes", features.accel_bytes}};
  json["left_out"] = features.left_out;
  return json;
}

}  // namespace pssmlt
