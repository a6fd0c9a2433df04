// The tables at the end of `pssmlt compare`.
#include <fmt/format.h>

#include <algorithm>

#include "app/compare/terminal.h"
#include "app/metrics/metrics.h"
#include "app/progress.h"

namespace pssmlt::compare {
namespace {

using Row = std::vector<std::string>;

// Displayed columns of UTF-8 text.
size_t width_of(const std::string& text) {
  return static_cast<size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

// Columns as wide as they must be, the first to the left, the others to the right.
std::string layout(const std::vector<Row>& rows) {
  std::vector<size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  }
  std::string text;
  for (const Row& row : rows) {
    for (size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - width_of(row[c]), ' ');
      text += c == 0 ? "  " + row[c] + blanks : "  " + blanks + row[c];
    }
    text += "\n";
  }
  return text;
}

std::string number(const Number& n) { return n ? fmt::format("{:.3g}", *n) : "-"; }

std::string with_interval(const Interval& i) {
  if (!i.value) return "-";
  if (!i.low || !i.high) return number(i.value);
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", *i.value, *i.low, *i.high);
}

std::string error_rows(const CompareOptions& o, const SceneReport& s, bool& marked) {
  std::vector<Row> rows = {{"technique"}};
  for (const Metric& m : metrics()) rows[0].emplace_back(m.name);
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    Row& row = rows.emplace_back(Row{o.techniques[t].name});
    for (const MetricResult& r : s.result.techniques[t].metrics) {
      marked = marked || r.near_floor;
      row.push_back(with_interval(r.at_end) + (r.near_floor ? " *" : ""));
    }
  }
  Row& floor = rows.emplace_back(Row{"(reference)"});
  for (const Number& f : s.reference.floor) floor.push_back(number(f));
  return layout(rows);
}

std::string summary_rows(const CompareOptions& o, const SceneReport& s) {
  const size_t relmse = metric_index("relmse");
  std::vector<Row> rows = {{"technique", "speed-up", "slope", "", "samples/s", "rays/s",
                            "estimated/true", "mean off by"}};
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    const TechniqueResult& result = s.result.techniques[t];
    const MetricResult& r = result.metrics[relmse];
    double samples = 0.0, rays = 0.0, seconds = 0.0, bias = 0.0;
    for (const auto& run : s.runs) {
      if (run[t].points.empty()) continue;
      const RunPoint& p = run[t].points.back();
      samples += p.samples;
      rays += p.rays;
      seconds += p.seconds;
      bias += p.mean_bias / static_cast<double>(s.runs.size());
    }
    const bool any = seconds > 0.0;
    rows.push_back(
        {o.techniques[t].name, with_interval(r.speed_up),
         r.slope.value ? fmt::format("{:.2f} ± {:.2f}", *r.slope.value, r.slope.error.value_or(0.0))
                       : "-",
         std::string(r.slope.verdict), any ? format_count(samples / seconds) : "-",
         any ? format_count(rays / seconds) : "-", with_interval(result.calibration),
         any ? fmt::format("{:+.2f} %", 100.0 * bias) : "-"});
  }
  return layout(rows);
}

std::string time_rows(const CompareOptions& o, const SceneReport& s) {
  const size_t relmse = metric_index("relmse");
  std::vector<Row> rows = {{"seconds to reach relMSE"}};
  for (const TimeTo& t : s.result.techniques[0].metrics[relmse].time_to) {
    rows[0].push_back(fmt::format("{:.1g}", t.error));
  }
  if (rows[0].size() == 1) return "";
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    Row& row = rows.emplace_back(Row{o.techniques[t].name});
    for (const TimeTo& time : s.result.techniques[t].metrics[relmse].time_to) {
      row.push_back((time.at_most && time.seconds.value ? "<= " : "") + number(time.seconds.value));
    }
  }
  return layout(rows);
}

}  // namespace

std::string scene_table(const CompareOptions& o, const SceneReport& s) {
  if (s.runs.empty()) return "";
  const size_t runs = s.runs.size();
  std::string text = fmt::format("\n{}, {} x {}, {} run{}, errors after {}{}\n", s.name, s.width,
                                 s.height, runs, runs == 1 ? "" : "s",
                                 s.result.end ? format_duration(*s.result.end) : "no common time",
                                 runs == 1 ? " (one run: no intervals)" : " [95 % intervals]");
  bool marked = false;
  text += error_rows(o, s, marked) + "\n" + summary_rows(o, s);
  const std::string times = time_rows(o, s);
  if (!times.empty()) text += "\n" + times;
  if (marked) text += "  * the reference's own error is more than a quarter of it\n";
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    const auto& points = s.runs[0][t].points;
    if (points.size() == 1 && points[0].seconds > o.seconds) {
      text += fmt::format("  {}: its first round took {}, longer than --time\n",
                          o.techniques[t].name, format_duration(points[0].seconds));
    }
  }
  if (s.reference.agreement && s.reference.agreement->biased) {
    text += "  BIAS: " + s.reference.agreement->text + "\n";
  }
  return text;
}

std::string suite_table(const CompareOptions& o, const std::vector<SceneReport>& scenes) {
  if (scenes.size() < 2) return "";
  const size_t relmse = metric_index("relmse");
  std::vector<Row> rows = {{"speed-up over " + o.techniques[0].name + " (relative MSE)"}};
  for (const Technique& t : o.techniques) rows[0].push_back(t.name);
  for (const SceneReport& s : scenes) {
    if (s.result.techniques.empty()) continue;
    Row& row = rows.emplace_back(Row{s.name});
    for (const TechniqueResult& t : s.result.techniques) {
      row.push_back(with_interval(t.metrics[relmse].speed_up));
    }
  }
  Row& mean = rows.emplace_back(Row{"geometric mean"});
  for (size_t t = 0; t < o.techniques.size(); ++t) {
    mean.push_back(with_interval(suite_mean(scenes, t, relmse)));
  }
  return "\n" + layout(rows);
}

}  // namespace pssmlt::compare
