#include "core/base/cone.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/warp.h"

namespace pssmlt {
namespace {

vec3 random_direction(RandomStream& random) {
  const float x = random.next();
  const float y = random.next();
  return uniform_sphere({x, y});
}

// A direction inside a cone.
vec3 random_inside(RandomStream& random, const DirectionCone& cone) {
  const float z = 1.f - random.next() * (1.f - cone.cosine);
  const float phi = 2.f * pi * random.next();
  const float r = safe_sqrt(1.f - z * z);
  return Frame(cone.axis).to_world({r * std::cos(phi), r * std::sin(phi), z});
}

TEST(DirectionCone, SumsHoldTheirParts) {
  RandomStream random(3, RandomUse::test);
  int proper = 0;
  for (int i = 0; i < 2000; ++i) {
    DirectionCone a{random_direction(random), 1.f - 1.5f * random.next()};
    DirectionCone b{random_direction(random), 1.f};
    b.cosine -= 0.3f * random.next();
    DirectionCone sum = a;
    sum.add(b);
    EXPECT_NEAR(glm::length(sum.axis), 1.f, 1e-5f);
    if (!sum.is_all()) ++proper;
    for (int k = 0; k < 8; ++k) {
      for (const DirectionCone& part : {a, b}) {
        EXPECT_GE(glm::dot(random_inside(random, part), sum.axis), sum.cosine - 2e-5f);
      }
    }
  }
  EXPECT_GT(proper, 1000);
}

TEST(DirectionCone, AddsNothingAllAndOpposites) {
  DirectionCone cone = DirectionCone::none();
  EXPECT_TRUE(cone.is_empty());
  cone.add({vec3(1.f, 0.f, 0.f), .5f});
  EXPECT_EQ(cone.cosine, .5f);
  cone.add(DirectionCone::none());
  EXPECT_EQ(cone.cosine, .5f);
  DirectionCone axes{vec3(1.f, 0.f, 0.f), 1.f};
  axes.add({vec3(0.f, 1.f, 0.f), 1.f});
  EXPECT_NEAR(axes.cosine, std::sqrt(.5f), 1e-6f);
  EXPECT_NEAR(axes.axis.x, axes.axis.y, 1e-6f);
  // Opposite directions: a half sphere that holds both.
  DirectionCone both{vec3(0.f, 0.f, 1.f), 1.f};
  both.add({vec3(0.f, 0.f, -1.f), 1.f});
  EXPECT_NEAR(both.cosine, 0.f, 1e-6f);
  EXPECT_NEAR(both.axis.z, 0.f, 1e-6f);
  cone.add(DirectionCone());
  EXPECT_TRUE(cone.is_all());
}

}  // namespace
}  // namespace pssmlt
