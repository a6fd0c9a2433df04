// Metrics against values worked out by hand, and what happens to pixels that are no numbers.
#include "app/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.h"
#include "core/base/rgb.h"

namespace pssmlt {
namespace {

constexpr float nan_float = std::numeric_limits<float>::quiet_NaN();

Image uniform(int width, int height, const Rgb& colour) {
  Image image(width, height, 3);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = colour[static_cast<int>(i % 3)];
  return image;
}

void set(Image& image, int x, int y, const Rgb& colour) {
  for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = colour[c];
}

Image noisy(const Image& image, float amount, uint32_t seed) {
  Image result = image;
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> u(-1.f, 1.f);
  for (float& v : result.data) v = std::max(0.f, v * (1.f + amount * u(random)));
  return result;
}

Image gradient(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      set(image, x, y,
          {0.1f + 0.02f * float(x), 0.5f + 0.3f * std::sin(0.3f * float(x + y)), 0.05f * float(y)});
    }
  }
  return image;
}

double value(const Comparison& c, const char* id) { return c.values[metric_index(id)]; }

// Two pixels: reference 1, 3 and picture 2, 3 in all channels. Mean luminance 2, epsilon of relMSE
// 0.01 * 4, of SMAPE 0.02.
TEST(Metrics, TwoPixelsByHand) {
  Image r(2, 1, 3), x(2, 1, 3);
  set(r, 0, 0, Rgb(1.f));
  set(r, 1, 0, Rgb(3.f));
  set(x, 0, 0, Rgb(2.f));
  set(x, 1, 0, Rgb(3.f));
  const Comparison c = compare_images(x, r);
  EXPECT_NEAR(value(c, "mse"), 0.5, 1e-12);
  EXPECT_NEAR(value(c, "relmse"), 0.5 / 1.04, 1e-7);
  EXPECT_NEAR(value(c, "relmse_trimmed"), 0.5 / 1.04, 1e-7);  // 0.1 % of two pixels is none
  EXPECT_NEAR(value(c, "smape"), 0.5 / 3.02, 1e-7);
  EXPECT_NEAR(c.mean_bias, 0.25, 1e-7);
  EXPECT_TRUE(std::isnan(c.mean_bias_error));  // one block
  EXPECT_EQ(c.non_finite, 0);
}

// One channel differs: by 0.5 from a grey of 0.5, whose mean luminance is 0.5.
TEST(Metrics, OneChannelByHand) {
  const Comparison c = compare_images(uniform(3, 2, {0.5f, 1.f, 0.5f}), uniform(3, 2, Rgb(0.5f)));
  EXPECT_NEAR(value(c, "mse"), 0.25 / 3.0, 1e-7);
  EXPECT_NEAR(value(c, "relmse"), 0.25 / (3.0 * 0.2525), 1e-7);
  EXPECT_NEAR(value(c, "smape"), 0.5 / (3.0 * 1.505), 1e-7);
  EXPECT_NEAR(c.mean_bias, 0.7152, 1e-6);
}

TEST(Metrics, EqualImagesHaveNoError) {
  const Image image = gradient(37, 23);
  const Comparison c = compare_images(image, image);
  for (const double v : c.values) EXPECT_EQ(v, 0.0);
  EXPECT_EQ(c.mean_bias, 0.0);
  EXPECT_EQ(c.mean_bias_error, 0.0);
}

// 2000 pixels: the two worst go. Errors are 1 in all pixels but three.
TEST(Metrics, TrimmingLeavesOutTheWorst) {
  const Image r = uniform(50, 40, Rgb(1.f));
  Image x = uniform(50, 40, Rgb(2.f));
  set(x, 3, 7, Rgb(101.f));
  set(x, 49, 39, Rgb(1001.f));
  set(x, 0, 0, Rgb(11.f));
  const Comparison c = compare_images(x, r);
  EXPECT_NEAR(value(c, "relmse_trimmed"), (1997.0 + 100.0) / (1998.0 * 1.01), 1e-6);
  EXPECT_NEAR(value(c, "relmse"), (1997.0 + 100.0 + 1e4 + 1e6) / (2000.0 * 1.01), 1e-3);
  const Image map = error_map("relmse_trimmed", x, r);
  EXPECT_TRUE(std::isnan(*map.pixel(3, 7)));
  EXPECT_TRUE(std::isnan(*map.pixel(49, 39)));
  EXPECT_FALSE(std::isnan(*map.pixel(0, 0)));
}

// The worst pixel is the one whose channels' errors sum to most, not the one with the worst
// channel.
TEST(Metrics, TheWorstPixelIsBySumOfChannels) {
  const Image r = uniform(1000, 1, Rgb(1.f));
  Image x = r;
  set(x, 10, 0, Rgb(4.f, 1.f, 1.f));  // 9
  set(x, 20, 0, Rgb(3.f));            // 12
  EXPECT_NEAR(value(compare_images(x, r), "relmse_trimmed"), 9.0 / (3.0 * 999.0 * 1.01), 1e-9);
}

