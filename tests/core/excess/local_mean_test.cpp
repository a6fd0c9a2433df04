#include "core/excess/local_mean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using test::frame_of;

// A picture that is four times brighter on the right, with one sample a million times too bright:
// the map follows the picture and not the sample.
TEST(LocalMean, FollowsThePictureAndNotOutliers) {
  const RasterFrame frame = frame_of(64, 32);
  RandomStream random{3, RandomUse::auxiliary};
  Pilot pilot(frame, PilotLattice(frame, 1));
  for (int i = 0; i < 100000; ++i) {
    Splats splats;
    const double x = 64.0 * random.next_double();
    const double y = 32.0 * random.next_double();
    const float value = x < 32.0 ? 1.f : 4.f;
    splats.light({x, y}, Rgb(i == 5000 ? 1e6f : value), {});
    pilot.add(splats, {}, 0, static_cast<uint32_t>(i % 2));
  }
  ASSERT_EQ(pilot.samples(), 100000u);
  const LocalMean mean(pilot);
  const double floor2 = 0.01 * 2.5 * 2.5;
  for (const double y : {4.0, 16.0, 28.0}) {
    EXPECT_NEAR(mean.at({8.0, y}), std::sqrt(1.0 + floor2), 0.15);
    EXPECT_NEAR(mean.at({56.0, y}), std::sqrt(16.0 + floor2), 0.6);
  }
  EXPECT_GT(mean.at({-100.0, 500.0}), 0.0);  // outside: that of the nearest part
}

// A lamp of one pixel is bright in all of its samples and not an outlier there, nor where it covers
// a part of the next pixel; a pixel with one bright sample in many is.
TEST(LocalMean, FollowsLampsOfAPixel) {
  const RasterFrame frame = frame_of(32, 32);
  const uint32_t lamp = 10 * 32 + 10, edge = lamp + 1, outlier = 20 * 32 + 20;
  const auto add = [&](Pilot& pilot, uint32_t p, int count) {
    for (int n = 0; n < count; ++n) {
      const bool bright = p == lamp || (p == edge && n % 8 == 1) || (p == outlier && n == 2);
      Splats splats;
      splats.camera(Rgb(bright ? 500.f : 1.f), {});
      pilot.add(splats, {static_cast<int>(p), 1.f}, p, static_cast<uint32_t>(n % 2));
    }
  };
  Pilot wide(frame, PilotLattice(frame, 1)), deep = wide;
  for (uint32_t p = 0; p < 32 * 32; ++p) add(wide, p, 4);
  LocalMean mean(wide);
  const std::vector<uint32_t> doubtful = mean.doubtful(wide);
  EXPECT_EQ(doubtful.size(), 10u);  // the lamp and its neighbours, and the outlier
  EXPECT_EQ(std::ranges::count(doubtful, lamp), 1);
  EXPECT_EQ(std::ranges::count(doubtful, outlier), 1);
  for (const uint32_t p : doubtful) add(deep, p, 32);
  mean.settle(deep);
  EXPECT_NEAR(mean.at({10.5, 10.5}), 500.0, 5.0);
  EXPECT_NEAR(mean.at({11.5, 10.5}), 500.0 * 3.0 / 31.0, 5.0);
  EXPECT_LT(mean.at({12.5, 10.5}), 20.0);
  EXPECT_LT(mean.at({20.5, 20.5}), 20.0);
}

TEST(LocalMean, IsOneWithoutLight) {
  Pilot pilot(frame_of(8, 8), PilotLattice(frame_of(8, 8), 1));
  for (uint32_t i = 0; i < 10; ++i) pilot.add({}, {}, i, i % 2);
  EXPECT_EQ(LocalMean(pilot).at({4.0, 4.0}), 1.0);
  EXPECT_EQ(LocalMean(Pilot()).at({4.0, 4.0}), 1.0);
}

// A sample with two splats, each measured where it lands.
TEST(LocalMean, ASampleIsTheSumOfItsSplats) {
  const LocalMean one{Pilot()};
  Splats splats;
  splats.camera(Rgb(2.f), {});
  splats.light({1.0, 1.0}, Rgb(3.f), {});
  EXPECT_NEAR(one.relative(splats, {5, 1.f}), 5.0, 1e-5);
}

}  // namespace
}  // namespace pssmlt
