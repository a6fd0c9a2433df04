// References: combining, agreement of two techniques, the cache. Renders have fixed seeds and fixed
// numbers of rounds, or the test does not depend on how many there are.
#include "app/compare/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/compare/distributions.h"
#include "app/compare/reference_cache.h"
#include "app/compare/session_racer.h"
#include "app/compare/text.h"
#include "app/metrics/metrics.h"
#include "core/base/random.h"
#include "tests/app/compare/folder.h"
#include "tests/app/compare/small_room.h"

namespace pssmlt::compare {
namespace {

double normal(RandomStream& random) {
  const double u = 1.0 - random.next_double(), v = random.next_double();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

// Groups of blocks with mean 1; `common`: share of the noise that all blocks of a group have in
// common.
GroupBlocks noise(RandomStream& random, size_t blocks, double common, double factor = 1.0) {
  GroupBlocks g;
  g.across = 4;
  for (int i = 0; i < 32; ++i) {
    auto& row = g.means.emplace_back();
    const double shared = normal(random);
    for (size_t b = 0; b < blocks; ++b) {
      row.push_back(factor +
                    0.1 * (std::sqrt(common) * shared + std::sqrt(1.0 - common) * normal(random)));
    }
  }
  return g;
}

// p-values of pictures that agree are uniform: below 1 % once in a hundred trials. 2000 trials, the
// limit is 5.3 standard errors above: false alarm 1e-7. Blocks that hang together must not change
// that, for which the effective degrees are there; their estimate and Satterthwaite's approximation
// are allowed another per cent.
TEST(Agreement, FalseAlarmsAreAsStated) {
  for (const double common : {0.0, 0.5}) {
    RandomStream random(common > 0.0 ? 2 : 1, RandomUse::test);
    int alarms = 0;
    constexpr int trials = 2000;
    for (int t = 0; t < trials; ++t) {
      const GroupBlocks a = noise(random, 40, common), b = noise(random, 40, common);
      alarms += *test_agreement(a, b, "a", "b").p_value < 0.01 ? 1 : 0;
    }
    const double allowed = common > 0.0 ? 0.02 : 0.01;
    EXPECT_LT(alarms, trials * (allowed + 5.3 * std::sqrt(allowed / trials))) << common;
  }
}

// A difference of 6 % in all blocks is 6 / (10 sqrt(2 / 32)) = 2.4 standard errors in each of 40.
TEST(Agreement, FindsASmallBiasOfAllBlocks) {
  RandomStream random(3, RandomUse::test);
  const GroupBlocks a = noise(random, 40, 0.0), b = noise(random, 40, 0.0, 0.94);
  const Agreement r = test_agreement(a, b, "one", "other");
  EXPECT_TRUE(r.biased);
  EXPECT_LT(*r.p_value, 1e-10);
  EXPECT_EQ(r.blocks, 40);
  EXPECT_NE(r.text.find("one and other do not agree"), std::string::npos) << r.text;
}

// An error of b moves all blocks together; it is no bias if it is as large as stated.
TEST(Agreement, ErrorOfBIsNoBias) {
  RandomStream random(4, RandomUse::test);
  const GroupBlocks a = noise(random, 40, 0.0);
  GroupBlocks b = noise(random, 40, 0.0, 0.94);
  b.common_variance = 0.06 * 0.06;
  EXPECT_GT(*test_agreement(a, b, "a", "b").p_value, 0.01);
}

TEST(Agreement, SpecialCases) {
  RandomStream random(5, RandomUse::test);
  GroupBlocks a = noise(random, 4, 0.0);
  EXPECT_EQ(test_agreement(a, a, "a", "b").p_value, 1.0) << "the same numbers";
  // Black against something.
  GroupBlocks black = a;
  for (auto& row : black.means) row.assign(row.size(), 0.0);
  EXPECT_TRUE(test_agreement(a, black, "a", "b").biased);
  EXPECT_FALSE(test_agreement(black, black, "a", "b").biased);
  // Too few groups.
  a.means.resize(5);
  const Agreement few = test_agreement(a, black, "a", "b");
  EXPECT_FALSE(few.p_value);
  EXPECT_FALSE(few.biased);
}

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
    if (all[m].id == "mse") EXPECT_NEAR(*floor[m], 0.01, 1e-6);
    if (all[m].id == "relmse") EXPECT_NEAR(*floor[m], 0.01 / 1.01, 1e-6);
  }
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
  // The weight of the second is about 4/5.
  const auto distance = [&](const Image& a) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i)
      sum += std::fabs(double{a.data[i]} - double{r.image.data[i]});
    return sum;
  };
  EXPECT_NEAR(distance(few.result.image) / distance(many.result.image), 4.0, 1.0);
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