TEST(Metrics, MapsAverageToTheirMetric) {
  const Image r = gradient(40, 30), x = noisy(r, 0.5f, 1);
  const Comparison c = compare_images(x, r);
  for (size_t m = 0; m < metrics().size(); ++m) {
    const Image map = error_map(std::string(metrics()[m].id), x, r);
    ASSERT_EQ(map.channels, 1);
    double sum = 0.0, count = 0.0;
    for (const float v : map.data) {
      if (std::isnan(v)) continue;
      sum += double(v);
      count += 1.0;
    }
    EXPECT_NEAR(sum / count, c.values[m], 1e-6 * c.values[m]) << metrics()[m].id;
  }
}

TEST(Metrics, PixelsThatAreNoNumbersDoNotCount) {
  Image r = gradient(20, 20), x = noisy(r, 0.3f, 2);
  set(x, 4, 4, {1.f, nan_float, 1.f});
  set(x, 5, 4, {std::numeric_limits<float>::infinity(), 0.f, 0.f});
  set(r, 19, 19, {nan_float, nan_float, nan_float});
  const Comparison c = compare_images(x, r);
  EXPECT_EQ(c.non_finite, 3);
  for (const double v : c.values) EXPECT_TRUE(std::isfinite(v));
  EXPECT_TRUE(std::isfinite(c.mean_bias));
  // MSE over the other pixels.
  double sum = 0.0;
  for (size_t i = 0; i < x.data.size(); ++i) {
    const size_t p = i / 3;
    if (p == 4 * 20 + 4 || p == 4 * 20 + 5 || p == 399) continue;
    sum += std::pow(double(x.data[i]) - double(r.data[i]), 2);
  }
  EXPECT_NEAR(value(c, "mse"), sum / (3.0 * 397.0), 1e-12);
  EXPECT_TRUE(std::isnan(*error_map("flip", x, r).pixel(4, 4)));
}

TEST(Metrics, NothingCountsNothingIsKnown) {
  const Image bad = uniform(3, 3, Rgb(nan_float));
  const Comparison c = compare_images(bad, uniform(3, 3, Rgb(1.f)));
  EXPECT_EQ(c.non_finite, 9);
  for (const double v : c.values) EXPECT_TRUE(std::isnan(v));
  EXPECT_TRUE(std::isnan(c.mean_bias));
}

TEST(Metrics, NoPixels) {
  for (const double v : compare_images(Image(0, 0, 3), Image(0, 0, 3)).values) {
    EXPECT_TRUE(std::isnan(v));
  }
}

TEST(Metrics, BlackReference) {
  const Image black = uniform(5, 4, Rgb(0.f));
  for (const double v : compare_images(black, black).values) EXPECT_EQ(v, 0.0);
  const Comparison c = compare_images(uniform(5, 4, Rgb(0.5f)), black);
  EXPECT_NEAR(value(c, "mse"), 0.25, 1e-12);
  EXPECT_TRUE(std::isinf(value(c, "relmse")));  // nothing to be relative to
  EXPECT_EQ(value(c, "smape"), 1.0);
  EXPECT_GT(value(c, "flip"), 0.5);
  EXPECT_TRUE(std::isnan(c.mean_bias));
}

TEST(Metrics, NegativeAndHugeValues) {
  const Image r = uniform(4, 4, Rgb(1.f));
  Image x = r;
  set(x, 1, 1, Rgb(-2.f));
  set(x, 2, 2, Rgb(3e38f));
  const Comparison c = compare_images(x, r);
  EXPECT_NEAR(value(c, "mse") / ((9e76 + 9.0) / 16.0), 1.0, 1e-5);
  EXPECT_LE(value(c, "flip"), 1.0);
  EXPECT_LE(value(c, "smape"), 1.0);
  for (const double v : compare_images(r, x).values) EXPECT_TRUE(std::isfinite(v));
}

TEST(Metrics, RelativeOnesDoNotChangeWithExposure) {
  const Image r = gradient(33, 21), x = noisy(r, 0.4f, 3);
  const Comparison before = compare_images(x, r);
  Image r2 = r, x2 = x;
  for (float& v : r2.data) v *= 0x1p-9f;  // a power of two: exact
  for (float& v : x2.data) v *= 0x1p-9f;
  const Comparison after = compare_images(x2, r2);
  for (const char* id : {"relmse", "relmse_trimmed", "smape"}) {
    EXPECT_NEAR(value(after, id), value(before, id), 1e-12 * value(before, id)) << id;
  }
  EXPECT_NEAR(value(after, "flip"), value(before, "flip"), 1e-6);
  EXPECT_NEAR(value(after, "mse"), value(before, "mse") * 0x1p-18, 1e-12 * value(before, "mse"));
  EXPECT_NEAR(after.mean_bias, before.mean_bias, 1e-12);
}

