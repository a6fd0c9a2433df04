// Oracles pass what is right and fail what is wrong: each is shown both.
#include "app/stress/oracle.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace pssmlt::stress {
namespace {

constexpr double false_alarm = 1e-9;

// Four blocks and their mean, 32 groups each, `error` wide around `mean`.
Blocks noisy_blocks(double mean, double error, uint64_t seed) {
  Blocks blocks;
  blocks.values.assign(5, std::vector<double>(32, 0.0));
  blocks.common.assign(5, 0.0);
  RandomStream random(seed, RandomUse::test);
  for (size_t g = 0; g < 32; ++g) {
    for (size_t b = 0; b < 4; ++b) {
      const double noise = 2.0 * random.next_double() - 1.0;
      blocks.values[b][g] = mean * (1.0 + error * noise);
      blocks.values[4][g] += blocks.values[b][g] / 4.0;
    }
  }
  return blocks;
}

TEST(StressOracle, StudentsLimitIsThatOfTheTables) {
  EXPECT_NEAR(student_limit(0.05, 31.0), 2.0395, 1e-4);
  EXPECT_NEAR(student_limit(0.001, 10.0), 4.5869, 1e-4);
}

TEST(StressOracle, MeansAreTestedBlockByBlock) {
  const Blocks blocks = noisy_blocks(3.0, .05, 1);
  const double right[] = {3.0, 3.0, 3.0, 3.0}, whole[] = {3.0}, wrong[] = {3.0, 3.0, 3.0, 3.6};
  EXPECT_TRUE(compare_means(blocks, right, 0.0, false_alarm).holds);
  EXPECT_TRUE(compare_means(blocks, whole, 0.0, false_alarm).holds);
  const Comparison c = compare_means(blocks, wrong, 0.0, false_alarm);
  EXPECT_FALSE(c.holds);
  EXPECT_EQ(c.where, "block 3");
  EXPECT_NEAR(c.deviation, 1.0 / 6.0, .02);
}

TEST(StressOracle, RoundingDoesNotCount) {
  Blocks exact;
  exact.values.assign(2, std::vector<double>(32, 1.0005));
  exact.common.assign(2, 0.0);
  const double one[] = {1.0};
  EXPECT_TRUE(compare_means(exact, one, 1e-3, false_alarm).holds);
  EXPECT_FALSE(compare_means(exact, one, 1e-4, false_alarm).holds);
}

TEST(StressOracle, NotANumberNeverHolds) {
  Blocks blocks = noisy_blocks(1.0, .05, 2);
  blocks.values[1][7] = std::numeric_limits<double>::quiet_NaN();
  const double ones[] = {1.0, 1.0, 1.0, 1.0};
  EXPECT_FALSE(compare_means(blocks, ones, 0.0, false_alarm).holds);
  EXPECT_FALSE(compare_blocks(blocks, noisy_blocks(1.0, .05, 3), 1.0, 0.0, false_alarm).holds);
}

TEST(StressOracle, PicturesAreComparedUpToTheirFactor) {
  const Blocks a = noisy_blocks(8.0, .05, 4), b = noisy_blocks(2.0, .05, 5);
  EXPECT_TRUE(compare_blocks(a, b, 4.0, 0.0, false_alarm).holds);
  EXPECT_FALSE(compare_blocks(a, b, 3.5, 0.0, false_alarm).holds);
}

TEST(StressOracle, WhatIsCommonToAllGroupsWidensTheTolerance) {
  Blocks blocks = noisy_blocks(1.1, .05, 6);
  const double ones[] = {1.0, 1.0, 1.0, 1.0};
  EXPECT_FALSE(compare_means(blocks, ones, 0.0, false_alarm).holds);
  blocks.common.assign(5, .035);
  EXPECT_TRUE(compare_means(blocks, ones, 0.0, false_alarm).holds);
}

TEST(StressOracle, LimitsAreOneSided) {
  EXPECT_TRUE(compare_limit(noisy_blocks(.5, .05, 7), 1.0, false_alarm).holds);
  EXPECT_TRUE(compare_limit(noisy_blocks(1.0, .05, 8), 1.0, false_alarm).holds);
  EXPECT_FALSE(compare_limit(noisy_blocks(1.2, .05, 9), 1.0, false_alarm).holds);
  EXPECT_FALSE(compare_limit(noisy_blocks(-.5, .05, 10), 1.0, false_alarm).holds);
}

TEST(StressOracle, OneBitIsEnough) {
  Image a(2, 2, 3), b(2, 2, 3);
  for (size_t i = 0; i < a.data.size(); ++i) {
    a.data[i] = .1f * static_cast<float>(i + 1);
    b.data[i] = 4.f * a.data[i];
  }
  EXPECT_TRUE(compare_bits(b, a, 4.0).holds);
  b.data[5] = std::nextafter(b.data[5], 100.f);
  EXPECT_FALSE(compare_bits(b, a, 4.0).holds);
  EXPECT_FALSE(compare_bits(Image(2, 1, 3), a, 1.0).holds);
}

TEST(StressOracle, BlackIsSeen) {
  EXPECT_FALSE(is_black(noisy_blocks(1.0, .05, 11)));
  EXPECT_TRUE(is_black(noisy_blocks(0.0, .05, 11)));
}

}  // namespace
}  // namespace pssmlt::stress
