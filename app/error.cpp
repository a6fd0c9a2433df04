// pssmlt error: how far a picture is from a reference, by every metric.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/metrics/metrics.h"
#include "app/parse_arguments.h"

namespace pssmlt {
namespace {

struct ErrorOptions {
  std::string picture, reference;
  std::vector<std::string> metrics;  // empty: all
  std::string map, map_metric = "flip", json;
  int threads = 0;
};

// Leaves things as they are.
void check_json_writable(const std::string& path) {
  if (path.empty()) return;
  const bool fresh = !std::filesystem::exists(path);
  if (!std::ofstream(path, std::ios::app)) throw Error("cannot write \"" + path + "\"");
  if (fresh) std::filesystem::remove(path);
}

// False: help was printed.
bool parse(const Arguments& arguments, ErrorOptions& o) {
  CLI::App app(
      "Compares a picture with a reference of the same size. EXR, PFM and HDR hold linear values;\n"
      "PNG and JPEG are decoded from sRGB. Of layers, R, G and B count.",
      "pssmlt error");
  std::string ids;
  for (const Metric& m : metrics()) ids += (ids.empty() ? "" : ", ") + std::string(m.id);
  app.add_option("picture", o.picture, "image to judge")->required();
  app.add_option("reference", o.reference, "image that is taken for the truth")->required();
  app.add_option("--metric", o.metrics, "only this one (" + ids + "); may be repeated")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--map", o.map, "write the metric pixel by pixel (exr, pfm, hdr, png, jpg)");
  app.add_option("--map-metric", o.map_metric, "metric of the map (flip)");
  app.add_option("--json", o.json, "file for the numbers");
  app.add_option("--threads", o.threads, "threads (all processors)")->check(CLI::Range(1, 1024));
  if (!parse_arguments(app, arguments)) return false;
  for (const std::string& id : o.metrics) metric_index(id);
  metric_index(o.map_metric);
  if (!o.map.empty()) check_writable(o.map);
  check_json_writable(o.json);
  return true;
}

// Positions in metrics() of what was asked for.
std::vector<size_t> shown(const ErrorOptions& o) {
  std::vector<size_t> result;
  for (size_t m = 0; m < metrics().size(); ++m) {
    const auto asked = std::ranges::find(o.metrics, metrics()[m].id);
    if (o.metrics.empty() || asked != o.metrics.end()) result.push_back(m);
  }
  return result;
}

void print(const ErrorOptions& o, const Image& reference, const Comparison& c) {
  std::string text = fmt::format("{} against {}, {} x {} pixels\n\n", o.picture, o.reference,
                                 reference.width, reference.height);
  for (const size_t m : shown(o)) {
    const Metric& metric = metrics()[m];
    text += fmt::format("{:<16} {:<12.6g} {} ({})\n", metric.name, c.values[m], metric.formula,
                        metric.unit_note);
  }
  text += fmt::format("{:<16} ", "mean luminance");
  if (std::isnan(c.mean_bias)) {
    text += "the reference is black\n";
  } else {
    text += fmt::format(
        "{:+.4g} %, standard error {} (picture - reference, by blocks)\n", 100.0 * c.mean_bias,
        std::isnan(c.mean_bias_error) ? "unknown"
                                      : fmt::format("{:.2g} %", 100.0 * c.mean_bias_error));
  }
  if (c.non_finite > 0) {
    text += fmt::format("{:<16} {} pixels are not finite in one of the images\n", "left out",
                        c.non_finite);
  }
  std::fputs(text.c_str(), stdout);
}

// Numbers that are not finite become null.
nlohmann::json to_json(const ErrorOptions& o, const Image& reference, const Comparison& c) {
  nlohmann::json j;
  j["picture"] = o.picture;
  j["reference"] = o.reference;
  j["width"] = reference.width;
  j["height"] = reference.height;
  for (const size_t m : shown(o)) {
    const Metric& metric = metrics()[m];
    j["metrics"].push_back({{"id", metric.id},
                            {"name", metric.name},
                            {"formula", metric.formula},
                            {"note", metric.unit_note},
                            {"value", c.values[m]}});
  }
  j["mean_bias"] = {{"value", c.mean_bias}, {"standard_error", c.mean_bias_error}};
  j["non_finite"] = c.non_finite;
  return j;
}

void write_json(const std::string& path, const nlohmann::json& numbers) {
  std::ofstream file(path);
  file << numbers.dump(2) << "\n";
  file.close();
  if (!file) throw Failure("cannot write \"" + path + "\"");
}

void compare(const ErrorOptions& o) {
  const Image picture = read_image(o.picture, ""), reference = read_image(o.reference, "");
  Comparison comparison;
  try {
    comparison = compare_images(picture, reference, o.metrics, o.threads);
  } catch (const Error& error) {
    throw Error(fmt::format("{} and {}: {}", o.picture, o.reference, error.what()));
  }
  print(o, reference, comparison);
  if (!o.json.empty()) write_json(o.json, to_json(o, reference, comparison));
  if (o.map.empty()) return;
  write_image(o.map, error_map(o.map_metric, picture, reference, o.threads), {}, {});
}

}  // namespace

int run_error(const Arguments& arguments) {
  ErrorOptions options;
  if (parse(arguments, options)) compare(options);
  return 0;
}

}  // namespace pssmlt
