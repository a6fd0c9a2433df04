// A picture in closed form that chains find hard enough, and what the sampler "pssmlt" has to make
// of it with any settings.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/metropolis/normalisation.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt::test::peaked {

inline constexpr int width = 8, height = 4, pixels = width * height;

// A camera value with a narrow peak in two numbers, black in a part of the picture; and a light
// splat that lands where numbers of the light stream say.
inline void peaked(PrimarySample& u, Splats& out) {
  const dvec2 raster = u.raster();
  const vec2 p = u.numbers(Stream::camera, 1).next2();
  if (p.x < 0.3f && p.y < 0.3f && raster.x < 6.0) {
    const float value = static_cast<float>(1.0 + raster.y) / 0.18f;
    out.camera(Rgb(value * (0.5f + 5.f * p.x + 5.f * p.y)), {});
  }
  Numbers light = u.numbers(Stream::light, 0);
  const vec2 at = light.next2();
  const float side = light.next();
  if (side < 0.25f) {
    const float w = u.numbers(Stream::connection, 1).next();
    out.light(dvec2(at.x * float{width}, at.y * float{height}), Rgb(8.f * w), {});
  }
}
// Integral over a pixel: camera (1.5 + y) / 0.18 * 0.09 * (0.5 + 0.75 + 0.75), light 0.25 * 4.
inline double peaked_pixel(int p) {
  const int x = p % width, y = p / width;
  return (x < 6 ? 1.5 + y : 0.0) + 1.0;
}

// With steps of every kind, unless `more` says otherwise.
inline ParameterSet settings(const ParameterSet& more = {}) {
  ParameterSet set = more;
  for (const Parameter& p :
       {test::integer("bootstrapsamples", 16000), test::integer("chains", 64),
        test::number("filmprobability", 0.1f), test::number("streamprobability", 0.2f)}) {
    const auto same = [&](const auto& parameter) { return parameter.name == p.name; };
    if (std::ranges::none_of(more, same)) set.push_back(p);
  }
  return set;
}

// The regions whose sums are tested: quarters of the picture.
inline size_t region(int p) { return static_cast<size_t>((p % width) / 4 + 2 * (p / width / 2)); }

struct Regions {
  std::array<double, 4> value{};
  std::array<double, 4> variance{};
};
// Estimates with what the groups and b say about their error.
inline Regions measure(ToyRender& render) {
  Regions r;
  const double common = render.sampler().scale_relative_variance();
  std::array<std::array<double, group_count>, 4> groups{};
  for (int plane = 0; plane < render.sampler().planes(); ++plane) {
    for (int g = 0; g < group_count; ++g) {
      const double scale = render.sampler().group_scale(plane, g, render.rounds());
      for (int p = 0; p < pixels; ++p) {
        groups[region(p)][static_cast<size_t>(g)] += scale * render.film().sum(plane, p, g);
      }
    }
  }
  for (size_t i = 0; i < 4; ++i) {
    MeanTally tally;
    for (const double g : groups[i]) tally.add(g);
    r.value[i] = tally.mean();
    r.variance[i] = sqr(tally.standard_error()) + common * sqr(r.value[i]);
  }
  return r;
}

// Over 100 seeds, few mutations each, since a chain is in equilibrium from its first step:
//  - the mean of the whole picture and of each region is right (z-score, false alarm 1e-7 each;
//  that
//    of the picture has a standard error below 0.26 %, so that a fault of 2 % is found with
//    probability 0.99);
//  - the error that each render states is true: the sum of squared z-scores against chi-square,
//  upper
//    tail, each z^2 having the mean 31/29 of a squared Student t. Stated errors may be too large.
inline void expect_right(const ParameterSet& more, int rounds = 6) {
  std::array<double, 4> exact{};
  for (int p = 0; p < pixels; ++p) exact[region(p)] += peaked_pixel(p);
  const double exact_sum = exact[0] + exact[1] + exact[2] + exact[3];
  const RasterMap map = test::box_map(width, height);
  std::array<MeanTally, 4> means;
  MeanTally whole;
  double x = 0.0;
  constexpr int seeds = 100;
  for (int seed = 0; seed < seeds; ++seed) {
    ToyRender render("pssmlt", settings(more), peaked, map, static_cast<uint64_t>(seed));
    render.rounds(rounds);
    const Regions r = measure(render);
    double sum = 0.0;
    for (size_t i = 0; i < 4; ++i) {
      means[i].add(r.value[i]);
      sum += r.value[i];
      x += sqr(r.value[i] - exact[i]) / r.variance[i] * 29.0 / 31.0;
    }
    whole.add(sum);
  }
  // Seeds and b come from the same candidates: a bias of the order of b's relative variance.
  const double bias = 3e-4;
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_LT(std::abs(means[i].mean() - exact[i]),
              test::z_limit * means[i].standard_error() + bias * exact[i]);
  }
  EXPECT_LT(whole.standard_error(), 0.0026 * exact_sum);
  EXPECT_LT(std::abs(whole.mean() - exact_sum),
            test::z_limit * whole.standard_error() + bias * exact_sum);
  // The four regions of a render share b and the chains' time; were they one and the same, x / 4
  // would be chi-square with 100 degrees of freedom.
  EXPECT_GT(test::chi_square_tail(x / 4.0, seeds), test::false_alarm);
}

}  // namespace pssmlt::test::peaked
