#include "core/metropolis/resampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace pssmlt {
namespace {

TEST(SystematicResampling, ChoosesFloorOrCeilOfTheExpectedNumber) {
  RandomStream random(1, RandomUse::test);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> weights(50);
    double sum = 0.0;
    for (double& w : weights) {
      w = random.next() < 0.3f ? 0.0 : random.next_double();
      sum += w;
    }
    const auto chosen = systematic_resample(weights, 33, random.next_double());
    ASSERT_EQ(chosen.size(), 33u);
    std::vector<int> counts(weights.size());
    for (const uint32_t c : chosen) ++counts[c];
    for (size_t i = 0; i < weights.size(); ++i) {
      const double expected = 33.0 * weights[i] / sum;
      EXPECT_LT(std::abs(counts[i] - expected), 1.0 + 1e-9);
      if (weights[i] == 0.0) {
        EXPECT_EQ(counts[i], 0);
      }
    }
  }
}

// Averaged over an even grid of u the counts are the weights, up to the grid's spacing.
TEST(SystematicResampling, IsProportionalOnAverage) {
  const std::vector<double> weights = {0.1, 0.0, 2.5, 0.7, 1e-3};
  std::vector<double> counts(weights.size());
  constexpr int grid = 10000;
  for (int g = 0; g < grid; ++g) {
    for (const uint32_t c : systematic_resample(weights, 7, (g + 0.5) / grid)) counts[c] += 1.0;
  }
  double sum = 0.0;
  for (const double w : weights) sum += w;
  for (size_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(counts[i] / grid, 7.0 * weights[i] / sum, 2.0 / grid);
  }
}

TEST(SystematicResampling, OfNothingIsEmpty) {
  EXPECT_TRUE(systematic_resample({0.0, 0.0}, 5, 0.5).empty());
  EXPECT_TRUE(systematic_resample({}, 5, 0.5).empty());
  const std::vector<uint32_t> last = {1, 1, 1};
  EXPECT_EQ(systematic_resample({0.0, 1e-300, 0.0}, 3, 0.999999), last);
}

}  // namespace
}  // namespace pssmlt
