// Statistics of comparisons against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "app/compare/analysis.h"
#include "app/compare/distributions.h"
#include "app/compare/snapshot_times.h"
#include "app/metrics/metrics.h"
#include "core/base/random.h"

namespace pssmlt::compare {
namespace {

TEST(Distributions, AgreeWithTables) {
  EXPECT_NEAR(student_95(1), 12.706, 5e-4);
  EXPECT_NEAR(student_95(2), 4.303, 5e-4);
  EXPECT_NEAR(student_95(3), 3.182, 5e-4);
  EXPECT_NEAR(student_95(30), 2.042, 5e-4);
  EXPECT_NEAR(student_tail(-2.228, 10), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 1e-4);
  EXPECT_NEAR(normal_deviation(0.05), 1.95996, 1e-5);
  EXPECT_NEAR(normal_deviation(1.0), 0.0, 1e-12);
  EXPECT_TRUE(std::isfinite(normal_deviation(0.0)));
}

// Logarithms of 1, 4, 16: mean log 4, standard deviation log 4, standard error log 4 / sqrt 3.
TEST(GeometricMean, ByHand) {
  const Interval i = geometric_mean(std::vector<double>{1.0, 4.0, 16.0});
  EXPECT_NEAR(*i.value, 4.0, 1e-12);
  EXPECT_NEAR(*i.high, 4.0 * std::exp(4.30265 * std::log(4.0) / std::sqrt(3.0)), 1e-2);
  EXPECT_NEAR(*i.low * *i.high, 16.0, 1e-9);
}

TEST(GeometricMean, OfOneHasNoInterval) {
  const Interval i = geometric_mean(std::vector<double>{7.0});
  EXPECT_EQ(i.value, 7.0);
  EXPECT_FALSE(i.low || i.high);
}

TEST(GeometricMean, OfNothingOrOfZeroIsUnknown) {
  EXPECT_FALSE(geometric_mean({}).value);
  for (const double bad : {0.0, -1.0, std::nan(""), double{infinity}}) {
    EXPECT_FALSE(geometric_mean(std::vector<double>{1.0, bad}).value) << bad;
  }
}

// The interval holds the truth 95 times of 100: 4000 triples of log-normal numbers; the share's
// standard error is 0.34 %, a deviation of 5.3 of them has probability 1e-7.
TEST(GeometricMean, IntervalHasItsProbability) {
  RandomStream random(1, RandomUse::test);
  int holds = 0;
  constexpr int trials = 4000;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> values;
    for (int i = 0; i < 3; ++i) {
      const double u = 1.0 - random.next_double(), v = random.next_double();
      values.push_back(
          std::exp(std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v)));
    }
    const Interval i = geometric_mean(values);
    holds += *i.low <= 1.0 && 1.0 <= *i.high ? 1 : 0;
  }
  EXPECT_NEAR(holds / double{trials}, 0.95, 5.3 * 0.0034);
}

const Series run = {{1.0, 8.0}, {4.0, 2.0}, {16.0, 1.0}};

