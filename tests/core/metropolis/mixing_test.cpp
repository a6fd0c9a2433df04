// Chains that forget their past from round to round have a ratio of about 1, chains that stay where
// they began one of about the number of rounds.
#include "core/metropolis/mixing.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/random.h"

namespace pssmlt {
namespace {

constexpr size_t chains = 400;
constexpr int rounds = 50;

// In region 3 each chain has a level of its own that lasts, of weight `stuck`.
MixingTally walk(double stuck) {
  MixingTally tally;
  tally.start(chains);
  RandomStream random(3, RandomUse::test);
  for (size_t c = 0; c < chains; ++c) {
    const double level = random.next_double();
    for (int r = 0; r < rounds; ++r) {
      MixingTally::Round round{};
      round[3] = stuck * level + (1.0 - stuck) * random.next_double();
      tally.add(c, round);
    }
  }
  return tally;
}

// The ratio's standard error over 400 chains is sqrt(2 / 399) = 0.07: five of them, false alarm
// 10^-6.
TEST(Mixing, RatioOfIndependentRoundsIsOne) {
  const std::vector<double> ratios = walk(0.0).ratios(rounds);
  ASSERT_EQ(ratios.size(), MixingTally::regions);
  EXPECT_NEAR(ratios[3], 1.0, .35);
  EXPECT_EQ(ratios[0], 0.0);
}

TEST(Mixing, ChainsThatStayDiffer) {
  EXPECT_EQ(walk(1.0).ratios(rounds)[3], rounds);
  EXPECT_GT(walk(.5).ratios(rounds)[3], .5 * rounds);
}

TEST(Mixing, NamesTheWorstRegion) {
  nlohmann::json report;
  walk(.5).report(rounds, report);
  EXPECT_EQ(report["chains_differ"]["where"], "column 4, row 1 of 4");
  nlohmann::json nothing = nlohmann::json::object();
  walk(.5).report(1, nothing);
  EXPECT_TRUE(nothing.empty());
}

TEST(Mixing, RegionsCoverThePicture) {
  const dvec2 size(40.0, 20.0);
  EXPECT_EQ(MixingTally::region({0.0, 0.0}, size), 0u);
  EXPECT_EQ(MixingTally::region({39.9, 0.0}, size), 3u);
  EXPECT_EQ(MixingTally::region({39.9, 19.9}, size), 15u);
  EXPECT_EQ(MixingTally::region({-1.0, 25.0}, size), 12u);
}

}  // namespace
}  // namespace pssmlt
