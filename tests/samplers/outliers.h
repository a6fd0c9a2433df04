// A target with outliers in closed form, for samplers that treat what is exceptional apart.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/metropolis/normalisation.h"
#include "tests/support/reduced.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt::test::toy_outliers {

constexpr int width = 8, height = 4, pixels = width * height;

// A quiet camera value; one sample in 50 is up to a hundred times brighter, on the left alone, in
// strips too narrow for the few points of a pixel to be even over them; a light splat that lands
// where numbers of the light stream say.
inline void outliers(PrimarySample& u, Splats& out) {
  const dvec2 raster = u.raster();
  const vec2 p = u.numbers(Stream::camera, 1).next2();
  float value = 0.5f + p.x;
  const float strip = 16.f * p.y - std::floor(16.f * p.y);
  if (raster.x < 4.0 && strip < 0.02f) value += 100.f * p.x * static_cast<float>(1.0 + raster.y);
  out.camera(Rgb(value), {});
  Numbers light = u.numbers(Stream::light, 0);
  const vec2 at = light.next2();
  if (light.next() < 0.1f) {
    out.light(dvec2(at.x * float{width}, at.y * float{height}), Rgb(10.f), {});
  }
}
// Integral over a pixel: 1 by the camera, 1 by light, left 0.02 * 50 * (1.5 + y) more.
inline double outliers_pixel(int p) { return 2.0 + (p % width < 4 ? 1.5 + p / width : 0.0); }

inline size_t region(int p) { return static_cast<size_t>((p % width) / 4 + 2 * (p / width / 2)); }

struct Regions {
  std::array<double, 4> value{}, squared_half_difference{};
};
inline Regions measure(ToyRender& render) {
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
// probability 0.99 are faults of 7.7 times the standard error that is asserted), and
// the difference of the halves, which tells the error, is not too small: the logarithm of the ratio
// of two variances from 200 values each has the variance 4 / 200 (false alarm 1e-7 each).
// bias: of the whole, relative, that is known. precision: standard error of the whole picture's
// mean over the seeds, relative, at most.
inline void expect_right(const std::string& sampler, const ParameterSet& settings, int rounds,
                         double bias, double precision) {
  if (reduced()) GTEST_SKIP() << "statistics of many renders";
  std::array<double, 4> exact{};
  for (int p = 0; p < pixels; ++p) exact[region(p)] += outliers_pixel(p);
  const RasterMap map = box_map(width, height);
  constexpr int seeds = 200;
  std::array<MeanTally, 4> means;
  std::array<double, 4> stated{};
  MeanTally whole;
  for (int seed = 0; seed < seeds; ++seed) {
    ToyRender render(sampler, settings, outliers, map, static_cast<uint64_t>(seed));
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
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_LT(std::abs(means[i].mean() - exact[i]),
              z_limit * means[i].standard_error() + bias * exact[i]);
    const double observed = seeds * sqr(means[i].standard_error());
    EXPECT_GT(std::log(stated[i] / seeds / observed), -z_limit * std::sqrt(4.0 / seeds))
        << i << ": stated " << stated[i] / seeds << ", observed " << observed;
  }
  EXPECT_LT(whole.standard_error(), precision * exact_sum);
  EXPECT_LT(std::abs(whole.mean() - exact_sum),
            z_limit * whole.standard_error() + bias * exact_sum);
}

}  // namespace pssmlt::test::toy_outliers
