#include "core/base/distribution.h"

#include <gtest/gtest.h>

#include <array>

#include "core/base/warp.h"
#include "tests/support/chi_square.h"

namespace pssmlt {
namespace {

TEST(Distribution1D, InvertsItsSums) {
  const std::array<float, 5> weights{0.f, 1.f, 0.f, 3.f, 0.f};
  const Distribution1D d{std::span<const float>(weights)};
  EXPECT_EQ(d.sample(0.0).index, 1u);
  EXPECT_EQ(d.sample(0.2499).index, 1u);
  EXPECT_EQ(d.sample(0.25).index, 3u);
  EXPECT_EQ(d.sample(1.0 - 0x1p-53).index, 3u);
  EXPECT_NEAR(d.sample(0.625).offset, 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(d.sample(0.3).probability, 0.75);
  EXPECT_DOUBLE_EQ(d.probability(4), 0.0);
  EXPECT_DOUBLE_EQ(d.sum(), 4.0);
  const std::array<float, 2> black{0.f, 0.f};
  EXPECT_EQ(Distribution1D{std::span<const float>(black)}.sum(), 0.0);
}

TEST(Distribution1D, LastCellIsReachedOnlyIfItHasWeight) {
  std::vector<float> weights(1000, 0.1f);
  weights.back() = 0.f;
  const Distribution1D d{std::span<const float>(weights)};
  const auto cell = d.sample(1.0 - 0x1p-53);
  EXPECT_GT(cell.probability, 0.0);
  EXPECT_LT(cell.offset, 1.0);
}

TEST(Distribution2D, SamplesFollowTheirDensity) {
  constexpr int width = 6, height = 4;
  std::vector<float> weights(width * height);
  RandomStream random(1, RandomUse::test);
  for (float& w : weights) w = random.next();
  weights[7] = 0.f;
  for (int x = 0; x < width; ++x) weights[static_cast<size_t>(2 * width + x)] = 0.f;
  const Distribution2D d(weights, width, height);
  const auto result = test::chi_square_2d(
      [&](RandomStream& r) -> std::optional<dvec2> {
        const double x = r.next_double();
        const double y = r.next_double();
        const auto point = d.sample({x, y});
        EXPECT_NEAR(point.pdf, d.pdf(point.uv), 1e-9);
        return point.uv;
      },
      [&](const dvec2& uv) { return d.pdf(uv); });
  EXPECT_GT(result.p, test::false_alarm);
  EXPECT_NEAR(result.integral, 1.0, 1e-9);
}

TEST(Warp, DirectionsFollowTheirDensity) {
  const auto draw = [](RandomStream& r) {
    const float x = r.next();
    const float y = r.next();
    return vec2(x, y);
  };
  const auto sphere = test::chi_square_sphere(
      [&](RandomStream& r) { return std::optional(uniform_sphere(draw(r))); },
      [](const vec3&) { return 0.25 * std::numbers::inv_pi; });
  EXPECT_GT(sphere.p, test::false_alarm);
  const auto hemisphere = test::chi_square_sphere(
      [&](RandomStream& r) { return std::optional(cosine_hemisphere(draw(r))); },
      [](const vec3& d) { return std::max(0.0, static_cast<double>(d.z)) * std::numbers::inv_pi; });
  EXPECT_GT(hemisphere.p, test::false_alarm);
  EXPECT_NEAR(hemisphere.integral, 1.0, 1e-3);
}

}  // namespace
}  // namespace pssmlt
