// The sampler "excess" over integrators in closed form.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/metropolis/normalisation.h"
#include "tests/support/reduced.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using test::ToyRender;

constexpr int width = 8, height = 4, pixels = width * height;

// A quiet camera value; one sample in 50 is up to a hundred times brighter, on the left alone; a
// light splat that lands where numbers of the light stream say.
void outliers(PrimarySample& u, Splats& out) {
  const dvec2 raster = u.raster();
  const vec2 p = u.numbers(Stream::camera, 1).next2();
  float value = 0.5f + p.x;
  if (raster.x < 4.0 && p.y < 0.02f) value += 100.f * p.x * static_cast<float>(1.0 + raster.y);
  out.camera(Rgb(value), {});
  Numbers light = u.numbers(Stream::light, 0);
  const vec2 at = light.next2();
  if (light.next() < 0.1f) {
    out.light(dvec2(at.x * float{width}, at.y * float{height}), Rgb(10.f), {});
  }
}
// Integral over a pixel: 1 by the camera, 1 by light, left 0.02 * 50 * (1.5 + y) more.
double outliers_pixel(int p) { return 2.0 + (p % width < 4 ? 1.5 + p / width : 0.0); }

size_t region(int p) { return static_cast<size_t>((p % width) / 4 + 2 * (p / width / 2)); }

ParameterSet settings(const ParameterSet& more) {
  ParameterSet set = {test::integer("pilotsamples", 8192),
                      test::integer("bootstrapsamples", 100000)};
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

struct Regions {
  std::array<double, 4> value{}, squared_half_difference{};
};
Regions measure(ToyRender& render) {
  Regions r;
  std::array<std::array<double, 2>, 4> halves{};
  for (int plane = 0; plane < render.sampler().planes(); ++plane) {
    const double scale = render.sampler().scale(plane, 0, render.rounds());
    for (int g = 0; g < group_count; ++g) {
      const auto half = static_cast<size_t>(g % 2);
      for (int p = 0; p < pixels; ++p) {
        halves[region(p)][half] += 2.0 * scale * render.film().sum(plane, p, g);
      }
    }
  }
  for (size_t i = 0; i < 4; ++i) {
    r.value[i] = 0.5 * (halves[i][0] + halves[i][1]);
    r.squared_half_difference[i] = 0.25 * sqr(halves[i][0] - halves[i][1]);
  }
  return r;
}

// Over 200 seeds the mean of each region is right (z-score, false alarm 1e-7 each; found with
// probability 0.99 are faults of 2 % of the picture, by the standard error that is asserted), and
// the difference of the halves, which tells the error, is not too small: the logarithm of the ratio
// of two variances from 200 values each has the variance 4 / 200 (false alarm 1e-7 each).
void expect_right(const ParameterSet& more, int rounds) {
  if (test::reduced()) GTEST_SKIP() << "statistics of many renders";
  std::array<double, 4> exact{};
  for (int p = 0; p < pixels; ++p) exact[region(p)] += outliers_pixel(p);
  const RasterMap map = test::box_map(width, height);
  constexpr int seeds = 200;
  std::array<MeanTally, 4> means;
  std::array<double, 4> stated{};
  MeanTally whole;
  for (int seed = 0; seed < seeds; ++seed) {
    ToyRender render("excess", settings(more), outliers, map, static_cast<uint64_t>(seed));
    render.rounds(rounds);
    nlohmann::json report;
    render.sampler().report(report);
    EXPECT_GT(report["chain_share"].get<double>(), 0.0);
    const Regions r = measure(render);
    double sum = 0.0;
    for (size_t i = 0; i < 4; ++i) {
      means[i].add(r.value[i]);
      stated[i] += r.squared_half_difference[i];
      sum += r.value[i];
    }
    whole.add(sum);
  }
  const double exact_sum = exact[0] + exact[1] + exact[2] + exact[3];
  const double bias = 3e-4;  // of b, as for "pssmlt"
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_LT(std::abs(means[i].mean() - exact[i]),
              test::z_limit * means[i].standard_error() + bias * exact[i]);
    const double observed = seeds * sqr(means[i].standard_error());
    EXPECT_GT(std::log(stated[i] / seeds / observed), -test::z_limit * std::sqrt(4.0 / seeds))
        << i << ": stated " << stated[i] / seeds << ", observed " << observed;
  }
  EXPECT_LT(whole.standard_error(), 0.0026 * exact_sum);
  EXPECT_LT(std::abs(whole.mean() - exact_sum),
            test::z_limit * whole.standard_error() + bias * exact_sum);
}

TEST(Excess, IsRightByDefault) { expect_right({}, 60); }
TEST(Excess, IsRightWithMostAboveTheLimit) {
  expect_right({test::number("threshold", 0.2f), test::number("chainshare", 0.8f)}, 160);
}
TEST(Excess, IsRightWithKelemenWeights) {
  expect_right({test::number("threshold", 3.f), test::number("chainshare", 0.3f),
                test::text("weights", "kelemen")},
               60);
}
// Without chains the picture is that of Sobol' points, bit by bit.
TEST(Excess, WithoutASplitItIsSobol) {
  const RasterMap map = test::box_map(width, height);
  ToyRender excess("excess", settings({test::number("threshold", 1e6f)}), outliers, map, 5);
  ToyRender sobol("sobol", {}, outliers, map, 5);
  excess.rounds(5);
  sobol.rounds(5);
  for (int p = 0; p < pixels; ++p) {
    for (int g = 0; g < group_count; ++g) {
      EXPECT_EQ(excess.film().sum(0, p, g), sobol.film().sum(0, p, g));
    }
  }
}

// A pilot that finds enough for a limit, but too few for the number of candidates that are to start
// the chains: what is cut off might be lost, so nothing is.
TEST(Excess, CutsNothingOffThatTooFewFound) {
  const auto rare = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    const float p = u.numbers(Stream::camera, 1).next();
    out.camera(Rgb(p < 1e-3f ? 500.f : .5f), {});
  };
  const RasterMap map = test::box_map(width, height);
  const auto share = [&](int candidates) {
    ToyRender render("excess",
                     {test::number("threshold", 4.f), test::integer("pilotsamples", 50000),
                      test::integer("bootstrapsamples", candidates)},
                     rare, map, 1);
    render.rounds(1);
    nlohmann::json report;
    render.sampler().report(report);
    return report["chain_share"].get<double>();
  };
  EXPECT_EQ(share(1000), 0.0);
  EXPECT_GT(share(50000), 0.0);
}

}  // namespace
}  // namespace pssmlt
