#include "core/base/transform.h"

#include <gtest/gtest.h>

namespace pssmlt {
namespace {

void expect_near(const dvec3& a, const dvec3& b, double tolerance = 1e-12) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(Transform, PointsMoveVectorsDoNot) {
  const Transform t = Transform::translate({1, 2, 3});
  expect_near(t.point(dvec3(1, 1, 1)), {2, 3, 4});
  expect_near(t.vector(dvec3(1, 1, 1)), {1, 1, 1});
  expect_near(t.inverse().point(dvec3(2, 3, 4)), {1, 1, 1});
}

TEST(Transform, RotatesRightHandedInDegrees) {
  expect_near(Transform::rotate(90, {0, 0, 1}).vector(dvec3(1, 0, 0)), {0, 1, 0});
  expect_near(Transform::rotate(90, {5, 0, 0}).vector(dvec3(0, 1, 0)), {0, 0, 1});
  expect_near(Transform::rotate(120, {1, 1, 1}).vector(dvec3(1, 0, 0)), {0, 1, 0});
}

TEST(Transform, NormalsGoByTheInverseTranspose) {
  const Transform t = Transform::scale({2, 1, 1});
  expect_near(t.normal(dvec3(1, 1, 0)), {0.5, 1, 0});
  expect_near(t.vector(dvec3(1, 1, 0)), {2, 1, 0});
}

TEST(Transform, CompositionAppliesTheRightOneFirst) {
  const Transform t = Transform::translate({1, 0, 0}) * Transform::scale({2, 2, 2});
  expect_near(t.point(dvec3(1, 1, 1)), {3, 2, 2});
  expect_near(t.inverse().point(dvec3(3, 2, 2)), {1, 1, 1});
}

TEST(Transform, LookAtPutsTheEyeAtTheOriginAndTheViewAlongZ) {
  const Transform t(Transform::look_at({1, 2, 3}, {1, 2, 10}, {0, 1, 0}));
  expect_near(t.point(dvec3(1, 2, 3)), {0, 0, 0});
  expect_near(t.point(dvec3(1, 2, 10)), {0, 0, 7});
  expect_near(t.vector(dvec3(0, 1, 0)), {0, 1, 0});
  expect_near(t.vector(dvec3(1, 0, 0)), {1, 0, 0});  // left-handed: x to the right
}

TEST(Transform, LookAtFromTheSide) {
  const Transform t(Transform::look_at({5, 0, 0}, {0, 0, 0}, {0, 0, 2}));
  expect_near(t.point(dvec3(0, 0, 0)), {0, 0, 5});
  expect_near(t.vector(dvec3(0, 0, 1)), {0, 1, 0});
  expect_near(t.vector(dvec3(0, -1, 0)), {1, 0, 0});  // up x view, in a left-handed world
}

TEST(Transform, DividesByWWhereProjective) {
  dmat4 m(1.0);
  m[2][3] = 1.0;  // w = z + 1
  expect_near(Transform(m).point(dvec3(2, 4, 1)), {1, 2, 0.5});
}

TEST(Transform, Handedness) {
  EXPECT_FALSE(Transform().swaps_handedness());
  EXPECT_TRUE(Transform::scale({-1, 1, 1}).swaps_handedness());
  EXPECT_FALSE(Transform::scale({-1, -1, 1}).swaps_handedness());
  EXPECT_FALSE(Transform::rotate(30, {1, 2, 3}).swaps_handedness());
}

TEST(Transform, InvertibleHoweverUnequalTheScale) {
  EXPECT_TRUE(Transform::is_invertible(dmat4(1.0)));
  EXPECT_TRUE(Transform::is_invertible(Transform::scale({1e-10, 1e-10, 1e-10}).matrix()));
  EXPECT_TRUE(Transform::is_invertible(Transform::scale({1e-8, 1, 1e8}).matrix()));
  const dmat4 rotation = Transform::rotate(37, {1, 2, 3}).matrix();
  EXPECT_TRUE(Transform::is_invertible(Transform::scale({1e-8, 1, 1e8}).matrix() * rotation));
  EXPECT_TRUE(Transform::is_invertible(rotation * Transform::scale({1e-8, 1, 1e8}).matrix()));
  EXPECT_TRUE(Transform::is_invertible(Transform::translate({1e20, 0, 0}).matrix()));
}

TEST(Transform, SingularOrNotFinite) {
  EXPECT_FALSE(Transform::is_invertible(dmat4(0.0)));
  EXPECT_FALSE(Transform::is_invertible(Transform::scale({1, 0, 1}).matrix()));
  dmat4 m(1.0);
  m[0] = {0.1, 0.2, 0.3, 0};
  m[1] = {0.3, 0.6, 0.9, 0};  // parallel to the first but for rounding
  EXPECT_FALSE(Transform::is_invertible(m));
  m = dmat4(1.0);
  m[3][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Transform::is_invertible(m));
  EXPECT_FALSE(Transform::is_invertible(Transform::look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0})));
  EXPECT_FALSE(Transform::is_invertible(Transform::look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0})));
}

}  // namespace
}  // namespace pssmlt
