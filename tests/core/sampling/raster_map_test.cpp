#include "core/sampling/raster_map.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/random.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

// A filter with negative lobes, not separable, wider in x.
class Lobed final : public Filter {
 public:
  vec2 radius() const override { return {2.f, 1.5f}; }
  float evaluate(const vec2& o) const override {
    if (std::abs(o.x) > 2.f || std::abs(o.y) > 1.5f) return 0.f;
    const float r = std::sqrt(o.x * o.x + o.y * o.y);
    return std::cos(1.1f * r) * std::exp(-1.2f * r) + 0.02f * o.x;
  }
};

// The same as a product.
class Product final : public Filter {
 public:
  vec2 radius() const override { return {2.f, 1.5f}; }
  float evaluate(const vec2& o) const override {
    if (std::abs(o.x) > 2.f || std::abs(o.y) > 1.5f) return 0.f;
    return (std::cos(1.1f * o.x) + 0.02f * o.x) * (std::exp(-o.y * o.y) - 0.2f);
  }
};

class Constant final : public Filter {
 public:
  Constant(float value, vec2 radius) : value_(value), radius_(radius) {}
  vec2 radius() const override { return radius_; }
  float evaluate(const vec2&) const override { return value_; }

 private:
  float value_;
  vec2 radius_;
};

RasterFrame cropped() {
  RasterFrame frame;
  frame.resolution = {100, 50};
  frame.crop_min = {10, 20};
  frame.crop_max = {17, 23};
  return frame;
}

TEST(RasterMap, ABoxOfOnePixelIsTheIdentity) {
  const RasterMap map(cropped(), std::make_shared<test::BoxFilter>());
  RandomStream random(1, RandomUse::test);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.next_double(), y = random.next_double();
    const auto at = map.camera_point(x, y);
    EXPECT_NEAR(at.raster.x, 10 + 7 * x, 1e-12);
    EXPECT_NEAR(at.raster.y, 20 + 3 * y, 1e-12);
    EXPECT_EQ(at.credit.weight, 1.f);
    const int column = static_cast<int>(7 * x), row = static_cast<int>(3 * y);
    EXPECT_EQ(at.credit.pixel, row * 7 + column);
    const PixelCredit picked = map.pick(at.raster, random.next());
    EXPECT_EQ(picked.pixel, at.credit.pixel);
    EXPECT_EQ(picked.weight, 1.f);
  }
  EXPECT_EQ(map.pick({9.99, 21.0}, 0.f).pixel, -1);
  EXPECT_EQ(map.pick({17.0, 21.0}, 0.f).pixel, -1);
  EXPECT_EQ(map.pick({12.0, 23.001}, 0.f).pixel, -1);
  EXPECT_EQ(map.pick({1e300, -1e300}, 0.f).pixel, -1);
}

// The weighted samples of a pixel integrate functions of the offset as the filter does. The table's
// 64 cells change moments by less than 1e-3; the grid of offsets adds no noise.
TEST(RasterMap, CameraPointsIntegrateLikeTheFilter) {
  const Lobed filter;
  const RasterMap map(cropped(), std::make_shared<Lobed>());
  const auto function = [](const dvec2& o) { return 1.0 + 0.3 * o.x + o.x * o.y + o.y * o.y; };
  double direct = 0.0, norm = 0.0;
  constexpr int grid = 800;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const dvec2 o((2.0 * (i + 0.5) / grid - 1.0) * 2.0, (2.0 * (j + 0.5) / grid - 1.0) * 1.5);
      const double f = filter.evaluate(vec2(o));
      direct += f * function(o);
      norm += f;
    }
  }
  double sampled = 0.0, weight = 0.0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const auto at = map.camera_point_in(9, (i + 0.5) / grid, (j + 0.5) / grid);
      EXPECT_EQ(at.credit.pixel, 9);
      const dvec2 o = at.raster - dvec2(10 + 2 + 0.5, 20 + 1 + 0.5);
      sampled += at.credit.weight * function(o);
      weight += at.credit.weight;
    }
  }
  EXPECT_NEAR(weight / (grid * grid), 1.0, 2e-3);
  EXPECT_NEAR(sampled / (grid * grid), direct / norm, 5e-3);
}

