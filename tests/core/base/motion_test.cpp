// Transformations over time: their ends are what was given, and in between they turn and travel.
#include "core/base/motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pssmlt {
namespace {

void expect_same(const Transform& a, const Transform& b) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a.matrix()[c][r], b.matrix()[c][r], 1e-9);
  }
}

TEST(Motion, EndsAreWhatWasGiven) {
  const Transform start = Transform::translate({1, 2, 3}) * Transform::rotate(30, {1, 2, 0}) *
                          Transform::scale({1, 2, -3});
  dmat4 sheared = Transform::rotate(200, {0, 1, 1}).matrix();
  sheared[1] += 0.5 * sheared[0];
  for (const Transform& end : {Transform(), Transform(sheared), start,
                               Transform::rotate(179, {0, 0, 1}) * Transform::scale({-1, 1, 1})}) {
    const MovingTransform motion(start, end);
    expect_same(motion.at(0.f), start);
    expect_same(motion.at(1.f), end);
  }
}

TEST(Motion, TurnsAtConstantSpeedAndTravelsStraight) {
  const MovingTransform motion(Transform::translate({0, 0, 1}),
                               Transform::translate({4, 0, 1}) * Transform::rotate(90, {0, 0, 1}));
  for (const float t : {.25f, .5f, .9f}) {
    const double turn = static_cast<double>(t) * 90.0;
    expect_same(motion.at(t), Transform::translate({4.0 * static_cast<double>(t), 0, 1}) *
                                  Transform::rotate(turn, {0, 0, 1}));
  }
}

TEST(Motion, TakesTheShorterWay) {
  const MovingTransform motion(Transform::rotate(-100, {0, 1, 0}),
                               Transform::rotate(100, {0, 1, 0}));
  const dvec3 p = motion.at(.5f).vector(dvec3(1, 0, 0));
  EXPECT_NEAR(p.x, -1.0, 1e-9);  // by way of 180 degrees
}

}  // namespace
}  // namespace pssmlt
