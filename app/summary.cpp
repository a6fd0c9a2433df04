#include "app/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/progress.h"

namespace pssmlt {
namespace {

using nlohmann::json;

std::string times(const json& s) {
  const json& t = s["seconds"];
  std::string text = fmt::format(
      "wall time: scene load {:.3g} s, acceleration structure {:.3g} s, bootstrap {:.3g} s, "
      "render {:.3g} s",
      t["load"].get<double>(), t["acceleration_structure"].get<double>(),
      t["bootstrap"].get<double>(), t["render"].get<double>());
  if (t.contains("auxiliary")) {
    text += fmt::format(", auxiliary {:.3g} s", t["auxiliary"].get<double>());
  }
  if (t.contains("write")) text += fmt::format(", write {:.3g} s", t["write"].get<double>());
  if (s["resumed"].get<bool>()) {
    text += fmt::format(" (earlier runs: {:.3g} s)", t["earlier_runs"].get<double>());
  }
  return text;
}

// What the sampler reports: numbers and texts as "name value", objects with their entries.
std::string report_text(const json& report) {
  std::string text;
  for (const auto& [name, value] : report.items()) {
    if (value.is_array()) continue;  // --json has them
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    std::string shown;
    if (value.is_object()) {
      shown = "(" + report_text(value) + ")";
    } else if (value.is_number_integer()) {
      shown = fmt::format("{}", value.get<int64_t>());
    } else if (value.is_number()) {
      shown = fmt::format("{:.5g}", value.get<double>());
    } else if (value.is_string()) {
      shown = value.get<std::string>();
    } else {
      shown = value.dump();
    }
    text += (text.empty() ? "" : ", ") + words + " " + shown;
  }
  return text;
}

std::string efficiency_text(const json& e) {
  const json& p = e["worst_pixels"];
  return fmt::format(
      "effective samples a mutation {:.2g} (median of {} regions), {:.2g} in the worst (pixels x "
      "{} "
      "to {}, y {} to {}; {:.2g} of the light); between-chain over within-chain variance {:.3g} "
      "and "
      "{:.3g}",
      e["median"].get<double>(), e["regions"].get<int>(), e["worst"].get<double>(), p[0].get<int>(),
      p[2].get<int>(), p[1].get<int>(), p[3].get<int>(), e["worst_share"].get<double>(),
      e["between_over_within"]["median"].get<double>(),
      e["between_over_within"]["worst"].get<double>());
}

std::string layer_text(const json& layer) {
  const std::string name = layer["name"].get<std::string>();
  std::string text = fmt::format(
      "{}{} under {}: {:.6g} {} a pixel in {} rounds", name.empty() ? "" : name + ": ",
      layer["integrator"].get<std::string>(), layer["sampler"].get<std::string>(),
      layer["samples_per_pixel"].get<double>(),
      layer["chain"].get<bool>() ? "mutations" : "samples", layer["rounds"].get<int64_t>());
  const std::string report = report_text(layer["report"]);
  if (!report.empty()) text += "\n  " + report;
  if (layer.contains("efficiency")) text += "\n  " + efficiency_text(layer["efficiency"]);
  return text;
}

std::string error_text(const json& e) {
  std::string text;
  if (e["known"].get<bool>()) {
    text = fmt::format("error estimate: relMSE {:.4g} (95 %: {:.4g} to {:.4g})",
                       e["relative_mse"].get<double>(), e["interval"][0].get<double>(),
                       e["interval"][1].get<double>());
  } else {
    text = "error estimate: unknown (" + e["why"].get<std::string>() + ")";
  }
  if (e.contains("mean")) {
    text += fmt::format(", mean luminance {:.6g} (95 %: {:.6g} to {:.6g})", e["mean"].get<double>(),
                        e["mean_interval"][0].get<double>(), e["mean_interval"][1].get<double>());
  }
  return text;
}

std::string rejected_text(const json& rejected) {
  const auto total = rejected["total"].get<uint64_t>();
  if (total == 0) return "rejected samples: none";
  std::string text = fmt::format("rejected samples: {}", total);
  for (const auto& [cause, count] : rejected["causes"].items()) {
    text += fmt::format(", {} {}", cause, count.get<uint64_t>());
  }
  for (const json& spoilt : rejected["plugins"]) {
    text += fmt::format("\n  {} by {}: {}", spoilt["count"].get<uint64_t>(),
                        spoilt["plugin"].get<std::string>(), spoilt["cause"].get<std::string>());
  }
  for (const json& example : rejected["examples"]) {
    text += "\n  " + example["cause"].get<std::string>() + ": --replay " +
            example["replay"].get<std::string>();
    break;  // one is enough here, --json has them all
  }
  return text;
}

}  // namespace

std::string summary_text(const json& s) {
  std::string text = times(s);
  for (const json& layer : s["layers"]) text += "\n" + layer_text(layer);
  const json& rays = s["rays"];
  text += fmt::format("\nnearest hits: {}rays, shadows: {}rays, {}rays/s on {} threads",
                      format_count(rays["nearest"].get<double>()),
                      format_count(rays["shadow"].get<double>()),
                      format_count(rays["per_second"].get<double>()), s["threads"].get<int>());
  text += "\n" + error_text(s["error"]);
  text += "\n" + rejected_text(s["rejected"]);
  text += fmt::format("\npeak memory: {}B", format_count(s["memory"]["peak_bytes"].get<double>()));
  for (const json& warning : s["warnings"]) text += "\nwarning: " + warning.get<std::string>();
  std::string left_out;
  for (const json& what : s["left_out"]) {
    left_out += (left_out.empty() ? "" : ", ") + what.get<std::string>();
  }
  text += "\nleft out: " + (left_out.empty() ? "nothing" : left_out);
  return text;
}

}  // namespace pssmlt
