#include "app/compare/report_data.h"

#include "app/compare/machine.h"
#include "app/metrics/metrics.h"

namespace pssmlt::compare {
namespace {

using nlohmann::json;

constexpr int format_version = 1;

json interval_json(const Interval& i) {
  return {{"low", to_json(i.low)}, {"high", to_json(i.high)}};
}
json value_json(const Interval& i) {
  json j = interval_json(i);
  j["value"] = to_json(i.value);
  return j;
}

std::string joined(const std::vector<Layer>& layers, std::string Layer::*name) {
  std::string text;
  for (const Layer& l : layers) text += (text.empty() ? "" : " + ") + l.*name;
  return text;
}

json reference_json(const SceneReport& s) {
  const Reference& r = s.reference;
  json floor = json::object();
  const auto all = metrics();
  for (size_t m = 0; m < all.size(); ++m) floor[std::string(all[m].id)] = to_json(r.floor[m]);
  json j = {{"source", r.source},
            {"file", r.file},
            {"techniques", r.techniques},
            {"seconds", r.source == "made" ? json(r.seconds) : json()},
            {"image", s.reference_image},
            {"floor", floor},
            {"mean_error", to_json(r.mean_error)}};
  j["agreement"] = r.agreement ? to_json(*r.agreement) : json();
  return j;
}

json curve_json(const TechniqueResult& t) {
  json j = {{"seconds", t.metrics.front().curve.seconds}};
  const auto all = metrics();
  for (size_t m = 0; m < all.size(); ++m) {
    json& c = j[std::string(all[m].id)];
    c = {{"mean", json::array()}, {"low", json::array()}, {"high", json::array()}};
    for (const Interval& e : t.metrics[m].curve.errors) {
      c["mean"].push_back(to_json(e.value));
      c["low"].push_back(to_json(e.low));
      c["high"].push_back(to_json(e.high));
    }
    c["near_floor"] = t.metrics[m].curve.near_floor;
  }
  return j;
}

json times_json(const std::vector<TimeTo>& times) {
  json j = json::array();
  for (const TimeTo& t : times) {
    j.push_back({{"error", t.error},
                 {"seconds", to_json(t.seconds.value)},
                 {"low", to_json(t.seconds.low)},
                 {"high", to_json(t.seconds.high)},
                 {"at_most", t.at_most}});
  }
  return j;
}

// By metric: slope, error at the end, speed-up, times, efficiency.
void add_results(json& j, const TechniqueResult& t) {
  const auto all = metrics();
  for (size_t m = 0; m < all.size(); ++m) {
    const std::string id(all[m].id);
    const MetricResult& r = t.metrics[m];
    j["slope"][id] = {{"value", to_json(r.slope.value)},
                      {"error", to_json(r.slope.error)},
                      {"verdict", r.slope.verdict}};
    j["at_end"][id] = interval_json(r.at_end);
    j["at_end"][id]["mean"] = to_json(r.at_end.value);
    j["at_end"][id]["near_floor"] = r.near_floor;
    j["speed_up"][id] = value_json(r.speed_up);
    j["time_to"][id] = times_json(r.time_to);
    j["efficiency"][id] = to_json(r.efficiency);
  }
  j["calibration"] = interval_json(t.calibration);
  j["calibration"]["ratio"] = to_json(t.calibration.value);
}

// What the sessions' statistics say, over all runs of a technique.
void add_statistics(json& j, const std::vector<RunRecord>& runs) {
  double samples = 0.0, rays = 0.0, seconds = 0.0, non_finite = 0.0, peak = 0.0, film = 0.0;
  for (const RunRecord& r : runs) {
    if (r.points.empty()) continue;
    samples += r.points.back().samples;
    rays += r.points.back().rays;
    seconds += r.points.back().seconds;
    non_finite += r.statistics["rejected"]["total"].get<double>();
    peak = std::max(peak, r.statistics["memory"]["peak_bytes"].get<double>());
    film = std::max(film, r.statistics["memory"]["film_bytes"].get<double>());
  }
  const auto rate = [&](double n) { return seconds > 0.0 ? json(n / seconds) : json(); };
  j["rates"] = {{"samples_per_second", rate(samples)}, {"rays_per_second", rate(rays)}};
  j["non_finite"] = non_finite;
  j["peak_bytes"] = peak;  // of the whole process: techniques share it
  j["film_bytes"] = film;
  j["warnings"] = json::array();
  for (const RunRecord& r : runs) {
    for (const json& w : r.statistics.value("warnings", json::array())) {
      if (std::ranges::find(j["warnings"], w) == j["warnings"].end()) j["warnings"].push_back(w);
    }
  }
  j["acceptance"] = j["b"] = nullptr;
  if (runs.empty() || !runs.front().statistics.contains("layers")) return;
  for (const json& layer : runs.front().statistics["layers"]) {
    const json& report = layer["report"];
    if (report.contains("acceptance")) j["acceptance"] = report["acceptance"];
    if (!report.contains("b")) continue;
    j["b"] = {{"value", report["b"]},
              {"standard_error", report.value("b_standard_error", json())},
              {"samples", report.value("b_samples", json())}};
  }
}

json technique_json(const CompareOptions& o, const SceneReport& s, size_t t) {
  json j = {{"name", o.techniques[t].name}, {"parameters", s.parameters[t]}};
  const std::vector<RunRecord> runs = runs_of(s.runs, t);
  j["runs"] = json::array();
  for (const RunRecord& r : runs) j["runs"].push_back(run_json(r));
  add_statistics(j, runs);
  j["images"] = json::array();
  if (!runs.empty()) {
    for (const RunImage& i : runs.front().images) {
      j["images"].push_back({{"seconds", i.seconds},
                             {"image", i.image},
                             {"precision", i.exact ? "exact" : "logarithmic"}});
    }
    j["curve"] = curve_json(s.result.techniques[t]);
    add_results(j, s.result.techniques[t]);
  }
  return j;
}

json scene_json(const CompareOptions& o, const SceneReport& s) {
  json j = {{"name", s.name},
            {"file", s.file},
            {"hash", s.hash},
            {"width", s.width},
            {"height", s.height},
            {"load_seconds", s.load_seconds},
            {"warnings", s.warnings},
            {"end_seconds", to_json(s.result.end)},
            {"reference", reference_json(s)},
            {"techniques", json::array()}};
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    j["techniques"].push_back(technique_json(o, s, t));
  }
  return j;
}

json techniques_json(const CompareOptions& o, const std::vector<SceneReport>& scenes) {
  json j = json::array();
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    const Technique& technique = o.techniques[t];
    json one = {{"name", technique.name}, {"settings", technique.set}};
    if (!scenes.empty()) {
      one["integrator"] = scenes.front().integrators[t];
      one["sampler"] = scenes.front().samplers[t];
    } else {
      one["integrator"] = technique.integrator.value_or("");
      one["sampler"] = technique.sampler.value_or("");
    }
    j.push_back(one);
  }
  return j;
}

}  // namespace

