// curves.csv: every point of every run, a line each.
#include <fmt/format.h>

#include <cmath>

#include "app/compare/report_data.h"
#include "app/metrics/metrics.h"

namespace pssmlt::compare {
namespace {

// A field as RFC 4180 wants it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string field(const Number& n) {
  return n && std::isfinite(*n) ? fmt::format("{}", *n) : std::string();
}

std::string header() {
  std::string text = "scene,technique,run,seed,nominal_seconds,seconds,samples,rays";
  for (const Metric& m : metrics()) text += fmt::format(",{}", m.id);
  text += ",mean_bias,mean_bias_error,estimate_relmse,estimate_low,estimate_high";
  for (const Metric& m : metrics()) text += fmt::format(",floor_{}", m.id);
  return text + "\n";
}

std::string line(const RunPoint& p, const Reference& reference) {
  std::string text = fmt::format("{},{},{},{}", p.nominal, p.seconds, p.samples, p.rays);
  for (const double v : p.metrics) text += "," + field(Number(v));
  text += "," + field(Number(p.mean_bias)) + "," + field(p.mean_bias_error);
  for (const double v : {p.estimate, p.estimate_low, p.estimate_high}) {
    text += "," + (p.estimate_known ? field(Number(v)) : "");
  }
  for (const Number& f : reference.floor) text += "," + field(f);
  return text + "\n";
}

}  // namespace

std::string curves_csv(const CompareOptions& o, const std::vector<SceneReport>& scenes) {
  std::string text = header();
  for (const SceneReport& s : scenes) {
    for (size_t t = 0; t < o.techniques.size(); ++t) {
      for (size_t r = 0; r < s.runs.size(); ++r) {
        const RunRecord& run = s.runs[r][t];
        for (const RunPoint& p : run.points) {
          text +=
              fmt::format("{},{},{},{},", field(s.name), field(o.techniques[t].name), r, run.seed) +
              line(p, s.reference);
        }
      }
    }
  }
  return text;
}

}  // namespace pssmlt::compare
