// References: own error, combining, files. Renders have fixed seeds and numbers of rounds.
#include "app/compare/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/compare/session_racer.h"
#include "app/metrics/metrics.h"
#include "core/base/math.h"
#include "tests/app/compare/small_room.h"

namespace pssmlt::compare {
namespace {

Image grey(int w, int h, float value) {
  Image image(w, h, 3);
  std::fill(image.data.begin(), image.data.end(), value);
  return image;
}

// Halves 0.9 and 1.1: the picture's standard error is 0.1 everywhere.
TEST(OwnError, IsTheMetricOfHalfTheDifference) {
  const auto floor = own_error(grey(8, 8, 1.f), grey(8, 8, 0.9f), grey(8, 8, 1.1f));
  const auto all = metrics();
  for (size_t m = 0; m < all.size(); ++m) {
    ASSERT_TRUE(floor[m]) << all[m].id;
    EXPECT_GT(*floor[m], 0.0) << all[m].id;
  }
  EXPECT_NEAR(*floor[metric_index("mse")], 0.01, 1e-6);
  EXPECT_NEAR(*floor[metric_index("relmse")], 0.01 / 1.01, 1e-6);
  EXPECT_FALSE(own_error(grey(2, 2, 1.f), {}, {})[0]);
}

TEST(RgbLayer, PicksByName) {
  Image image(1, 1, 6);
  image.channel_names = {"B", "G", "R", "half0.R", "half0.G", "half0.B"};
  image.data = {3, 2, 1, 4, 5, 6};
  EXPECT_EQ(rgb_layer(image, "").data, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(rgb_layer(image, "half0").data, (std::vector<float>{4, 5, 6}));
  EXPECT_TRUE(rgb_layer(image, "half1").data.empty());
  Image y(1, 1, 1);
  y.data = {7};
  EXPECT_EQ(rgb_layer(y, "").data, (std::vector<float>{7, 7, 7}));
}

// A technique's share after so many rounds.
Half share(const LoadedScene& scene, const std::string& technique, uint64_t seed, int rounds) {
  const Technique t = parse_technique(technique);
  RenderSettings settings;
  settings.seconds = 1e6;
  settings.threads = 2;
  settings.seed = seed;
  SessionRacer racer(scene.with(t, test::small_options()), settings, nullptr);
  for (int i = 0; i < rounds; ++i) racer.round();
  return {t.name, racer.session().result(false), racer.session().group_blocks()};
}

// A share whose halves have normal errors of this deviation around 1.
Half noisy_share(const std::string& name, unsigned seed, float deviation) {
  std::mt19937 random(seed);
  std::normal_distribution<float> error(1.f, deviation * std::sqrt(2.f));
  Half share{name, {}, {}};
  RenderResult& r = share.result;
  r.image = r.variance = r.half[0] = r.half[1] = Image(64, 48, 3);
  for (size_t i = 0; i < r.image.data.size(); ++i) {
    for (Image& half : r.half) half.data[i] = error(random);
    r.image.data[i] = 0.5f * (r.half[0].data[i] + r.half[1].data[i]);
    r.variance.data[i] = 0.25f * sqr(r.half[0].data[i] - r.half[1].data[i]);
  }
  return share;
}

// The weights follow from the pictures: r = w a + (1 - w) b. Each estimated variance is a mean of
// n = 9216 squares of normal numbers, relative deviation sqrt(2 / n), so that the logarithm of the
// weights' ratio has the deviation 2 / sqrt(n) = 0.021. The limit is five times that (false alarm
// 6e-7).
TEST(Combine, WeighsByVariance) {
  const Half noisy = noisy_share("noisy", 1, 0.2f), calm = noisy_share("calm", 2, 0.1f);
  const Reference r = combine(noisy, calm);
  const auto distance = [&](const Image& a) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i)
      sum += std::fabs(double{a.data[i]} - double{r.image.data[i]});
    return sum;
  };
  const double ratio = distance(noisy.result.image) / distance(calm.result.image);
  EXPECT_NEAR(std::log(ratio), std::log(4.0), 5 * 0.021);
}

// One in 500 values of the noisy share is a spike of 500: variance 250 (the halves' each 500), the
// calm one's 0.01. Weighed by their own values the spikes would seem to be light.
TEST(Combine, DoesNotTakeSpikesForLight) {
  Half spiky = noisy_share("spiky", 1, 0.1f);
  const Half calm = noisy_share("calm", 2, 0.1f);
  std::mt19937 random(3);
  std::bernoulli_distribution spike(1.0 / 500.0);
  RenderResult& r = spiky.result;
  for (size_t i = 0; i < r.image.data.size(); ++i) {
    for (Image& half : r.half) half.data[i] = spike(random) ? 500.f : 0.f;
    r.image.data[i] = 0.5f * (r.half[0].data[i] + r.half[1].data[i]);
    r.variance.data[i] = 0.25f * sqr(r.half[0].data[i] - r.half[1].data[i]);
  }
  const Reference both = combine(spiky, calm);
  double weight = 0.0;  // of the spiky share: where it has a spike, that times its height is added
  for (size_t i = 0; i < r.image.data.size(); ++i) {
    if (r.image.data[i] > 100.f)
      weight = std::max(weight, double{both.image.data[i]} / double{r.image.data[i]});
  }
  EXPECT_LT(weight, 0.01);
}

TEST(Combine, HasAFloorAndAnErrorOfTheMean) {
  const test::Folder folder;
  const LoadedScene scene = test::load_small(folder);
  const Reference r =
      combine(share(scene, "independent(path)", 1, 32), share(scene, "independent(path)", 2, 128));
  EXPECT_FALSE(r.agreement->biased) << r.agreement->text;
  for (const Number& f : r.floor) EXPECT_GT(f.value_or(0.0), 0.0);
  EXPECT_GT(r.mean_error.value_or(0.0), 0.0);
}

// Without direct light the second sees less: that is bias, and nothing is averaged.
TEST(Combine, ReportsWhatSeesLessAsBias) {
  const test::Folder folder;
  const LoadedScene scene = test::load_small(folder);
  const Half all = share(scene, "path", 1, 64);
  const Half less = share(scene, "blind=integrator:path,mindepth=2;sampler:sobol", 2, 64);
  for (const Reference& r : {combine(all, less), combine(less, all)}) {
    EXPECT_TRUE(r.agreement->biased) << r.agreement->text;
    EXPECT_LT(*r.agreement->p_value, bias_probability);
    EXPECT_EQ(r.image.data, all.result.image.data);
  }
}

TEST(Combine, BlackIsNotAveraged) {
  const test::Folder folder;
  BuildOptions options = test::small_options();
  options.set = {"camera.fov=5"};  // the lamp is out of sight
  const LoadedScene scene = test::load_small(folder, options);
  const Half all = share(scene, "path", 1, 16);
  const Half black = share(scene, "none=integrator:path,maxdepth=0;sampler:sobol", 2, 16);
  const Reference r = combine(black, all);
  EXPECT_TRUE(r.agreement->biased);
  EXPECT_EQ(r.image.data, all.result.image.data);
}

TEST(ReferenceFile, IsCheckedAndBringsItsHalves) {
  const test::Folder folder;
  Image layers(4, 2, 9);
  layers.channel_names = {"R",       "G",       "B",       "half0.R", "half0.G",
                          "half0.B", "half1.R", "half1.G", "half1.B"};
  for (size_t i = 0; i < layers.data.size(); ++i)
    layers.data[i] = i % 9 < 3 ? 1.f : i % 9 < 6 ? 0.9f : 1.1f;
  write_image(folder / "r.exr", layers, {}, {});
  const Reference r = read_reference(folder / "r.exr", {4, 2});
  EXPECT_EQ(r.source, "file");
  EXPECT_NEAR(r.floor[0].value_or(0.0), 0.01, 1e-4);
  EXPECT_THROW((void)read_reference(folder / "r.exr", {2, 4}), Error);
  EXPECT_THROW((void)read_reference(folder / "none.exr", {4, 2}), Error);
  layers.data[0] = std::nanf("");
  write_image(folder / "bad.exr", layers, {}, {});
  EXPECT_THROW((void)read_reference(folder / "bad.exr", {4, 2}), Error);
}

}  // namespace
}  // namespace pssmlt::compare
