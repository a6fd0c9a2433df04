// Origins of rays: neighbouring floats, and points that lie on the right side of their surface.
#include "core/base/ray.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pssmlt {
namespace {

// All lanes do the same.
float next(float x, float toward) {
  const Four all = next_toward(four(x), four(toward));
  for (int i = 1; i < 4; ++i) EXPECT_EQ(all[i], all[0]);
  return all[0];
}

constexpr float tiny = std::numeric_limits<float>::denorm_min();

TEST(Ray, NeighboursAreThoseOfTheLibrary) {
  for (const float x : {0.f, -0.f, tiny, -tiny, 1.f, -1.f, 0x1p-126f, -0x1p-126f, 1.5f, -7e30f,
                        0.9999999f, 123456.f}) {
    EXPECT_EQ(next(x, 1e-30f), std::nextafter(x, infinity)) << x;
    EXPECT_EQ(next(x, -1e-30f), std::nextafter(x, -infinity)) << x;
    EXPECT_EQ(next(x, tiny), std::nextafter(x, infinity)) << x;
    EXPECT_EQ(next(x, -tiny), std::nextafter(x, -infinity)) << x;
    EXPECT_EQ(next(x, 0.f), x);
    EXPECT_EQ(next(x, -0.f), x);
  }
}

TEST(Ray, OriginsLieBeyondTheErrorOfTheirSurface) {
  const vec3 position(1.f, 0.f, -3.f), error(1e-6f), up(0.f, 1.f, 0.f);
  EXPECT_GT(offset_origin(position, error, up, {0.5f, 0.5f, 0.f}).y, 1e-6f);
  EXPECT_LT(offset_origin(position, error, up, {0.5f, -0.5f, 0.f}).y, -1e-6f);
  EXPECT_EQ(offset_origin(position, error, up, {0.5f, 0.5f, 0.f}).x, 1.f);
  // Points of no surface, whose normal is zero, stay where they are.
  EXPECT_EQ(offset_origin(position, error, vec3(0.f), {0.f, 0.f, 1.f}), position);
}

}  // namespace
}  // namespace pssmlt
