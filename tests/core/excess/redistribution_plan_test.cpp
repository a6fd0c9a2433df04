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
  choose_redistribution(pilot, settings, option);
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
  EXPECT_NEAR(o.deposit, o.excess * o.length / o.mutations, 1e-9 * o.deposit);
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
