// Chi-square tests of sampling against its density, over the unit square or the sphere. Failures to
// sample count as a bin of their own, whose probability is what the density's integral leaves.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/base/random.h"
#include "tests/support/statistics.h"

namespace pssmlt::test {

struct ChiSquareResult {
  double p = 0.0;         // tail probability; a test fails below statistics.h's false_alarm
  double integral = 0.0;  // of the density over the domain: 1 - probability of failure
  double failures = 0.0;  // share of the samples
};

struct ChiSquareOptions {
  int bins_x = 24, bins_y = 24;
  int samples = 100'000;
  int fine = 24;  // the density is integrated over fine x fine points a bin
  uint64_t seed = 1;
};

// sample: a point of [0,1)^2 or a failure; pdf: its density with respect to the unit square.
inline ChiSquareResult chi_square_2d(
    const std::function<std::optional<dvec2>(RandomStream&)>& sample,
    const std::function<double(const dvec2&)>& pdf, const ChiSquareOptions& options = {}) {
  const int nx = options.bins_x, ny = options.bins_y, fine = options.fine;
  const auto bins = static_cast<size_t>(nx * ny);
  std::vector<double> expected(bins + 1), counts(bins + 1);
  ChiSquareResult result;
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x) {
      double sum = 0.0;
      for (int j = 0; j < fine; ++j)
        for (int i = 0; i < fine; ++i)
          sum += pdf({(x + (i + 0.5) / fine) / nx, (y + (j + 0.5) / fine) / ny});
      sum /= static_cast<double>(fine) * fine * nx * ny;
      expected[static_cast<size_t>(y * nx + x)] = sum * options.samples;
      result.integral += sum;
    }
  expected[bins] = std::max(0.0, 1.0 - result.integral) * options.samples;
  RandomStream random(options.seed, RandomUse::test);
  for (int i = 0; i < options.samples; ++i) {
    const auto point = sample(random);
    size_t bin = bins;
    if (point) {
      const int x = std::min(std::max(static_cast<int>(point->x * nx), 0), nx - 1);
      const int y = std::min(std::max(static_cast<int>(point->y * ny), 0), ny - 1);
      bin = static_cast<size_t>(y * nx + x);
    }
    counts[bin] += 1.0;
  }
  result.failures = counts[bins] / options.samples;
  // Bins of few expected samples are pooled: the statistic is chi-square only for large counts.
  std::vector<double> pooled_expected(1), pooled_counts(1);
  for (size_t i = 0; i <= bins; ++i) {
    const bool small = expected[i] < 10.0;
    if (!small) {
      pooled_expected.push_back(expected[i]);
      pooled_counts.push_back(counts[i]);
    } else {
      pooled_expected[0] += expected[i];
      pooled_counts[0] += counts[i];
    }
  }
  // A pool that is still small joins the largest bin, where its noise drowns.
  if (pooled_expected[0] < 10.0 && pooled_expected.size() > 1) {
    pooled_expected[1] += pooled_expected[0];
    pooled_counts[1] += pooled_counts[0];
    pooled_expected[0] = pooled_counts[0] = 0.0;
  }
  result.p = chi_square_p(pooled_counts, pooled_expected);
  return result;
}

// The sphere as a square of equal-area bins, and back.
inline dvec2 square_of(const vec3& d) {
  const double phi = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x));
  return {(phi < 0.0 ? phi + 2.0 * std::numbers::pi : phi) / (2.0 * std::numbers::pi),
          0.5 * (static_cast<double>(d.z) + 1.0)};
}
inline vec3 direction_of(const dvec2& square) {
  const double z = 2.0 * square.y - 1.0, r = std::sqrt(std::max(0.0, 1.0 - z * z));
  const double phi = 2.0 * std::numbers::pi * square.x;
  return vec3(dvec3(r * std::cos(phi), r * std::sin(phi), z));
}

// The same for directions: pdf in [1/sr].
inline ChiSquareResult chi_square_sphere(
    const std::function<std::optional<vec3>(RandomStream&)>& sample,
    const std::function<double(const vec3&)>& pdf, const ChiSquareOptions& options = {}) {
  return chi_square_2d(
      [&](RandomStream& random) -> std::optional<dvec2> {
        const auto d = sample(random);
        if (!d) return std::nullopt;
        return square_of(*d);
      },
      [&](const dvec2& square) { return 4.0 * std::numbers::pi * pdf(direction_of(square)); },
      options);
}

}  // namespace pssmlt::test