class ReferenceCache : public testing::Test {
 protected:
  ReferenceCache() {
    setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    request_.techniques = parse_technique_list("path,independent(path)");
    request_.seconds = 0.2;
    request_.threads = 2;
    request_.slice = 0.01;
    request_.progress = [this](double seconds) { progress_ = seconds; };
  }
  ~ReferenceCache() override { unsetenv("XDG_CACHE_HOME"); }
  std::optional<Reference> make() {
    progress_ = 0.0;
    return make_reference(scene_, test::small_options(), request_);
  }
  std::filesystem::path entry() const {
    return reference_folder() / reference_key(scene_, test::small_options(), request_.techniques);
  }
  test::Folder folder_;
  LoadedScene scene_ = test::load_small(folder_);
  ReferenceRequest request_;
  double progress_ = 0.0;
};

TEST_F(ReferenceCache, IsMadeOnceAndGrows) {
  const auto made = make();
  ASSERT_TRUE(made);
  EXPECT_GE(made->seconds, 0.2);
  EXPECT_GT(progress_, 0.0);
  EXPECT_EQ(made->techniques, (std::vector<std::string>{"path", "independent(path)"}));
  const auto again = make();
  EXPECT_EQ(progress_, 0.0) << "nothing is rendered";
  EXPECT_EQ(again->image.data, made->image.data);
  EXPECT_EQ(again->seconds, made->seconds);
  ASSERT_TRUE(again->agreement);
  EXPECT_EQ(again->agreement->text, made->agreement->text);
  for (size_t m = 0; m < made->floor.size(); ++m) {
    EXPECT_NEAR(*again->floor[m], *made->floor[m], 1e-6 * *made->floor[m]);
  }
  request_.seconds = made->seconds + 0.1;
  const auto longer = make();
  EXPECT_GE(longer->seconds, request_.seconds);
  EXPECT_GT(progress_, made->seconds) << "continues from where it was";
}

TEST_F(ReferenceCache, AnInterruptedOneIsContinued) {
  std::atomic<bool> stop{false};
  request_.stop = &stop;
  request_.seconds = 1e6;
  request_.progress = [&](double seconds) {
    progress_ = seconds;
    stop = seconds > 0.05;
  };
  EXPECT_FALSE(make());
  const double before = progress_;
  EXPECT_GT(before, 0.05);
  stop = false;
  double first = 0.0;
  request_.seconds = 2.0 * before + 0.1;
  request_.progress = [&](double seconds) { first = first == 0.0 ? seconds : first; };
  ASSERT_TRUE(make());
  EXPECT_GE(first, before);
}

TEST_F(ReferenceCache, DamageIsRepaired) {
  ASSERT_TRUE(make());
  for (const char* file : {"reference.json", "state-0.checkpoint", "reference.exr"}) {
    std::ofstream(entry() / file, std::ios::trunc) << "{ not what it was";
    EXPECT_TRUE(make()) << file;
  }
}

TEST_F(ReferenceCache, KeyFollowsWhatItDependsOn) {
  const auto key = [&](const BuildOptions& options, const std::string& techniques) {
    const LoadedScene scene = test::load_small(folder_, options);
    return reference_key(scene, options, parse_technique_list(techniques));
  };
  const BuildOptions options = test::small_options();
  const std::string one = key(options, "path,bdpt");
  EXPECT_EQ(key(options, "path,bdpt"), one);
  EXPECT_NE(key(options, "bdpt,path"), one);
  EXPECT_NE(key(options, "path,light"), one);
  BuildOptions other = options;
  other.size = ivec2(16, 12);
  EXPECT_NE(key(other, "path,bdpt"), one);
  other = options;
  other.set.push_back("integrator.maxdepth=3");
  EXPECT_NE(key(other, "path,bdpt"), one);
}

TEST_F(ReferenceCache, SeedsAreTheirOwn) {
  EXPECT_NE(reference_seed(0), reference_seed(1));
  for (int i = 0; i < 2; ++i) EXPECT_GT(reference_seed(i), uint64_t{1} << 40);
}

// A folder that cannot be made: the reference is made all the same.
TEST_F(ReferenceCache, WorksWithoutACache) {
  write_file(folder_ / "file", "");
  setenv("XDG_CACHE_HOME", (folder_ / "file").c_str(), 1);
  EXPECT_TRUE(make());
}

}  // namespace
}  // namespace pssmlt::compare
