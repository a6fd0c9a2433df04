// FLIP against values that follow from its formulas, and its filters against plain sums.
#include "app/metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "app/metrics/flip_color.h"
#include "core/base/error.h"

namespace pssmlt::flip {
namespace {

using Colours = std::vector<Rgb>;

Colours uniform(int count, const Rgb& colour) {
  return Colours(static_cast<size_t>(count), colour);
}

Colours random_colours(int count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> u(0.f, 1.f);
  Colours colours;
  for (int i = 0; i < count; ++i) {
    const float r = u(random), g = u(random), b = u(random);
    colours.push_back({r, g, b});
  }
  return colours;
}

double mean(const Plane& plane) {
  double sum = 0.0;
  for (const float v : plane.values) sum += double(v);
  return sum / double(plane.values.size());
}

class Flip : public testing::Test {
 protected:
  Plane displayed(int w, int h, const Colours& a, const Colours& b,
                  double ppd = default_pixels_per_degree) {
    return displayed_error({w, h, a}, {w, h, b}, pool_, ppd);
  }
  Plane radiance(int w, int h, const Colours& a, const Colours& b) {
    return radiance_error({w, h, a}, {w, h, b}, pool_);
  }
  WorkerPool pool_{2};
};

TEST_F(Flip, PixelsPerDegreeOfTheStandardScreen) {
  EXPECT_NEAR(default_pixels_per_degree, 0.7 * 3840 / 0.7 * std::numbers::pi / 180.0, 1e-9);
}

// Uniform images have no features, and filters leave them alone, so that only the colour term is
// left. Black against white: lightness 0 against 100, no colour, hence HyAB 100. Green and blue are
// the colours furthest apart; their distance d makes the scale. 100^0.7 lies above the knee 0.4
// d^0.7.
TEST_F(Flip, BlackAgainstWhiteByHand) {
  // CIELAB of green (0, 1, 0): f of X/Xn = 0.35758/0.95046, Y/Yn = 0.71517, Z/Zn = 0.11919/1.08906,
  // of blue: 0.18048/0.95046, 0.07219, 0.95053/1.08906; all above (6/29)^3.
  const auto hunt = [](double x, double y, double z) {
    const double fx = std::cbrt(x), fy = std::cbrt(y), fz = std::cbrt(z), l = 116.0 * fy - 16.0;
    return std::array{l, 0.01 * l * 500.0 * (fx - fy), 0.01 * l * 200.0 * (fy - fz)};
  };
  const auto green = hunt(0.35758 / 0.95046, 0.71517, 0.11919 / 1.08906);
  const auto blue = hunt(0.18048 / 0.95046, 0.07219, 0.95053 / 1.08906);
  const double distance = green[0] - blue[0] + std::hypot(green[1] - blue[1], green[2] - blue[2]);
  EXPECT_NEAR(distance, 203.2, 0.5);
  const double largest = std::pow(distance, 0.7), knee = 0.4 * largest;
  const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - knee) / (largest - knee);
  const Plane error = displayed(12, 9, uniform(108, Rgb(0.f)), uniform(108, Rgb(1.f)));
  for (const float v : error.values) EXPECT_NEAR(double(v), expected, 1e-4);
}

TEST_F(Flip, GreenAgainstBlueIsOne) {
  const Plane error = displayed(5, 5, uniform(25, {0.f, 1.f, 0.f}), uniform(25, {0.f, 0.f, 1.f}));
  for (const float v : error.values) EXPECT_NEAR(v, 1.f, 1e-4f);
}

// Greys of lightness 50 and 60: HyAB 10, 10^0.7 below the knee.
TEST_F(Flip, GreysByHand) {
  const auto grey = [](double l) { return Rgb(float(std::pow((l + 16.0) / 116.0, 3.0))); };
  const double largest =
      std::pow(double(hyab(to_hunt_lab({0.f, 1.f, 0.f}), to_hunt_lab({0.f, 0.f, 1.f}))), 0.7);
  const double expected = 0.95 / (0.4 * largest) * std::pow(10.0, 0.7);
  const Plane error = displayed(4, 4, uniform(16, grey(50.0)), uniform(16, grey(60.0)));
  for (const float v : error.values) EXPECT_NEAR(double(v), expected, 2e-4);
}

TEST_F(Flip, EqualImagesAreZero) {
  const Colours a = random_colours(40 * 31, 1);
  for (const float v : displayed(40, 31, a, a).values) EXPECT_EQ(v, 0.f);
  for (const float v : radiance(40, 31, a, a).values) EXPECT_EQ(v, 0.f);
}

TEST_F(Flip, SymmetricAndInRange) {
  const Colours a = random_colours(50 * 33, 2), b = random_colours(50 * 33, 3);
  const Plane ab = displayed(50, 33, a, b), ba = displayed(50, 33, b, a);
  for (size_t i = 0; i < ab.values.size(); ++i) {
    EXPECT_NEAR(ab.values[i], ba.values[i], 1e-5f);
    EXPECT_GE(ab.values[i], 0.f);
    EXPECT_LE(ab.values[i], 1.f);
  }
}

TEST_F(Flip, GrowsWithNoise) {
  const Colours r = random_colours(64 * 64, 4), noise = random_colours(64 * 64, 5);
  double last = 0.0;
  for (const float amount : {0.02f, 0.1f, 0.3f, 1.f}) {
    Colours x = r;
    for (size_t i = 0; i < x.size(); ++i) x[i] = r[i] * (1.f + amount * (noise[i] - 0.5f));
    const double error = mean(displayed(64, 64, x, r));
    EXPECT_GT(error, last);
    last = error;
    EXPECT_GE(mean(radiance(64, 64, x, r)), 0.0);
  }
}

// A line is a feature: against plain grey it stands out more than its colour alone would.
TEST_F(Flip, FeaturesRaiseTheError) {
  constexpr int n = 64;
  const Colours plain = uniform(n * n, Rgb(0.3f));
  Colours line = plain;
  for (int y = 0; y < n; ++y) line[size_t(y * n + n / 2)] = Rgb(0.6f);
  const Plane error = displayed(n, n, line, plain);
  // The colour term alone at the line's centre, from the same filters.
  const std::vector<GaussianTerm> terms = gaussian_terms(achromatic, default_pixels_per_degree);
  const Kernel& kernel = terms[0].along_column;
  double total = 0.0;
  for (const float w : kernel) total += double(w);
  const double share = double(kernel[kernel.size() / 2]) / total;
  const auto lightness = [](double y) { return 116.0 * std::cbrt(y) - 16.0; };
  const double distance = lightness(0.3 + 0.3 * share) - lightness(0.3);
  const double largest =
      std::pow(double(hyab(to_hunt_lab({0.f, 1.f, 0.f}), to_hunt_lab({0.f, 0.f, 1.f}))), 0.7);
  const double colour = 0.95 / (0.4 * largest) * std::pow(distance, 0.7);
  EXPECT_GT(double(error.row(n / 2)[n / 2]), 1.05 * colour);
  EXPECT_LT(double(error.row(n / 2)[0]), 1e-3);
}

// The definition: a sum over the square of 2 r + 1 pixels, normalised there.
std::vector<double> direct(const Sensitivity& s, double ppd) {
  const int r = filter_radius(ppd);
  std::vector<double> weights;
  double total = 0.0;
  for (int y = -r; y <= r; ++y) {
    for (int x = -r; x <= r; ++x) {
      const double d2 = (x * x + y * y) / (ppd * ppd), pi2 = std::numbers::pi * std::numbers::pi;
      weights.push_back(s.a1 * std::sqrt(std::numbers::pi / s.b1) * std::exp(-pi2 * d2 / s.b1) +
                        s.a2 * std::sqrt(std::numbers::pi / s.b2) * std::exp(-pi2 * d2 / s.b2));
      total += weights.back();
    }
  }
  for (double& w : weights) w /= total;
  return weights;
}

// Terms of separable kernels at offset (x, y).
double separable_at(const std::vector<GaussianTerm>& terms, int x, int y) {
  double sum = 0.0;
  for (const GaussianTerm& t : terms) {
    const int rx = int(t.along_row.size() / 2), ry = int(t.along_column.size() / 2);
    if (std::abs(x) > rx || std::abs(y) > ry) continue;
    sum += double(t.along_row[size_t(x + rx)]) * double(t.along_column[size_t(y + ry)]);
  }
  return sum;
}

TEST_F(Flip, SeparableSensitivitiesAreTheDefinition) {
  for (const double ppd : {1.0, 10.0, default_pixels_per_degree, 200.0}) {
    for (const Sensitivity& s : {achromatic, red_green, blue_yellow}) {
      const std::vector<GaussianTerm> terms = gaussian_terms(s, ppd);
      const std::vector<double> weights = direct(s, ppd);
      const int r = filter_radius(ppd);
      size_t i = 0;
      for (int y = -r; y <= r; ++y) {
        for (int x = -r; x <= r; ++x) {
          EXPECT_NEAR(separable_at(terms, x, y), weights[i++], 1e-7) << ppd;
        }
      }
    }
  }
}

TEST_F(Flip, SeparableDetectorsAreTheDefinition) {
  for (const double ppd : {1.0, 20.0, default_pixels_per_degree}) {
    const double s = 0.5 * 0.082 * ppd;
    const int r = int(std::ceil(3.0 * s));
    const Detectors d(ppd);
    for (const bool edge : {true, false}) {
      const auto weight = [&](int x, int y) {
        const double bell = std::exp(-(x * x + y * y) / (2.0 * s * s));
        return edge ? -x * bell : (x * x / (s * s) - 1.0) * bell;
      };
      double positive = 0.0, negative = 0.0;
      for (int y = -r; y <= r; ++y) {
        for (int x = -r; x <= r; ++x) {
          (weight(x, y) > 0.0 ? positive : negative) += std::abs(weight(x, y));
        }
      }
      const Kernel& across = edge ? d.edge : d.point;
      const GaussianTerm term{across, d.gaussian};
      for (int y = -r; y <= r; ++y) {
        for (int x = -r; x <= r; ++x) {
          const double w = weight(x, y);
          EXPECT_NEAR(separable_at({term}, x, y), w / (w > 0.0 ? positive : negative), 1e-7);
        }
      }
    }
  }
}

// Rows and columns on an image against the sum in two dimensions, borders included.
TEST_F(Flip, FilteringRepeatsTheBorder) {
  const std::vector<std::pair<int, int>> sizes = {{1, 1}, {3, 2}, {17, 29}};
  for (const auto& [width, height] : sizes) {
    Plane image(width, height), rows(width, height);
    std::mt19937 random(7);
    for (float& v : image.values) v = std::uniform_real_distribution<float>(-1.f, 1.f)(random);
    const GaussianTerm term = gaussian_terms(blue_yellow, default_pixels_per_degree)[0];
    const int r = int(term.along_row.size() / 2);
    std::vector<float> padded, out(static_cast<size_t>(width));
    for (int y = 0; y < height; ++y) filter_row(image.row(y), term.along_row, padded, rows.row(y));
    for (int y = 0; y < height; ++y) {
      filter_column(rows, y, term.along_column, out);
      for (int x = 0; x < width; ++x) {
        double sum = 0.0;
        for (int j = -r; j <= r; ++j) {
          for (int i = -r; i <= r; ++i) {
            const int sx = std::clamp(x + i, 0, width - 1), sy = std::clamp(y + j, 0, height - 1);
            sum += separable_at({term}, i, j) * double(image.row(sy)[size_t(sx)]);
          }
        }
        EXPECT_NEAR(double(out[size_t(x)]), sum, 1e-5);
      }
    }
  }
}

TEST_F(Flip, ColourSpacesComeBack) {
  for (const Rgb& c : random_colours(100, 8)) {
    const Rgb back = from_ycxcz(to_ycxcz(c));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], c[i], 1e-5f);
  }
  const vec3 white = to_hunt_lab(Rgb(1.f));
  EXPECT_NEAR(white.x, 100.f, 1e-3f);
  EXPECT_NEAR(white.y, 0.f, 1e-3f);
  EXPECT_NEAR(white.z, 0.f, 1e-3f);
  EXPECT_NEAR(to_ycxcz(Rgb(0.f)).x, -16.f, 1e-5f);
}

