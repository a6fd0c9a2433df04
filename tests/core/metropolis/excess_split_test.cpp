#include "core/metropolis/excess_split.h"

#include <gtest/gtest.h>

namespace pssmlt {
namespace {

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

}  // namespace
}  // namespace pssmlt
