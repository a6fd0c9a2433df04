#include "core/render/error_estimate.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/student.h"

namespace pssmlt {
namespace {

TEST(ErrorEstimate, StudentQuantiles) {
  for (const double degrees : {7.0, 12.0, 31.0, 200.0}) {
    EXPECT_NEAR(student_quantile(degrees), test::student_limit(0.05, degrees), 2e-3) << degrees;
  }
}

// 4000 means of groups of unequal weight: the 95 % interval holds the truth in 95 % of them. The
// count is binomial with deviation 0.35 %; the limits are 5.3 deviations (false alarm 1e-7).
TEST(ErrorEstimate, MeanIntervalCovers) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int covered = 0;
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    std::array<GroupMean, 32> groups;
    for (size_t g = 0; g < groups.size(); ++g) {
      groups[g].weight = 8.0 + static_cast<double>(g % 2);
      groups[g].mean = 2.0 + normal(random) / std::sqrt(groups[g].weight);
    }
    const MeanEstimate m = estimate_mean(groups);
    EXPECT_EQ(m.groups, 32);
    if (std::fabs(m.mean - 2.0) <= student_quantile(31.0) * std::sqrt(m.variance)) ++covered;
  }
  EXPECT_NEAR(covered / static_cast<double>(trials), 0.95, 5.3 * 0.0035);
}

TEST(ErrorEstimate, EmptyGroupsAreLeftOut) {
  std::array<GroupMean, 4> groups{};
  groups[1] = {3.0, 1.0};
  EXPECT_EQ(estimate_mean(groups).groups, 1);
  EXPECT_EQ(estimate_mean(groups).mean, 3.0);
  EXPECT_EQ(estimate_mean(groups).variance, 0.0);
}

// Squares of normal errors in 2000 cells: the interval for their mean covers the truth at least as
// often as it says. Deviation of the share 0.7 %, limit 5.3 deviations below (false alarm 1e-7).
TEST(ErrorEstimate, RelativeMseIntervalCovers) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  int covered = 0;
  constexpr int trials = 1000, cells = 2000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> c(cells);
    double truth = 0.0;
    for (size_t i = 0; i < c.size(); ++i) {
      const double deviation = 0.1 + 0.2 * static_cast<double>(i % 10);
      c[i] = std::pow(deviation * normal(random), 2);
      truth += deviation * deviation / cells;
    }
    ErrorEstimate e;
    estimate_relative_mse(c, cells, 0.0, e);
    if (e.low <= truth && truth <= e.high) ++covered;
  }
  EXPECT_GE(covered / static_cast<double>(trials), 0.95 - 5.3 * 0.007);
  EXPECT_LE(covered, trials);
}

TEST(ErrorEstimate, CommonVarianceIsAdded) {
  ErrorEstimate e;
  const std::vector<double> cells = {0.5, 0.5};
  estimate_relative_mse(cells, 2.0, 0.25, e);
  EXPECT_TRUE(e.known);
  EXPECT_DOUBLE_EQ(e.relative_mse, 0.75);
  EXPECT_GT(e.low, 0.25);
}

}  // namespace
}  // namespace pssmlt