// Luminances 1, 1, 1 and 64: six stops between median and maximum.
TEST_F(Flip, ExposuresOneStopApart) {
  const Exposures e = exposures_for(Colours{Rgb(1.f), Rgb(1.f), Rgb(64.f), Rgb(1.f)});
  EXPECT_EQ(e.count, 6);
  EXPECT_NEAR(e.stop - e.start, 6.0, 1e-6);
  EXPECT_NEAR(tone_mapped(std::exp2(e.stop)), 0.85f, 1e-5f);
  EXPECT_NEAR(tone_mapped(64.0 * std::exp2(e.start)), 0.85f, 1e-5f);
  EXPECT_EQ(exposures_for(uniform(3, Rgb(2.f))).count, 2);  // at least two
  EXPECT_EQ(exposures_for(uniform(3, Rgb(0.f))).count, 1);
  // Of an even number the middle is the mean of two; black pixels give way if they are the median.
  EXPECT_NEAR(exposures_for(Colours{Rgb(1.f), Rgb(3.f)}).stop,
              exposures_for(Colours{Rgb(2.f)}).stop, 1e-6);
  const Exposures dark =
      exposures_for(Colours{Rgb(0.f), Rgb(0.f), Rgb(0.f), Rgb(-1.f), Rgb(1.f), Rgb(2.f), Rgb(4.f)});
  EXPECT_NEAR(dark.stop - dark.start, 1.0, 1e-6);
}