json parameters_json(const std::vector<Layer>& layers) {
  json j = {{"integrator", json::object()}, {"sampler", json::object()}};
  for (const Layer& layer : layers) {
    const std::string prefix = layers.size() == 1 ? "" : layer.name + ".";
    for (const auto& [name, value] : layer.integrator_values) {
      j["integrator"][prefix + name] = value;
    }
    for (const auto& [name, value] : layer.sampler_values) j["sampler"][prefix + name] = value;
  }
  return j;
}

std::string integrator_names(const std::vector<Layer>& layers) {
  return joined(layers, &Layer::integrator_name);
}
std::string sampler_names(const std::vector<Layer>& layers) {
  return joined(layers, &Layer::sampler_name);
}

Interval suite_mean(const std::vector<SceneReport>& scenes, size_t technique, size_t metric) {
  std::vector<double> ratios;
  for (const SceneReport& s : scenes) {
    if (technique >= s.result.techniques.size()) continue;
    const Number& ratio = s.result.techniques[technique].metrics[metric].speed_up.value;
    if (ratio) ratios.push_back(*ratio);
  }
  return ratios.size() < 2 ? Interval{} : geometric_mean(ratios);
}

json suite_json(const CompareOptions& o, const std::vector<SceneReport>& scenes) {
  if (scenes.size() < 2) return nullptr;
  json j = json::object();
  const auto all = metrics();
  for (size_t m = 0; m < all.size(); ++m) {
    for (size_t t = 0; t < o.techniques.size(); ++t) {
      const Interval mean = suite_mean(scenes, t, m);
      json& one = j[std::string(all[m].id)][o.techniques[t].name];
      one = interval_json(mean);
      one["geometric_mean"] = to_json(mean.value);
    }
  }
  return j;
}

json report_json(const CompareOptions& o, const std::vector<SceneReport>& scenes,
                 const std::string& why_partial) {
  json j = {{"format", format_version},
            {"program", program_json()},
            {"machine", machine_json()},
            {"command", o.command},
            {"created", time_stamp()},
            {"partial", !why_partial.empty()},
            {"why_partial", why_partial},
            {"settings",
             {{"seconds", o.seconds},
              {"runs", o.runs},
              {"snapshots", o.snapshots},
              {"threads", o.threads > 0 ? json(o.threads) : machine_json()["threads"]},
              {"seed", o.seed},
              {"slice_seconds", o.slice},
              {"reference_seconds", o.reference_seconds}}}};
  j["metrics"] = json::array();
  for (const Metric& m : metrics()) {
    j["metrics"].push_back(
        {{"id", m.id}, {"name", m.name}, {"formula", m.formula}, {"note", m.unit_note}});
  }
  j["techniques"] = techniques_json(o, scenes);
  j["scenes"] = json::array();
  for (const SceneReport& s : scenes) j["scenes"].push_back(scene_json(o, s));
  j["suite"] = suite_json(o, scenes);
  return j;
}

}  // namespace pssmlt::compare
