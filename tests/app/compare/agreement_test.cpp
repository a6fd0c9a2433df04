// Agreement of two techniques, on groups of blocks made of normal numbers.
#include "app/compare/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace pssmlt::compare {
namespace {

double normal(RandomStream& random) {
  const double u = 1.0 - random.next_double(), v = random.next_double();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

// Groups of blocks with mean 1; `common`: share of the noise that all blocks of a group have in
// common.
GroupBlocks noise(RandomStream& random, size_t blocks, double common, double factor = 1.0) {
  GroupBlocks g;
  g.across = 4;
  g.common.assign(blocks, 0.0);
  for (int i = 0; i < 32; ++i) {
    auto& row = g.means.emplace_back();
    const double shared = normal(random);
    for (size_t b = 0; b < blocks; ++b) {
      row.push_back(factor +
                    0.1 * (std::sqrt(common) * shared + std::sqrt(1.0 - common) * normal(random)));
    }
  }
  return g;
}

// p-values of pictures that agree are uniform: below 1 % once in a hundred trials. 2000 trials, the
// limit is 5.3 standard errors above: false alarm 1e-7. Blocks that hang together must not change
// that, for which the effective degrees are there; their estimate and Satterthwaite's approximation
// are allowed another per cent.
TEST(Agreement, FalseAlarmsAreAsStated) {
  for (const double common : {0.0, 0.5}) {
    RandomStream random(common > 0.0 ? 2 : 1, RandomUse::test);
    int alarms = 0;
    constexpr int trials = 2000;
    for (int t = 0; t < trials; ++t) {
      const GroupBlocks a = noise(random, 40, common), b = noise(random, 40, common);
      alarms += *test_agreement(a, b, "a", "b").p_value < 0.01 ? 1 : 0;
    }
    const double allowed = common > 0.0 ? 0.02 : 0.01;
    EXPECT_LT(alarms, trials * (allowed + 5.3 * std::sqrt(allowed / trials))) << common;
  }
}

// A difference of 6 % in all blocks is 6 / (10 sqrt(2 / 32)) = 2.4 standard errors in each of 40.
TEST(Agreement, FindsASmallBiasOfAllBlocks) {
  RandomStream random(3, RandomUse::test);
  const GroupBlocks a = noise(random, 40, 0.0), b = noise(random, 40, 0.0, 0.94);
  const Agreement r = test_agreement(a, b, "one", "other");
  EXPECT_TRUE(r.biased);
  EXPECT_LT(*r.p_value, 1e-10);
  EXPECT_EQ(r.blocks, 40);
  EXPECT_NE(r.text.find("one and other do not agree"), std::string::npos) << r.text;
}

// An error of b moves all blocks together; it is no bias if it is as large as stated.
TEST(Agreement, ErrorOfBIsNoBias) {
  RandomStream random(4, RandomUse::test);
  const GroupBlocks a = noise(random, 40, 0.0);
  GroupBlocks b = noise(random, 40, 0.0, 0.94);
  b.common.assign(40, 0.06 * 0.94);
  EXPECT_GT(*test_agreement(a, b, "a", "b").p_value, 0.01);
}

TEST(Agreement, SpecialCases) {
  RandomStream random(5, RandomUse::test);
  GroupBlocks a = noise(random, 4, 0.0);
  EXPECT_EQ(test_agreement(a, a, "a", "b").p_value, 1.0) << "the same numbers";
  // Black against something.
  GroupBlocks black = a;
  for (auto& row : black.means) row.assign(row.size(), 0.0);
  EXPECT_TRUE(test_agreement(a, black, "a", "b").biased);
  EXPECT_FALSE(test_agreement(black, black, "a", "b").biased);
  // Too few groups.
  a.means.resize(5);
  const Agreement few = test_agreement(a, black, "a", "b");
  EXPECT_FALSE(few.p_value);
  EXPECT_FALSE(few.biased);
}

}  // namespace
}  // namespace pssmlt::compare
