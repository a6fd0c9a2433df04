#include "core/metropolis/excess_split.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/metropolis/local_mean.h"

namespace pssmlt {
namespace {

RasterFrame frame_of(int width, int height) {
  RasterFrame frame;
  frame.resolution = frame.crop_max = {width, height};
  return frame;
}

// One camera splat of value 1 but for every `period`-th sample, which has `bright`.
std::vector<RelativeNorms> samples(int count, int period, double bright) {
  std::vector<RelativeNorms> result;
  for (int i = 0; i < count; ++i) {
    const double v = i % period == 0 ? bright : 1.0;
    result.push_back({v, v * v});
  }
  return result;
}

// Where nothing stands out chains would only cost.
TEST(ExcessSplit, LeavesEvenSamplesAlone) {
  const ExcessSplit split = choose_split(samples(10000, 1, 1.0), 8.0, 50);
  EXPECT_FALSE(std::isfinite(split.threshold));
  EXPECT_EQ(split.chain_share, 0.0);
}

// A hundredth of the samples makes ten elevenths of the light: V1 of all of it is 9900 for a mean
// of 11, that of the rest 0; both parts' variances are known in closed form at T = 1.
TEST(ExcessSplit, VariancesAreThoseOfTheParts) {
  const auto pilot = samples(100000, 100, 1000.0);
  const SplitVariances all = split_variances(pilot, 1e12, 1.0);
  const double mean = 0.99 + 10.0, square = 0.99 + 1e4;
  EXPECT_NEAR(all.below, square - mean * mean, 1e-6 * square);
  EXPECT_EQ(all.above, 0.0);
  EXPECT_EQ(all.contributing, 0u);
  const SplitVariances at_one = split_variances(pilot, 1.0, 5.0);
  EXPECT_NEAR(at_one.below, 1e-3, 1e-9);  // the floor: all samples are worth 1
  EXPECT_NEAR(at_one.excess, 0.01 * 999.0, 1e-9);
  EXPECT_EQ(at_one.contributing, 1000u);
  // A visit credits b / 999 times 999: b each time, with probability 1 all over the picture.
  EXPECT_NEAR(at_one.above, 5.0 * at_one.excess * 0.01 * 0.999 * 1000.0, 1e-6);
}

TEST(ExcessSplit, CutsOffWhatStandsOut) {
  const auto pilot = samples(100000, 1000, 1e5);
  const ExcessSplit split = choose_split(pilot, 8.0, 50);
  ASSERT_TRUE(std::isfinite(split.threshold));
  EXPECT_LT(split.threshold, 1e4);
  EXPECT_GT(split.chain_share, 0.0);
  EXPECT_LT(split.chain_share, 1.0);
  EXPECT_EQ(split.contributing, 100u);
  // Above no limit are there so many.
  EXPECT_FALSE(std::isfinite(choose_split(pilot, 8.0, 100001).threshold));
}

// A picture that is four times brighter on the right, with one sample a million times too bright:
// the map follows the picture and not the sample.
TEST(LocalMean, FollowsThePictureAndNotOutliers) {
  const RasterFrame frame = frame_of(64, 32);
  RandomStream random{3, RandomUse::auxiliary};
  Pilot pilot;
  for (int i = 0; i < 100000; ++i) {
    Splats splats;
    const double x = 64.0 * random.next_double();
    const double y = 32.0 * random.next_double();
    const float value = x < 32.0 ? 1.f : 4.f;
    splats.light({x, y}, Rgb(i == 5000 ? 1e6f : value), {});
    pilot.add(splats, {}, frame);
  }
  ASSERT_EQ(pilot.samples(), 100000u);
  const LocalMean mean(frame, pilot);
  const double floor2 = 0.01 * 2.5 * 2.5;
  for (const double y : {4.0, 16.0, 28.0}) {
    EXPECT_NEAR(mean.at({8.0, y}), std::sqrt(1.0 + floor2), 0.15);
    EXPECT_NEAR(mean.at({56.0, y}), std::sqrt(16.0 + floor2), 0.6);
  }
  EXPECT_GT(mean.at({-100.0, 500.0}), 0.0);  // outside: that of the nearest part
}

TEST(LocalMean, IsOneWithoutLight) {
  const RasterFrame frame = frame_of(8, 8);
  Pilot pilot;
  for (int i = 0; i < 10; ++i) pilot.add({}, {}, frame);
  EXPECT_EQ(LocalMean(frame, pilot).at({4.0, 4.0}), 1.0);
  EXPECT_EQ(LocalMean(frame, {}).at({4.0, 4.0}), 1.0);
}

// Norms of a sample with two splats, each measured where it lands.
TEST(LocalMean, NormsAreSumsOverSplats) {
  const LocalMean one(frame_of(8, 8), {});
  Splats splats;
  splats.camera(Rgb(2.f), {});
  splats.light({1.0, 1.0}, Rgb(3.f), {});
  const RelativeNorms n = one.norms(splats, {5, 1.f});
  EXPECT_NEAR(n.sum, 5.0, 1e-5);
  EXPECT_NEAR(n.sum_squares, 13.0, 1e-4);
}

}  // namespace
}  // namespace pssmlt