// Blocks of 16 x 16, four of them, with biases 0, 0, 0.1, 0.3 of a mean of 1: mean 0.1, variance of
// the mean (0.01 + 0.01 + 0 + 0.04) / (4 * 3).
TEST(Metrics, BiasErrorFromBlocksByHand) {
  const Image r = uniform(32, 32, Rgb(1.f));
  Image x = r;
  for (int y = 16; y < 32; ++y) {
    for (int i = 0; i < 32; ++i) set(x, i, y, Rgb(i < 16 ? 1.1f : 1.3f));
  }
  const Comparison c = compare_images(x, r, std::vector<std::string>{"mse"});
  EXPECT_NEAR(c.mean_bias, 0.1, 1e-6);
  EXPECT_NEAR(c.mean_bias_error, std::sqrt(0.06 / 12.0), 1e-6);
}

// Independent noise of known deviation: z of the bias over its error. Standard normal but for a
// Student's t of 63 degrees: 6 is passed with probability 1e-7.
TEST(Metrics, BiasErrorIsTheSpreadOfTheMean) {
  const Image r = uniform(128, 128, Rgb(1.f));
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    const Comparison c = compare_images(noisy(r, 0.5f, seed), r, std::vector<std::string>{"mse"});
    EXPECT_LT(std::abs(c.mean_bias), 6.0 * c.mean_bias_error);
    // Uniform in +-0.5, three channels by their weights, 128^2 pixels.
    const double weights = std::sqrt(0.2126 * 0.2126 + 0.7152 * 0.7152 + 0.0722 * 0.0722);
    const double truth = 0.5 / std::sqrt(3.0) * weights / 128.0;
    // The ratio's square is chi-square over 63: outside (0.3, 2.2) with probability below 1e-6.
    EXPECT_GT(c.mean_bias_error, std::sqrt(0.3) * truth);
    EXPECT_LT(c.mean_bias_error, std::sqrt(2.2) * truth);
  }
}

TEST(Metrics, DoNotDependOnThreads) {
  const Image r = gradient(61, 47), x = noisy(r, 0.5f, 4);
  const Comparison one = compare_images(x, r, {}, 1);
  for (const int threads : {2, 3, 8}) {
    const Comparison many = compare_images(x, r, {}, threads);
    EXPECT_EQ(one.values, many.values) << threads;
    EXPECT_EQ(one.mean_bias_error, many.mean_bias_error);
  }
}

TEST(Metrics, OnlyWhatIsAskedFor) {
  const Image image = gradient(8, 8);
  const Comparison c = compare_images(image, image, std::vector<std::string>{"smape"});
  for (size_t m = 0; m < metrics().size(); ++m) {
    EXPECT_EQ(std::isnan(c.values[m]), metrics()[m].id != "smape");
  }
}

TEST(Metrics, ColoursByName) {
  Image layered(2, 2, 5);
  layered.channel_names = {"A", "depth.Y", "B", "R", "G"};
  Image plain(2, 2, 3);
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 5; ++c) layered.data[size_t(i * 5 + c)] = float(10 * i + c);
    for (int c = 0; c < 3; ++c) plain.data[size_t(i * 3 + c)] = float(10 * i + (c + 1) % 3 + 2);
  }
  EXPECT_EQ(value(compare_images(layered, plain), "mse"), 0.0);
  Image grey(2, 2, 1), colour(2, 2, 3);
  for (float& v : grey.data) v = 0.5f;
  for (float& v : colour.data) v = 0.5f;
  EXPECT_EQ(value(compare_images(grey, colour), "mse"), 0.0);
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  EXPECT_THROW(compare_images(Image(2, 3, 3), Image(3, 2, 3)), Error);
  Image nameless(2, 2, 3);
  nameless.channel_names = {"albedo.R", "albedo.G", "albedo.B"};
  EXPECT_THROW(compare_images(nameless, Image(2, 2, 3)), Error);
  EXPECT_THROW(compare_images(Image(2, 2, 3), Image(2, 2, 3), std::vector<std::string>{"flop"}),
               Error);
  EXPECT_THROW(error_map("", Image(2, 2, 3), Image(2, 2, 3)), Error);
}

TEST(Metrics, OnePixel) {
  const Comparison c = compare_images(uniform(1, 1, Rgb(2.f)), uniform(1, 1, Rgb(1.f)));
  for (const double v : c.values) EXPECT_TRUE(std::isfinite(v));
  EXPECT_GT(value(c, "flip"), 0.0);
}

}  // namespace
}  // namespace pssmlt