TEST_F(Flip, ToneCurve) {
  EXPECT_EQ(tone_mapped(0.0), 0.f);
  EXPECT_EQ(tone_mapped(-3.0), 0.f);
  EXPECT_EQ(tone_mapped(1e30), 1.f);
  // x = 1: 0.36 * 2.51 + 0.018 over 0.36 * 2.43 + 0.354 + 0.14.
  EXPECT_NEAR(tone_mapped(1.0), float(0.9216 / 1.3688), 1e-6f);
}

// An image of one brightness is looked at from two exposures that are the same: the answer is that
// of the tone-mapped images.
TEST_F(Flip, RadianceIsTheLargestOverExposures) {
  const Colours r = random_colours(20 * 20, 9), noise = random_colours(20 * 20, 10);
  Colours x = r;
  for (size_t i = 0; i < x.size(); ++i) x[i] = r[i] * (0.5f + noise[i]);
  const Exposures e = exposures_for(r);
  Plane expected(20, 20);
  for (int i = 0; i < e.count; ++i) {
    Colours a = x, b = r;
    for (Colours* colours : {&a, &b}) {
      for (Rgb& c : *colours) {
        for (int k = 0; k < 3; ++k) c[k] = tone_mapped(double(c[k]) * std::exp2(e.at(i)));
      }
    }
    const Plane error = displayed(20, 20, a, b);
    for (size_t p = 0; p < error.values.size(); ++p) {
      expected.values[p] = std::max(expected.values[p], error.values[p]);
    }
  }
  const Plane error = radiance(20, 20, x, r);
  for (size_t p = 0; p < error.values.size(); ++p) {
    EXPECT_NEAR(error.values[p], expected.values[p], 1e-6f);
  }
}

// A difference in the highlights that clips at the median's exposure is found at a lower one.
TEST_F(Flip, HighlightsCount) {
  constexpr int n = 48;
  Colours r = uniform(n * n, Rgb(0.01f));
  for (int y = 16; y < 32; ++y) {
    for (int x = 16; x < 32; ++x) r[size_t(y * n + x)] = Rgb(100.f);
  }
  Colours picture = r;
  for (Rgb& c : picture) {
    if (c.x > 1.f) c = Rgb(50.f);
  }
  EXPECT_GT(double(radiance(n, n, picture, r).row(24)[24]), 0.1);
}

TEST_F(Flip, RefusesBadArguments) {
  const Colours a = uniform(4, Rgb(0.f));
  EXPECT_THROW(displayed_error({2, 2, a}, {4, 1, a}, pool_), Error);
  for (const double ppd : {0.0, -1.0, 0.5, 1e9, std::nan("")}) {
    EXPECT_THROW(displayed(2, 2, a, a, ppd), Error);
  }
}

}  // namespace
}  // namespace pssmlt::flip
