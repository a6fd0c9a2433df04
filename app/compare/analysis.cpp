#include "app/compare/analysis.h"

#include <algorithm>
#include <cmath>

#include "app/compare/reference.h"
#include "app/metrics/metrics.h"

namespace pssmlt::compare {
namespace {

constexpr size_t most_levels = 9;

// The budget, or, where a run was cut, the last time that all techniques have reached.
Number common_end(const std::vector<std::vector<RunRecord>>& runs, double seconds) {
  double end = seconds;
  for (const auto& run : runs) {
    for (const RunRecord& r : run) {
      if (r.points.empty()) return std::nullopt;
      end = std::min(end, r.points.back().seconds);
    }
  }
  return runs.empty() ? Number() : Number(end);
}

// Errors at a time in each run; empty unless all runs have one.
std::vector<double> errors_at(const std::vector<Series>& runs, const Number& seconds) {
  std::vector<double> errors;
  for (const Series& run : runs) {
    const Number e = seconds ? error_at(run, *seconds) : Number();
    if (!e) return {};
    errors.push_back(*e);
  }
  return errors;
}

MetricResult analyse_metric(const std::vector<RunRecord>& runs, const std::vector<double>& first,
                            size_t metric, const Number& floor, const Number& end) {
  const std::vector<Series> series = series_of(runs, metric);
  MetricResult r;
  r.curve = mean_curve(series, runs.front().nominal, floor);
  r.slope = fit_slope(series, floor, is_squared(metrics()[metric].id));
  const std::vector<double> errors = errors_at(series, end);
  r.at_end = geometric_mean(errors);
  r.near_floor = r.at_end.value && near_floor(*r.at_end.value, floor);
  if (errors.size() == first.size()) {
    std::vector<double> ratios;
    for (size_t i = 0; i < errors.size(); ++i) ratios.push_back(first[i] / errors[i]);
    r.speed_up = geometric_mean(ratios);
  }
  if (r.at_end.value && end) r.efficiency = 1.0 / (*r.at_end.value * *end);
  return r;
}

void add_times(SceneResult& result, const std::vector<std::vector<RunRecord>>& runs, size_t metric,
               const Number& floor) {
  std::vector<const Curve*> curves;
  for (const TechniqueResult& t : result.techniques) curves.push_back(&t.metrics[metric].curve);
  const std::vector<double> levels = error_levels(curves, floor);
  for (size_t t = 0; t < result.techniques.size(); ++t) {
    const std::vector<Series> series = series_of(runs_of(runs, t), metric);
    for (const double level : levels) {
      result.techniques[t].metrics[metric].time_to.push_back(time_to(series, level));
    }
  }
}

}  // namespace

std::vector<RunRecord> runs_of(const std::vector<std::vector<RunRecord>>& runs, size_t technique) {
  std::vector<RunRecord> own;
  for (const auto& run : runs) own.push_back(run[technique]);
  return own;
}

std::vector<double> error_levels(const std::vector<const Curve*>& curves, const Number& floor) {
  double least = infinity, most = 0.0;
  for (const Curve* curve : curves) {
    for (const Interval& e : curve->errors) {
      if (!e.value) continue;
      least = std::min(least, *e.value);
      most = std::max(most, *e.value);
    }
  }
  if (floor) least = std::max(least, *floor / floor_share);
  std::vector<double> levels;
  if (!(most > 0.0) || !(least <= most)) return levels;
  const auto decade = [](double v) { return static_cast<int>(std::floor(std::log10(v))); };
  for (int d = decade(most); d >= decade(least); --d) {
    for (const double m : {5.0, 2.0, 1.0}) {
      const double level = m * std::pow(10.0, d);
      if (level >= least && level <= most) levels.push_back(level);
    }
  }
  // Over many decades powers of ten are enough, and the smallest are what matters.
  if (levels.size() > most_levels) {
    std::erase_if(levels, [](double v) {
      const double p = std::log10(v);
      return std::fabs(p - std::round(p)) > 1e-9;
    });
  }
  return levels;
}

Interval calibration(const std::vector<RunRecord>& runs, const Number& floor, size_t relmse) {
  std::vector<double> ratios;
  for (const RunRecord& run : runs) {
    const auto usable = [&](const RunPoint& p) {
      return p.estimate_known && p.metrics[relmse] > 0.0 && !near_floor(p.metrics[relmse], floor);
    };
    const auto last = std::find_if(run.points.rbegin(), run.points.rend(), usable);
    if (last == run.points.rend()) return {};
    // The errors of the picture and of the reference are independent: their squares add up.
    ratios.push_back(last->estimate / (last->metrics[relmse] - floor.value_or(0.0)));
  }
  return geometric_mean(ratios);
}

SceneResult analyse(const std::vector<std::vector<RunRecord>>& runs,
                    const std::vector<Number>& floor, double seconds) {
  SceneResult result;
  result.end = common_end(runs, seconds);
  if (runs.empty()) return result;
  const size_t relmse = metric_index("relmse");
  for (size_t t = 0; t < runs.front().size(); ++t) {
    const std::vector<RunRecord> own = runs_of(runs, t);
    TechniqueResult& technique = result.techniques.emplace_back();
    for (size_t m = 0; m < metrics().size(); ++m) {
      const auto first = errors_at(series_of(runs_of(runs, 0), m), result.end);
      technique.metrics.push_back(analyse_metric(own, first, m, floor[m], result.end));
    }
    technique.calibration = calibration(own, floor[relmse], relmse);
  }
  for (size_t m = 0; m < metrics().size(); ++m) add_times(result, runs, m, floor[m]);
  return result;
}

}  // namespace pssmlt::compare
