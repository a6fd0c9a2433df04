#include "core/metropolis/local_mean.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace pssmlt {
namespace {

RasterFrame frame_of(int width, int height) {
  RasterFrame frame;
  frame.resolution = frame.crop_max = {width, height};
  return frame;
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
