// References: own error, combining, files. Renders have fixed seeds and numbers of rounds.
#include "app/compare/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/compare/session_racer.h"
#include "app/metrics/metrics.h"
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

TEST(Combine, WeighsByVariance) {
  const test::Folder folder;
  const LoadedScene scene = test::load_small(folder);
  const Half few = share(scene, "independent(path)", 1, 32);
  const Half many = share(scene, "independent(path)", 2, 128);
  const Reference r = combine(few, many);
  EXPECT_FALSE(r.agreement->biased) << r.agreement->text;
  // The samples' ratio is 4, log 1.39, but variances of so few skewed pixels tell it poorly: over
  // 16 pairs of seeds the logarithm's mean is 0.87, its deviation 0.46. With these fixed seeds the
  // limit is no statistical test; it tells from equal weights (log 0) and exchanged ones alone.
  const auto distance = [&](const Image& a) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i)
      sum += std::fabs(double{a.data[i]} - double{r.image.data[i]});
    return sum;
  };
  const double ratio = distance(few.result.image) / distance(many.result.image);
  EXPECT_NEAR(std::log(ratio), std::log(4.0), 0.8);
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
