// pssmlt merge on real renders: the error falls as it must, metadata add up, and what cannot be
// averaged is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "app/commands.h"
#include "app/metrics/metrics.h"
#include "app/render_record.h"
#include "core/base/error.h"
#include "core/base/log.h"
#include "core/image/image_file.h"
#include "tests/support/statistics.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

constexpr int edge = 32;

class Merge : public testing::Test {
 protected:
  Merge() { set_log_level(LogLevel::quiet); }
  ~Merge() override { set_log_level(LogLevel::normal); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  // The Cornell box, small, by path tracing.
  std::string render(const std::string& name, const std::string& seed, const std::string& spp,
                     const Arguments& more = {}, const std::string& sampler = "independent",
                     const std::string& size = "32x32") const {
    Arguments arguments = {std::string(PSSMLT_SOURCE_DIR) + "/scenes/cornell-box.txt",
                           "--size",
                           size,
                           "--integrator",
                           "path",
                           "--sampler",
                           sampler,
                           "--seed",
                           seed,
                           "--spp",
                           spp,
                           "--quiet",
                           "-o",
                           path(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_render(arguments), 0);
    set_log_level(LogLevel::quiet);
    return path(name);
  }
  std::string merge(const std::string& name, Arguments arguments) const {
    arguments.insert(arguments.end(), {"-o", path(name)});
    EXPECT_EQ(run_merge(arguments), 0);
    return path(name);
  }
  std::string refusal(Arguments arguments) const {
    arguments.insert(arguments.end(), {"-o", path("refused.exr")});
    try {
      run_merge(arguments);
    } catch (const Error& error) {
      EXPECT_FALSE(std::filesystem::exists(path("refused.exr")));
      return error.what();
    }
    return "";
  }
  static RenderRecord record(const std::string& file) {
    const std::optional<RenderRecord> r = read_record(read_image_file(file).metadata);
    EXPECT_TRUE(r) << file;
    return r.value_or(RenderRecord{});
  }
  static double mse(const Image& picture, const Image& reference) {
    return compare_images(picture, reference, std::vector<std::string>{"mse"}).values[0];
  }
  test::TemporaryFolder folder_;
};

// The mean square error of an average with weights w is sum w^2 mse plus 2 w0 w1 times the mean
// product of the errors, which is 0 for independent renders: its z over the pixels, whose errors
// are independent here, exceeds z_limit with probability 1e-7 (and, since the reference with 512
// samples a pixel has errors of its own, is shifted by sqrt(1024) * 4 / 512 = 0.25 at most). A
// render merged with itself would have z near sqrt(1024 / 3), so that the test tells the two apart.
TEST_F(Merge, ErrorFallsAsForIndependentRenders) {
  const std::string a = render("a.exr", "1", "4"), b = render("b.exr", "2", "12");
  const Image truth = read_image(render("truth.exr", "99", "512"), "");
  const Image first = read_image(a, ""), second = read_image(b, "");
  const Image merged = read_image(merge("c.exr", {a, b}), "");
  double sum = 0.0, squares = 0.0;
  for (size_t p = 0; p < size_t(edge * edge); ++p) {
    double product = 0.0;
    for (size_t i = 3 * p; i < 3 * p + 3; ++i) {
      product += double(first.data[i] - truth.data[i]) * double(second.data[i] - truth.data[i]);
    }
    sum += product;
    squares += product * product;
  }
  EXPECT_LT(std::abs(sum / std::sqrt(squares)), test::z_limit);
  const double cross = sum / (3.0 * edge * edge);
  const double expected =
      mse(first, truth) / 16.0 + mse(second, truth) * 9.0 / 16.0 + 2.0 * 3.0 / 16.0 * cross;
  EXPECT_NEAR(mse(merged, truth), expected, 1e-5 * expected);
  EXPECT_LT(mse(merged, truth), mse(first, truth));
  EXPECT_LT(mse(merged, truth), mse(second, truth));
}

TEST_F(Merge, MetadataAddUpAndMergesOfMergesAreMerges) {
  const std::string a = render("a.exr", "1", "4"), b = render("b.exr", "2", "12"),
                    c = render("c.exr", "3", "16");
  const std::string all = merge("all.exr", {a, b, c});
  const std::string twice = merge("twice.exr", {c, merge("ab.exr", {a, b})});
  const RenderRecord r = record(all), t = record(twice);
  EXPECT_NEAR(r.samples, 32.0 * edge * edge, 0.5);
  EXPECT_NEAR(r.samples, t.samples, 0.5);
  EXPECT_NEAR(r.seconds, record(a).seconds + record(b).seconds + record(c).seconds, 0.002);
  EXPECT_EQ(r.parts.size(), 3u);
  EXPECT_EQ(t.parts.size(), 3u);
  EXPECT_TRUE(r.one_technique());
  EXPECT_EQ(r.integrator, "path");
  const Image once = read_image(all, ""), again = read_image(twice, "");
  for (size_t i = 0; i < once.data.size(); ++i) {
    ASSERT_NEAR(once.data[i], again.data[i], 1e-5f * std::abs(once.data[i]) + 1e-7f);
  }
  EXPECT_NE(refusal({twice, a}).find("same seed"), std::string::npos);
}

TEST_F(Merge, TechniquesCountByTheirErrors) {
  const std::string a = render("a.exr", "1", "16"), b = render("b.exr", "2", "64", {}, "sobol");
  const RenderRecord first = record(a), second = record(b);
  ASSERT_TRUE(first.error && second.error);
  const std::string merged = merge("c.exr", {a, b});
  const double w = second.error->value / (first.error->value + second.error->value);
  const Image x = read_image(a, ""), y = read_image(b, ""), z = read_image(merged, "");
  for (size_t i = 0; i < z.data.size(); ++i) {
    ASSERT_NEAR(double(z.data[i]), w * double(x.data[i]) + (1.0 - w) * double(y.data[i]),
                1e-4 * std::abs(double(z.data[i])) + 1e-6);
  }
  const RenderRecord r = record(merged);
  EXPECT_FALSE(r.one_technique());
  ASSERT_TRUE(r.error);
  EXPECT_NEAR(r.error->value, 1.0 / (1.0 / first.error->value + 1.0 / second.error->value),
              1e-3 * r.error->value);
}

TEST_F(Merge, LayersFollowTheirFormulas) {
  const Arguments layers = {"--aux", "halves,variance,error,albedo"};
  const std::string a = render("a.exr", "1", "16", layers), b = render("b.exr", "2", "48", layers);
  const ImageFile x = read_image_file(a), y = read_image_file(b),
                  z = read_image_file(merge("c.exr", {a, b}));
  ASSERT_EQ(z.channels, x.channels);
  for (const std::string& name : z.channel_names) {
    for (size_t p = 0; p < size_t(edge * edge); p += 7) {
      const auto at = [&](const ImageFile& f) {
        return double(f.floats[p * size_t(f.channels) + size_t(f.find(name))]);
      };
      double expected = 0.25 * at(x) + 0.75 * at(y);
      if (name.starts_with("variance")) expected = at(x) / 16.0 + at(y) * 9.0 / 16.0;
      if (name.starts_with("error")) expected = std::hypot(0.25 * at(x), 0.75 * at(y));
      ASSERT_NEAR(at(z), expected, 1e-4 * std::abs(expected) + 1e-7) << name;
    }
  }
}

TEST_F(Merge, RefusesWhatMustNotBeAveraged) {
  const std::string a = render("a.exr", "1", "4");
  EXPECT_NE(refusal({a, a}).find("not independent"), std::string::npos);
  // More samples of the same seed begin with the same ones.
  EXPECT_NE(refusal({a, render("b.exr", "1", "8")}).find("not independent"), std::string::npos);
  EXPECT_NE(refusal({a, render("b.exr", "2", "4", {}, "sobol", "31x32")}).find("31 x 32"),
            std::string::npos);
  EXPECT_NE(refusal({a, render("b.exr", "2", "4", {"--set", "integrator.maxdepth=2"})})
                .find("do not show the same"),
            std::string::npos);
  EXPECT_NE(refusal({a, render("b.exr", "2", "4", {"--set", "camera.fov=20"})})
                .find("do not show the same"),
            std::string::npos);
  folder_.write("other.txt",
                "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32\nWorldBegin\n"
                "LightSource \"infinite\"\n");
  const Arguments other = {path("other.txt"), "--spp", "4",          "--seed", "2",
                           "--quiet",         "-o",    path("o.exr")};
  ASSERT_EQ(run_render(other), 0);
  EXPECT_NE(refusal({a, path("o.exr")}).find("different scenes"), std::string::npos);
}

TEST_F(Merge, ForceMergesButSaysNothingOfTheError) {
  const std::string a = render("a.exr", "1", "16");
  const RenderRecord r = record(merge("c.exr", {a, a, "--force"}));
  EXPECT_FALSE(r.error);
  EXPECT_EQ(r.parts.size(), 2u);
  // The other refusals are not about independence and stay.
  EXPECT_NE(refusal({a, render("b.exr", "2", "4", {"--set", "camera.fov=20"}), "--force"}), "");
}

TEST_F(Merge, WithoutMetadataWeightsAreAskedFor) {
  const std::string a = render("a.pfm", "1", "4"), b = render("b.pfm", "2", "4");
  EXPECT_NE(refusal({a, b}).find("--weights"), std::string::npos);
  const Image x = read_image(a, ""), y = read_image(b, ""),
              z = read_image(merge("c.exr", {a, b, "--weights", "1,3"}), "");
  for (size_t i = 0; i < z.data.size(); ++i) {
    ASSERT_NEAR(z.data[i], 0.25f * x.data[i] + 0.75f * y.data[i], 1e-6f + 1e-5f * z.data[i]);
  }
  EXPECT_NE(refusal({path("c.exr"), a}).find("--weights"), std::string::npos);
}

TEST_F(Merge, RefusesBadUsage) {
  const std::string a = render("a.exr", "1", "4"), b = render("b.exr", "2", "4");
  std::filesystem::copy_file(b, path("cut.exr"));
  std::filesystem::resize_file(path("cut.exr"), std::filesystem::file_size(b) / 2);
  for (const Arguments& arguments : std::vector<Arguments>{{a},
                                                           {a, b, "--weights", "1"},
                                                           {a, b, "--weights", "1,2,3"},
                                                           {a, b, "--weights", "1,-1"},
                                                           {a, b, "--weights", "0,1"},
                                                           {a, b, "--weights", "nan,1"},
                                                           {a, b, "--weights", "inf,1"},
                                                           {a, b, "--weights", "1,x"},
                                                           {a, b, "--nonsense"},
                                                           {a, path("cut.exr")},
                                                           {a, path("missing.exr")},
                                                           {a, folder_.path().string()}}) {
    EXPECT_NE(refusal(arguments), "") << arguments.back();
  }
  EXPECT_THROW(run_merge({a, b}), Error);
  EXPECT_THROW(run_merge({a, b, "-o", path("nowhere/c.exr")}), Error);
  EXPECT_THROW(run_merge({a, b, "-o", path("c.xyz")}), Error);
}

// The output may be one of the inputs, and 8-bit formats are written as by a render.
TEST_F(Merge, OutputFormats) {
  const std::string a = render("a.exr", "1", "4"), b = render("b.exr", "2", "4");
  merge("c.png", {a, b});
  EXPECT_EQ(read_image(path("c.png"), "").width, edge);
  merge("a.exr", {a, b});
  EXPECT_EQ(record(a).parts.size(), 2u);
}

}  // namespace
}  // namespace pssmlt
