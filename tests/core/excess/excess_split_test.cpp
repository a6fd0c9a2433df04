#include "core/excess/excess_split.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace pssmlt {
namespace {

constexpr int width = 16, height = 8, cells = width * height;

RasterFrame frame() {
  RasterFrame frame;
  frame.resolution = frame.crop_max = {width, height};
  return frame;
}

// Camera splats of the same number of samples of both halves in each pixel; value(cell, half, n).
template <typename Value>
RelativePilot pilot(int samples_a_half, const Value& value) {
  Pilot pilot(frame(), PilotLattice(frame(), 1));
  for (int c = 0; c < cells; ++c) {
    for (int n = 0; n < 2 * samples_a_half; ++n) {
      Splats splats;
      splats.camera(Rgb(static_cast<float>(value(c, n % 2, n / 2))), {});
      pilot.add(splats, {c, 1.f}, static_cast<uint32_t>(c), static_cast<uint32_t>(n % 2));
    }
  }
  return {pilot, LocalMean(Pilot())};  // all means 1
}

// One sample in `period` is worth `bright`, the others 1.
RelativePilot outliers(int samples_a_half, double period, double bright) {
  RandomStream random{7, RandomUse::auxiliary};
  return pilot(samples_a_half,
               [&](int, int, int) { return random.next_double() * period < 1.0 ? bright : 1.0; });
}

// Where nothing stands out chains would only cost: neither where all pixels are the same nor where
// they differ, since what a pixel's samples have in common is not noise.
TEST(ExcessSplit, LeavesEvenSamplesAlone) {
  const auto alike = pilot(50, [](int, int, int) { return 1.0; });
  EXPECT_FALSE(std::isfinite(choose_split(alike, 8.0, 50).threshold));
  const auto by_pixel = pilot(50, [](int c, int, int) { return c % 10 == 0 ? 1000.0 : 1.0; });
  const ExcessSplit split = choose_split(by_pixel, 8.0, 50);
  EXPECT_FALSE(std::isfinite(split.threshold));
  EXPECT_EQ(split.chain_share, 0.0);
}

// A hundredth of the samples makes ten elevenths of the light: V1 of all of it is 9900 for a mean
// of 11, that of the rest 0. Measured by 128 differences of halves: within z_limit * sqrt(2 / 128),
// and the spread of the number of bright samples (1 / 160 of 25600), of the truth.
TEST(ExcessSplit, VariancesAreThoseOfTheParts) {
  const RelativePilot some = outliers(100, 100.0, 1000.0);
  const auto all = some.variances(1e12, 1.0);
  EXPECT_NEAR(all.below, 0.01 * 0.99 * sqr(999.0), 0.66 * 9900.0);
  EXPECT_EQ(all.above, 0.0);
  EXPECT_EQ(all.contributing, 0u);
  const auto at_one = some.variances(1.0, 5.0);
  EXPECT_NEAR(at_one.below, 1e-3, 1e-9);  // the floor: all samples are worth 1
  const double found = static_cast<double>(at_one.contributing) / (200.0 * cells);
  EXPECT_NEAR(found, 0.01, 5.0 * std::sqrt(0.01 / (200.0 * cells)));
  EXPECT_NEAR(at_one.excess, found * 999.0, 1e-6 * found * 999.0);
  // A visit credits b / 999 times 999: b each time, with probability 1 all over the picture.
  const double above = 5.0 * at_one.excess * found * 0.999 * 1000.0;
  EXPECT_NEAR(at_one.above, above, 1e-6 * above);
}

// Halves that agree more closely than independent samples would (points that are spread evenly)
// have the smaller variance that they deserve.
TEST(ExcessSplit, VarianceIsThatOfTheHalves) {
  RandomStream random{11, RandomUse::auxiliary};
  const auto even = pilot(2, [&](int, int, int n) { return 1.0 + (n == 0 ? 0.5 : -0.5); });
  EXPECT_NEAR(even.variances(1e12, 1.0).below, 1.25e-3, 1e-9);  // the floor
  const auto uneven =
      pilot(2, [&](int, int, int) { return random.next_double() < 0.5 ? 1.5 : 0.5; });
  EXPECT_NEAR(uneven.variances(1e12, 1.0).below, 0.25, 0.25 * 5.3 * std::sqrt(2.0 / cells));
}

TEST(ExcessSplit, CutsOffWhatStandsOut) {
  const RelativePilot some = outliers(400, 1000.0, 1e5);
  const ExcessSplit split = choose_split(some, 8.0, 50);
  ASSERT_TRUE(std::isfinite(split.threshold));
  EXPECT_LT(split.threshold, 1e4);
  EXPECT_GT(split.chain_share, 0.0);
  EXPECT_LT(split.chain_share, 1.0);
  EXPECT_LT(split.variances.total(), 0.1 * some.variances(1e12, 8.0).total());
  // Above no limit are there so many.
  EXPECT_FALSE(std::isfinite(choose_split(some, 8.0, 200001).threshold));
}

}  // namespace
}  // namespace pssmlt