TEST(Curve, InterpolatesInLogarithmsAndNeverBeyond) {
  EXPECT_NEAR(*error_at(run, 2.0), 4.0, 1e-12);  // halfway in log time
  EXPECT_NEAR(*error_at(run, 8.0), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(*error_at(run, 1.0), 8.0);
  EXPECT_EQ(*error_at(run, 16.0), 1.0);
  EXPECT_FALSE(error_at(run, 0.99));
  EXPECT_FALSE(error_at(run, 16.01));
  EXPECT_FALSE(error_at({}, 1.0));
}

TEST(Curve, ZeroHasNoLogarithm) {
  const Series ends = {{1.0, 1.0}, {2.0, 0.0}};
  EXPECT_FALSE(error_at(ends, 1.5));
  EXPECT_EQ(*error_at(ends, 2.0), 0.0);
}

TEST(Curve, MeanNeedsAllRunsAndMarksTheFloor) {
  const std::vector<Series> runs = {{{1.0, 4.0}, {4.0, 1.0}}, {{2.0, 4.0}, {8.0, 1.0}}};
  const std::vector<double> times = {1.0, 2.0, 4.0, 8.0};
  const Curve c = mean_curve(runs, times, 0.4);
  EXPECT_FALSE(c.errors[0].value);  // the second run begins later
  EXPECT_NEAR(*c.errors[1].value, std::sqrt(2.0 * 4.0), 1e-12);
  EXPECT_NEAR(*c.errors[2].value, std::sqrt(1.0 * 2.0), 1e-12);
  EXPECT_FALSE(c.errors[3].value);
  EXPECT_FALSE(c.near_floor[1]);
  EXPECT_TRUE(c.near_floor[2]);  // 0.4 is more than a quarter of 1.41
}

TEST(TimeTo, ByHand) {
  EXPECT_NEAR(*first_time(run, 4.0).seconds, 2.0, 1e-12);
  EXPECT_NEAR(*first_time(run, 1.0).seconds, 16.0, 1e-12);
  EXPECT_FALSE(first_time(run, 0.99).seconds);
  EXPECT_TRUE(first_time(run, 10.0).at_most);
  EXPECT_FALSE(first_time(run, 4.0).at_most);
  // A curve that rises again: the first time counts.
  const Series wavy = {{1.0, 4.0}, {2.0, 1.0}, {4.0, 3.0}, {8.0, 0.5}};
  EXPECT_NEAR(*first_time(wavy, 2.0).seconds, std::sqrt(2.0), 1e-12);

  const std::vector<Series> runs = {{{1.0, 8.0}, {16.0, 0.5}}, {{4.0, 8.0}, {64.0, 0.5}}};
  const TimeTo t = time_to(runs, 2.0);
  EXPECT_NEAR(*t.seconds.value, 8.0, 1e-9);  // 4 and 16
  EXPECT_TRUE(t.seconds.low);
  EXPECT_FALSE(time_to(runs, 0.4).seconds.value);
}

std::vector<Series> power_laws(const std::vector<double>& slopes) {
  std::vector<Series> runs;
  for (const double slope : slopes) {
    Series& series = runs.emplace_back();
    for (const double t : {1.0, 2.0, 4.0, 8.0}) series.push_back({t, 3.0 * std::pow(t, slope)});
  }
  return runs;
}

TEST(Slope, OfPowerLaws) {
  const Slope s = fit_slope(power_laws({-0.9, -1.0, -1.1}), {}, true);
  EXPECT_NEAR(*s.value, -1.0, 1e-12);
  EXPECT_NEAR(*s.error, 0.1 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(s.verdict, "as independent samples");
  EXPECT_EQ(fit_slope(power_laws({-1.4, -1.41, -1.39}), {}, true).verdict, "steeper");
  EXPECT_EQ(fit_slope(power_laws({-0.5, -0.51, -0.49}), {}, true).verdict, "has not mixed");
  EXPECT_EQ(fit_slope(power_laws({-0.2, -1.0, -1.8}), {}, true).verdict, "unknown");
  EXPECT_EQ(fit_slope(power_laws({-0.5, -0.51, -0.49}), {}, false).verdict, "unknown");
}

// Least squares by hand: log errors 0, -1, -1 over log times 0, 1, 2: slope -1/2, residuals
// 1/6, -1/3, 1/6, sum of squares 1/6, standard error sqrt(1/6 / 1 / 2).
TEST(Slope, OfOneRunHasItsResidualsError) {
  const std::vector<Series> runs = {
      {{1.0, 1.0}, {std::exp(1.0), std::exp(-1.0)}, {std::exp(2.0), std::exp(-1.0)}}};
  const Slope s = fit_slope(runs, {}, true);
  EXPECT_NEAR(*s.value, -0.5, 1e-12);
  EXPECT_NEAR(*s.error, std::sqrt(1.0 / 12.0), 1e-12);
  EXPECT_EQ(s.verdict, "unknown");
}

TEST(Slope, LeavesOutPointsNearTheFloor) {
  auto runs = power_laws({-1.0, -1.0});
  for (Series& r : runs) r.push_back({100.0, 0.3});  // the floor flattens the curve
  EXPECT_NEAR(*fit_slope(runs, 0.08, true).value, -1.0, 1e-9);
  EXPECT_GT(*fit_slope(runs, {}, true).value, -0.95);
  EXPECT_FALSE(fit_slope(runs, 10.0, true).value);
}

TEST(SnapshotTimes, AreGeometric) {
  const auto times = snapshot_times(64.0, 13, 0.0);
  ASSERT_EQ(times.size(), 13u);
  EXPECT_NEAR(times.front(), 1.0, 1e-12);
  EXPECT_EQ(times.back(), 64.0);
  for (size_t i = 1; i < times.size(); ++i)
    EXPECT_NEAR(times[i] / times[i - 1], std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(snapshot_times(64.0, 12, 8.0).front(), 10.0, 1e-9);
  EXPECT_EQ(snapshot_times(64.0, 12, 60.0), std::vector<double>{64.0});
}

TEST(SnapshotTimes, EachIsDueOnceAndRoundsMaySkipSome) {
  SnapshotClock clock({1.0, 2.0, 4.0});
  EXPECT_FALSE(clock.due(0.9));
  EXPECT_EQ(clock.due(1.0), 1.0);
  EXPECT_FALSE(clock.due(1.9));
  EXPECT_EQ(clock.due(5.0), 4.0);
  EXPECT_TRUE(clock.last_taken());
  EXPECT_FALSE(clock.due(6.0));
}

// A run of one technique whose metrics are all scale / seconds.
RunRecord record(double scale, double estimate_factor = 1.0) {
  RunRecord r;
  r.nominal = {1.0, 2.0, 4.0};
  for (const double t : {0.5, 1.0, 2.0, 4.0}) {
    RunPoint p;
    p.seconds = p.nominal = t;
    p.metrics.assign(metrics().size(), scale / t);
    p.estimate_known = true;
    p.estimate = estimate_factor * scale / t;
    r.points.push_back(p);
  }
  return r;
}

const std::vector<Number> no_floor(metrics().size());

TEST(Analysis, SpeedUpIsTheRatioOfErrorsRunByRun) {
  // Ratios 2 and 8 in the two runs.
  const SceneResult s =
      analyse({{record(1.0), record(0.5)}, {record(4.0), record(0.5)}}, no_floor, 4.0);
  const MetricResult& first = s.techniques[0].metrics[0];
  const MetricResult& second = s.techniques[1].metrics[0];
  EXPECT_EQ(s.end, 4.0);
  EXPECT_NEAR(*first.speed_up.value, 1.0, 1e-12);
  EXPECT_NEAR(*second.speed_up.value, 4.0, 1e-12);
  EXPECT_NEAR(*second.speed_up.low * *second.speed_up.high, 16.0, 1e-9);
  EXPECT_NEAR(*first.at_end.value, 0.5, 1e-12);
  EXPECT_NEAR(*first.efficiency, 1.0 / (0.5 * 4.0), 1e-12);
  EXPECT_NEAR(*second.slope.value, -1.0, 1e-12);
}

TEST(Analysis, CutRunsAreComparedWhereAllHaveBeen) {
  RunRecord early = record(1.0);
  early.points.pop_back();
  const SceneResult s = analyse({{record(1.0), early}}, no_floor, 4.0);
  EXPECT_EQ(s.end, 2.0);
  EXPECT_NEAR(*s.techniques[0].metrics[0].at_end.value, 0.5, 1e-12);
  EXPECT_FALSE(s.techniques[0].metrics[0].at_end.low);  // one run
}

TEST(Analysis, ATechniqueWithoutARoundHasNoFigures) {
  RunRecord none;
  const SceneResult s = analyse({{record(1.0), none}}, no_floor, 4.0);
  EXPECT_FALSE(s.end);
  EXPECT_FALSE(s.techniques[1].metrics[0].at_end.value);
  EXPECT_FALSE(s.techniques[1].metrics[0].speed_up.value);
  EXPECT_FALSE(s.techniques[1].calibration.value);
}

TEST(Analysis, CalibrationIsEstimateOverTruth) {
  const std::vector<RunRecord> runs = {record(1.0, 0.5), record(1.0, 2.0)};
  EXPECT_NEAR(*calibration(runs, {}, 0).value, 1.0, 1e-12);
  // Points near the floor are not used: at 4 s the error is 0.25, at 2 s 0.5.
  EXPECT_NEAR(*calibration({record(1.0, 3.0)}, 0.1, 0).value, 1.5 / 0.4, 1e-12);
  EXPECT_FALSE(calibration({record(1.0, 3.0)}, 10.0, 0).value);
}

TEST(Analysis, LevelsAreRoundAndAboveTheFloor) {
  const std::vector<Series> runs = {{{1.0, 1.0}, {10.0, 0.03}}};
  const std::vector<double> times = {1.0, 10.0};
  const Curve c = mean_curve(runs, times, {});
  const auto near = [](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
  };
  near(error_levels({&c}, {}), {1.0, 0.5, 0.2, 0.1, 0.05});
  near(error_levels({&c}, 0.04), {1.0, 0.5, 0.2});
  EXPECT_TRUE(error_levels({}, {}).empty());
}

}  // namespace
}  // namespace pssmlt::compare
