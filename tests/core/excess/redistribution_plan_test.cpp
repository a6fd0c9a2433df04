#include "core/excess/redistribution_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace pssmlt {
namespace {

constexpr int width = 16, height = 8, cells = width * height;

// 64 camera samples in each pixel, one in `period` worth `bright`, the others 1.
RelativePilot outliers(double period, double bright) {
  RasterFrame frame;
  frame.resolution = frame.crop_max = {width, height};
  RandomStream random{7, RandomUse::auxiliary};
  Pilot pilot(frame, PilotLattice(frame, 1));
  for (int i = 0; i < 64 * cells; ++i) {
    const double value = random.next_double() * period < 1.0 ? bright : 1.0;
    Splats splats;
    splats.camera(Rgb(static_cast<float>(value)), {});
    pilot.add(splats, {i / 64, 1.f}, static_cast<uint32_t>(i / 64), static_cast<uint32_t>(i % 2));
  }
  return {pilot, LocalMean(Pilot())};
}

RedistributionOption chosen(const RelativePilot& pilot,
                            const RedistributionPlanSettings& settings = {}) {
  RedistributionOption option;
  option.rays = 2.0;
  choose_redistribution(pilot, pilot, settings, {SpreadRemainder({.3, .1, .05}), 2.0}, option);
  return option;
}

TEST(RedistributionPlan, LeavesEvenSamplesAlone) {
  const RedistributionOption o = chosen(outliers(1.0, 1.0));
  EXPECT_EQ(o.mutations, 0.0);
  EXPECT_FALSE(std::isfinite(o.threshold));
  EXPECT_EQ(o.variance, o.plain);
}

TEST(RedistributionPlan, SpreadsOutliers) {
  const RelativePilot pilot = outliers(500.0, 2000.0);
  const RedistributionOption o = chosen(pilot);
  EXPECT_GT(o.mutations, 0.0);
  EXPECT_LT(o.threshold, 2000.0);
  EXPECT_LT((1.0 + o.mutations) * o.variance, o.plain);
  EXPECT_EQ(o.effort(), 2.0 * (1.0 + o.mutations) * o.variance);
  EXPECT_NEAR(o.deposit, o.excess * o.length / o.mutations, 1e-9 * o.deposit);
}

// Chains that do not move are worth nothing.
TEST(RedistributionPlan, LeavesOutliersThatChainsDoNotSpread) {
  RedistributionOption option;
  option.rays = 2.0;
  const RelativePilot pilot = outliers(500.0, 2000.0);
  choose_redistribution(pilot, pilot, {}, {SpreadRemainder({1.0, 1.0, 1.0}), 2.0}, option);
  EXPECT_EQ(option.mutations, 0.0);
}

// What the deep pilot did not meet counts all the same.
TEST(RedistributionPlan, LearnsOfOutliersFromTheWidePilot) {
  RedistributionOption option;
  option.rays = 2.0;
  choose_redistribution(outliers(1.0, 1.0), outliers(500.0, 2000.0), {},
                        {SpreadRemainder({.3, .1, .05}), 2.0}, option);
  EXPECT_GT(option.mutations, 0.0);
  EXPECT_GT(option.plain, 2000.0 * 2000.0 / 500.0 * .5);
}

TEST(SpreadRemainder, FollowsWhatWasMeasured) {
  const SpreadRemainder r({.4, .2, .1});
  EXPECT_EQ(r.at(1.0), 1.0);
  EXPECT_NEAR(r.at(20.0), .4, 1e-12);
  EXPECT_NEAR(r.at(100.0), .2, 1e-12);
  EXPECT_NEAR(r.at(500.0), .1, 1e-12);
  EXPECT_NEAR(r.at(2500.0), .05, 1e-12);
  EXPECT_NEAR(r.at(1e9), .025, 1e-12);
  for (double m = 1.0; m < 1e5; m *= 1.3) EXPECT_GE(r.at(m), r.at(1.3 * m)) << m;
  // Noise that rises does not count, nor what is worse than nothing.
  const SpreadRemainder noisy({1.5, .2, .3});
  EXPECT_EQ(noisy.at(20.0), 1.0);
  EXPECT_NEAR(noisy.at(500.0), .2, 1e-12);
}

TEST(RedistributionPlan, DoesWhatItIsTold) {
  RedistributionPlanSettings settings;
  settings.threshold = 3.0;
  settings.mutations = 2.5;
  settings.length = 7;
  const RedistributionOption o = chosen(outliers(50.0, 5.0), settings);
  EXPECT_EQ(o.threshold, 3.0);
  EXPECT_EQ(o.mutations, 2.5);
  EXPECT_EQ(o.length, 7);
  settings.mutations = 0.0;
  EXPECT_EQ(chosen(outliers(50.0, 5.0), settings).mutations, 0.0);
}

RedistributionOption option(double light, double error, double rays, double variance) {
  RedistributionOption o;
  o.light = {light, error};
  o.rays = rays;
  o.variance = variance;
  return o;
}

// The least product of rays and variance wins, but not if light is missing.
TEST(RedistributionPlan, ChoosesTheLeastEffort) {
  EXPECT_EQ(best_option({option(1, .1, 10, 1), option(1, .1, 2, 4), option(1, .1, 4, 4)}), 1u);
  EXPECT_EQ(best_option({option(1, .01, 10, 1), option(.9, .01, 2, 4)}), 0u);
  EXPECT_EQ(best_option({option(1, .01, 10, 1), option(.96, .01, 2, 4)}), 1u);
}

}  // namespace
}  // namespace pssmlt
