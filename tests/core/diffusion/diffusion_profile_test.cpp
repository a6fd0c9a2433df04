#include "core/diffusion/diffusion_profile.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/random.h"
#include "tests/support/chi_square.h"

namespace pssmlt::test {
namespace {

DiffusionProfile example() {
  return DiffusionProfile({{{30.0, 0.5, 0.3, 1.4}, {50.0, 5.0, 0.3, 1.4}, {8.0, 40.0, 0.3, 1.4}}});
}

// The square holds the radius up to the reach, its cube root to spread what is near, and an angle.
TEST(DiffusionProfile, RadiiFollowTheirDensity) {
  const DiffusionProfile profile = example();
  for (int c = 0; c < 3; ++c) {
    const double reach = static_cast<double>(profile.reach(c));
    const auto result = chi_square_2d(
        [&](RandomStream& random) -> std::optional<dvec2> {
          const double r = static_cast<double>(profile.sample_radius(c, random.next()));
          const double phi = static_cast<double>(random.next());
          return dvec2(std::cbrt(r / reach), phi);
        },
        [&](const dvec2& p) {
          const double r = p.x * p.x * p.x * reach;
          const double area = 2.0 * std::numbers::pi * r * 3.0 * p.x * p.x * reach;
          return static_cast<double>(profile.density(c, static_cast<float>(r))) * area;
        },
        {.bins_x = 48, .bins_y = 2});
    EXPECT_GT(result.p, false_alarm) << c;
    EXPECT_NEAR(result.integral, 1.0, 2e-3) << c;
  }
}

TEST(DiffusionProfile, IntegralsAreItsAlbedo) {
  const DiffusionProfile profile = example();
  Rgb sum(0.f);
  for (double r = 1e-7; r < 3.0; r *= 1.002) {
    const double middle = 1.001 * r, ring = 2.0 * std::numbers::pi * middle * 0.002 * r;
    sum += profile.value(static_cast<float>(middle)) * static_cast<float>(ring);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / profile.albedo()[c], 1.f, 2e-3f) << c;
  EXPECT_NEAR(profile.share(0) + profile.share(1) + profile.share(2), 1.f, 1e-6f);
}

// Scaled media have scaled profiles, and more scattering gives back more.
TEST(DiffusionProfile, DependsOnFreePathsAndAlbedo) {
  const DiffusionProfile one(
      {{{0.9, 0.1, 0.0, 1.3}, {0.99, 0.01, 0.0, 1.3}, {0.5, 0.5, 0.0, 1.3}}});
  const DiffusionProfile ten({{{9.0, 1.0, 0.0, 1.3}, {9.9, 0.1, 0.0, 1.3}, {5.0, 5.0, 0.0, 1.3}}});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(one.albedo()[c], ten.albedo()[c], 1e-5f);
    for (const float r : {0.01f, 0.1f, 1.f, 5.f})
      EXPECT_NEAR(ten.value(r / 10.f)[c] / one.value(r)[c], 100.f, 0.01f) << r;
  }
  EXPECT_GT(one.albedo().y, one.albedo().x);
  EXPECT_GT(one.albedo().x, one.albedo().z);
  EXPECT_LT(one.albedo().y, 1.f);
}

TEST(DiffusionProfile, ReflectancesAreInverted) {
  for (const double g : {0.0, 0.7, -0.5}) {
    for (const double seen : {0.01, 0.3, 0.85}) {
      const double albedo = diffusing_albedo(seen, g, 1.33);
      const DiffusionProfile profile({{{albedo, 1.0 - albedo, g, 1.33}, {}, {}}});
      EXPECT_NEAR(static_cast<double>(profile.albedo().x), seen, 2e-3) << g;
    }
  }
}

TEST(DiffusionProfile, ExtremesAreFinite) {
  const DiffusionProfile black({{{0.0, 1.0, 0.0, 1.5}, {0.0, 0.0, 0.0, 1.5}, {}}});
  EXPECT_FALSE(black.shines());
  EXPECT_EQ(black.value(0.1f), Rgb(0.f));
  for (int c = 0; c < 3; ++c) EXPECT_EQ(black.sample_radius(c, 0.7f), 0.f);
  const DiffusionProfile white(
      {{{1e6, 0.0, 0.99, 1.0}, {1e-6, 0.0, -0.9, 2.5}, {1.0, 1e-9, 0.0, 1.0}}});
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(white.albedo()[c], 0.5f) << c;
    EXPECT_LE(white.albedo()[c], 1.f) << c;
    for (const float u : {0.f, 0.5f, 0.999999f}) {
      const float r = white.sample_radius(c, u);
      EXPECT_TRUE(r >= 0.f && r <= white.reach(c));
      EXPECT_TRUE(std::isfinite(white.value(std::max(r, 1e-30f))[c]));
    }
  }
}

}  // namespace
}  // namespace pssmlt::test
