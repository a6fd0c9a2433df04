// Noise: values computed apart from the definition, its zeros, its period, and what a pixel's width
// leaves of sums of octaves.
#include "core/noise.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace pssmlt {
namespace {

constexpr float close = 2e-5f;

vec3 draw_point(RandomStream& random, float width) {
  vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = width * (2.f * random.next() - 1.f);
  return p;
}

TEST(Noise, KnownValues) {
  // The first is widely quoted for Perlin's own program; the others are in cells whose corners have
  // one of the last four gradients.
  EXPECT_NEAR(noise({3.14f, 42.f, 7.f}), 0.13691996f, close);
  EXPECT_NEAR(noise({0.5f, 0.5f, 0.5f}), -0.125f, close);
  EXPECT_NEAR(noise({-0.3f, 100.6f, 7.1f}), -0.6697950f, close);
  EXPECT_NEAR(noise({300.7f, -700.2f, 0.4f}), 0.1726977f, 1e-4f);
}

TEST(Noise, ZerosPeriodAndRange) {
  RandomStream random(1, RandomUse::test);
  float least = 0.f, most = 0.f;
  for (int i = 0; i < 20'000; ++i) {
    const vec3 p = draw_point(random, 100.f);
    EXPECT_EQ(noise(glm::floor(p)), 0.f);
    const float value = noise(p);
    EXPECT_NEAR(noise(p + vec3(256.f, -512.f, 256.f)), value, 2e-3f);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  EXPECT_GE(least, -1.f);
  EXPECT_LE(most, 1.f);
  EXPECT_LT(least, -0.7f);
  EXPECT_GT(most, 0.7f);
  EXPECT_TRUE(std::isnan(noise({NAN, 0.f, 0.f})));
  EXPECT_TRUE(std::isnan(noise({0.f, infinity, 0.f})));
  EXPECT_EQ(noise({1e30f, -1e30f, 1e20f}), 0.f);
}

// Across the border of a cell, value and slope are continuous.
TEST(Noise, IsSmooth) {
  RandomStream random(2, RandomUse::test);
  for (int i = 0; i < 1000; ++i) {
    vec3 p = draw_point(random, 10.f);
    p.x = std::floor(p.x);
    constexpr float h = 1e-2f;
    const float low = noise(p - vec3(h, 0.f, 0.f)), high = noise(p + vec3(h, 0.f, 0.f));
    EXPECT_NEAR(low + high, 2.f * noise(p), 4.f * h * h);
  }
}

TEST(Octaves, KnownSums) {
  const vec3 p(1.25f, -2.5f, 3.75f);
  EXPECT_NEAR(fbm(p, {}), 0.15548211f, close);
  EXPECT_NEAR(turbulence(p, {}), 0.16215201f, close);
  // A footprint of 0.1: 2.3 octaves, the third of which just begins.
  const Octaves seen = Octaves{}.seen(0.1f);
  EXPECT_NEAR(fbm(p, seen), 0.12872520f, close);
  EXPECT_NEAR(turbulence(p, seen), 0.22672839f, close);
}

TEST(Octaves, WideFootprintsSeeTheMean) {
  const vec3 p(1.25f, -2.5f, 3.75f);
  for (const float width : {0.5f, 2.f, 1e30f, infinity}) {
    EXPECT_EQ(fbm(p, Octaves{}.seen(width)), 0.f) << width;
    EXPECT_NEAR(turbulence(p, Octaves{}.seen(width)), 0.2f * (2.f - 0x1p-7f), close) << width;
  }
  EXPECT_EQ(fbm(p, {.count = 0}), 0.f);
  EXPECT_EQ(fbm(p, Octaves{}.seen(1e-30f)), fbm(p, {}));
}

// Sums change continuously with the footprint, also where an octave begins.
TEST(Octaves, FadeIn) {
  const vec3 p(0.3f, 0.7f, 0.2f);
  float last_fbm = fbm(p, Octaves{}.seen(1.f)), last = turbulence(p, Octaves{}.seen(1.f));
  for (int i = 1; i <= 8000; ++i) {
    const Octaves seen = Octaves{}.seen(std::exp2(-static_cast<float>(i) / 1000.f));
    EXPECT_NEAR(fbm(p, seen), last_fbm, 5e-3f);
    EXPECT_NEAR(turbulence(p, seen), last, 5e-3f);
    last_fbm = fbm(p, seen);
    last = turbulence(p, seen);
  }
}

}  // namespace
}  // namespace pssmlt