// A splat's expected credit to each pixel is f / integral f, by an even grid of u. Positions up to
// the filter's radius outside the window count.
template <typename LobedFilter>
void expect_shares() {
  const LobedFilter filter;
  const RasterMap map(cropped(), std::make_shared<LobedFilter>());
  double norm = 0.0;
  constexpr int grid = 400;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      norm += filter.evaluate(
          {(2.f * (i + 0.5f) / grid - 1.f) * 2.f, (2.f * (j + 0.5f) / grid - 1.f) * 1.5f});
    }
  }
  norm *= 4.0 * 3.0 / (grid * grid);
  EXPECT_NEAR(map.filter_integral(), norm, 1e-3 * norm);
  for (const dvec2 raster : {dvec2(13.2, 21.7), dvec2(10.1, 22.9), dvec2(9.0, 19.5),
                             dvec2(18.4, 23.9), dvec2(16.0, 21.0)}) {
    std::vector<double> credits(21, 0.0);
    constexpr int trials = 20000;
    for (int t = 0; t < trials; ++t) {
      const PixelCredit c = map.pick(raster, (static_cast<float>(t) + 0.5f) / trials);
      if (c.pixel >= 0) credits[static_cast<size_t>(c.pixel)] += c.weight;
    }
    for (int p = 0; p < 21; ++p) {
      const dvec2 center(10 + p % 7 + 0.5, 20 + p / 7 + 0.5);
      const double table = map.filter_value(raster - center) / map.filter_integral();
      EXPECT_NEAR(credits[static_cast<size_t>(p)] / trials, table, 1e-3) << p;
      const double direct = filter.evaluate(vec2(raster - center)) / norm;
      EXPECT_NEAR(table, direct, 0.02) << p;
    }
  }
}

TEST(RasterMap, PickGivesEveryPixelItsShare) { expect_shares<Lobed>(); }
TEST(RasterMap, PickGivesEveryPixelItsShareOfAProduct) { expect_shares<Product>(); }

// Camera samples over the window and light splats spread over the plane with unit density give a
// constant function the same constant in every pixel, at the window's edges too.
TEST(RasterMap, CameraAndLightAgreeOnAConstant) {
  const RasterMap map(cropped(), std::make_shared<Lobed>());
  std::vector<double> light(21, 0.0);
  RandomStream random(3, RandomUse::test);
  constexpr int trials = 2000000;
  const double area = 11.0 * 6.0;  // window and a radius around it
  std::vector<double> squares(21, 0.0);
  for (int t = 0; t < trials; ++t) {
    const double x = random.next_double(), y = random.next_double();
    const PixelCredit c = map.pick({8.0 + 11.0 * x, 18.5 + 6.0 * y}, random.next());
    if (c.pixel < 0) continue;
    light[static_cast<size_t>(c.pixel)] += c.weight * area;
    squares[static_cast<size_t>(c.pixel)] += double(c.weight) * area * c.weight * area;
  }
  for (size_t p = 0; p < light.size(); ++p) {
    const double mean = light[p] / trials;
    const double error = std::sqrt((squares[p] / trials - mean * mean) / trials);
    EXPECT_LT(std::abs(mean - 1.0), test::z_limit * error);  // false alarm 1e-7 a pixel
    EXPECT_LT(error, 0.02);
  }
}

TEST(RasterMap, RefusesFiltersThatCannotBe) {
  EXPECT_THROW(RasterMap(cropped(), std::make_shared<Constant>(0.f, vec2(1.f))), Error);
  EXPECT_THROW(RasterMap(cropped(), std::make_shared<Constant>(-1.f, vec2(1.f))), Error);
  EXPECT_THROW(RasterMap(cropped(), std::make_shared<Constant>(infinity, vec2(1.f))), Error);
  EXPECT_THROW(RasterMap(cropped(), std::make_shared<Constant>(1.f, vec2(0.f))), Error);
  EXPECT_THROW(RasterMap(cropped(), std::make_shared<Constant>(1.f, vec2(1000.f))), Error);
}

}  // namespace
}  // namespace pssmlt
