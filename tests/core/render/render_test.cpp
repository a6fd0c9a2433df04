#include "core/render/render.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/core/render/session_support.h"

namespace pssmlt {
namespace {

using test::build_small;
using test::build_toy;
using test::settings_for;

std::vector<std::string> all(const std::string& kind) { return Registry::instance().names(kind); }

TEST(Render, ThreadsDoNotChangeABit) {
  for (const std::string& sampler : all("sampler")) {
    for (const std::string& integrator : all("integrator")) {
      const auto image = [&](int threads) {
        return render(build_small(integrator, sampler), settings_for(3, threads)).image.data;
      };
      const std::vector<float> one = image(1);
      EXPECT_EQ(one, image(2)) << integrator << " under " << sampler;
      EXPECT_EQ(one, image(5)) << integrator << " under " << sampler;
    }
  }
}

TEST(Render, SeedsDiffer) {
  const auto image = [](uint64_t seed) {
    return render(build_small("path", "independent"), settings_for(2, 2, seed)).image.data;
  };
  EXPECT_NE(image(1), image(2));
}

TEST(Render, OddSizesAndCrops) {
  const auto white = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    out.camera(Rgb(0.25f, 0.5f, 1.f), {});
  };
  for (const ivec2 size : {ivec2(1, 1), ivec2(1, 37), ivec2(33, 2), ivec2(65, 31)}) {
    BuildOptions options;
    options.size = size;
    if (size.x > 4) options.crop = {3, size.x - 1, 0, size.y};
    BuiltScene scene = build_small("path", "independent", "", options);
    scene.layers[0].integrator = std::make_shared<test::ToyIntegrator>(white);
    const RenderResult r = render(scene, settings_for(4));
    EXPECT_EQ(r.image.width, size.x > 4 ? size.x - 4 : size.x);
    EXPECT_EQ(r.image.height, size.y);
    for (size_t i = 0; i < r.image.data.size(); ++i) {
      const float expected[] = {0.25f, 0.5f, 1.f};
      const double factor = scene.exposure;
      EXPECT_NEAR(r.image.data[i], expected[i % 3] * factor, 1e-5);
    }
  }
}

// The same window of the picture whether the rest is rendered or not: x and y are not exchanged.
TEST(Render, CropIsAWindowOfThePicture) {
  const auto ramp = [](PrimarySample& u, Splats& out) {
    const dvec2 at = glm::floor(u.raster());
    out.camera(Rgb(static_cast<float>(at.x), static_cast<float>(at.y), 1.f), {});
  };
  BuildOptions options;
  options.crop = {2, 9, 5, 8};
  const std::string box = "PixelFilter \"box\"";
  BuiltScene scene = build_small("path", "sobol", box, options);
  scene.layers[0].integrator = std::make_shared<test::ToyIntegrator>(ramp);
  const RenderResult r = render(scene, settings_for(4));
  ASSERT_EQ(r.image.width, 7);
  ASSERT_EQ(r.image.height, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 7; ++x) {
      EXPECT_NEAR(r.image.pixel(x, y)[0], x + 2, 1e-4);
      EXPECT_NEAR(r.image.pixel(x, y)[1], y + 5, 1e-4);
    }
  }
}

TEST(Render, LengthsSumToThePicture) {
  for (const std::string sampler : {"sobol", "pssmlt"}) {
    for (const std::string& integrator : all("integrator")) {
      RenderSettings settings = settings_for(8);
      settings.per_length = settings.per_strategy = true;
      const RenderResult r = render(build_small(integrator, sampler), settings);
      std::vector<double> lengths(r.image.data.size()), strategies(r.image.data.size());
      double most = 0.0;
      for (const float v : r.image.data) most = std::max(most, std::fabs(double{v}));
      for (const SplitImage& s : r.splits) {
        auto& sum = s.name.starts_with("length") ? lengths : strategies;
        for (size_t i = 0; i < sum.size(); ++i) sum[i] += double{s.image.data[i]};
      }
      for (size_t i = 0; i < lengths.size(); ++i) {
        EXPECT_NEAR(lengths[i], r.image.data[i], 1e-5 * most) << integrator << " " << sampler;
        EXPECT_NEAR(strategies[i], r.image.data[i], 1e-5 * most) << integrator << " " << sampler;
      }
    }
  }
}

// Equal halves: the picture is their mean.
TEST(Render, PictureIsTheMeanOfItsHalves) {
  for (const std::string& sampler : all("sampler")) {
    const RenderResult r = render(build_small("bdpt", sampler), settings_for(64));
    ASSERT_EQ(r.half[0].data.size(), r.image.data.size()) << sampler;
    double image = 0.0, halves = 0.0;
    for (size_t i = 0; i < r.image.data.size(); ++i) {
      image += double{r.image.data[i]};
      halves += 0.5 * (double{r.half[0].data[i]} + double{r.half[1].data[i]});
    }
    EXPECT_NEAR(halves / image, 1.0, 0.02) << sampler;
  }
}

TEST(Render, LayersAddUp) {
  const std::string layers = R"(
LayerBegin "direct" Sampler "sobol" Integrator "path" "integer maxdepth" 1 LayerEnd
LayerBegin "rest" Sampler "independent" Integrator "path" "integer mindepth" 2 LayerEnd
)";
  const BuiltScene both = build_small("", "", layers);
  ASSERT_EQ(both.layers.size(), 2u);
  const RenderResult r = render(both, settings_for(32));
  ASSERT_EQ(r.rounds.size(), 2u);
  EXPECT_EQ(r.rounds[0], 32);
  EXPECT_EQ(r.rounds[1], 32);
  const RenderResult whole = render(build_small("path", "sobol"), settings_for(128));
  ASSERT_TRUE(r.error.mean_known);
  ASSERT_TRUE(whole.error.mean_known);
  // Both intervals are 95 % ones, i.e. two deviations; 5.3 deviations of the difference is a false
  // alarm once in 1e7.
  const double deviation =
      0.5 * std::hypot(r.error.mean_high - r.error.mean, whole.error.mean_high - whole.error.mean);
  EXPECT_NEAR(r.error.mean, whole.error.mean, 5.3 * deviation);
}

// Exponential noise of mean 1 and variance 1 in every pixel: the estimate is right on average (the
// pixels' own values, which at this relative variance make up nearly all of the denominator, raise
// it by 3 / samples, 2.4 %), and its interval, meant
// to hold in 95 %, holds in 24 renders at least 17 times (chance of less: 1e-5 for 95 %).
TEST(Render, ErrorEstimateIsCalibrated) {
  const auto noise = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    Numbers n = u.numbers(Stream::camera, 1);
    out.camera(Rgb(-std::log(1.f - n.next())), {});
  };
  constexpr int renders = 24, samples = 128;
  const double expected = 1.0 / samples / (1.0 + relative_mse_epsilon);
  double estimated = 0.0;
  int covered = 0;
  for (int i = 0; i < renders; ++i) {
    const BuiltScene scene = build_toy(noise, "independent", ivec2(32, 32));
    const RenderResult r = render(scene, settings_for(samples, 2, static_cast<uint64_t>(i)));
    ASSERT_TRUE(r.error.known);
    estimated += r.error.relative_mse / renders;
    if (r.error.low <= expected && expected <= r.error.high) ++covered;
  }
  // 24 x 1024 squares of normal numbers: deviation 0.9 %.
  EXPECT_NEAR(estimated / expected, 1.024, 5.3 * 0.009);
  EXPECT_GE(covered, 17);
}

TEST(Render, ErrorIsUnknownAtFirst) {
  const RenderResult r = render(build_small("path", "sobol"), settings_for(3));
  EXPECT_FALSE(r.error.known);
  EXPECT_FALSE(r.error.why.empty());
}

TEST(Render, TargetErrorEndsTheRender) {
  RenderSettings settings = settings_for(1e6);
  settings.target_error = 0.5;
  const RenderResult r = render(build_small("path", "independent"), settings);
  EXPECT_EQ(r.stop, StopReason::error);
  EXPECT_LE(r.error.high, 0.5);
}

TEST(Render, TimeEndsTheRender) {
  RenderSettings settings = settings_for(1e9);
  settings.seconds = 0.05;
  const RenderResult r = render(build_small("path", "independent"), settings);
  EXPECT_EQ(r.stop, StopReason::time);
  EXPECT_TRUE(r.complete);
}

TEST(Render, StopFlagEndsTheRender) {
  std::atomic<bool> stop{false};
  RenderCallbacks callbacks;
  callbacks.stop = &stop;
  callbacks.progress = [&](const Progress& p) {
    if (p.phase == RenderPhase::render && p.samples > 2000.0) stop = true;
  };
  const RenderResult r = render(build_small("path", "independent"), settings_for(1e9), callbacks);
  EXPECT_EQ(r.stop, StopReason::interrupted);
  EXPECT_TRUE(r.complete);
  // What is there is what a render of so many rounds gives.
  const RenderResult same = render(build_small("path", "independent"), settings_for(r.rounds[0]));
  EXPECT_EQ(r.image.data, same.image.data);
}

TEST(Render, SnapshotsComeOnce) {
  RenderSettings settings = settings_for(1e9);
  settings.seconds = 0.2;
  settings.snapshot_seconds = {0.05, 0.1};
  std::vector<double> times;
  RenderCallbacks callbacks;
  callbacks.snapshot = [&](const RenderResult& r) { times.push_back(r.seconds); };
  (void)render(build_small("path", "independent"), settings, callbacks);
  ASSERT_GE(times.size(), 1u);
  ASSERT_LE(times.size(), 2u);
  EXPECT_GE(times[0], 0.05);
}

// Previews are of whole rounds and change nothing, wanted or not.
TEST(Render, PreviewsChangeNothing) {
  for (const char* sampler : {"sobol", "pssmlt"}) {
    const RenderSettings settings = settings_for(500);  // several rounds of chains
    const RenderResult plain = render(build_small("path", sampler), settings);
    int asked = 0, given = 0;
    double samples = 0.0;
    RenderCallbacks callbacks;
    callbacks.wants_preview = [&] { return ++asked > 1; };
    callbacks.preview = [&](const Preview& p) {
      ++given;
      EXPECT_EQ(p.image.data.size(), plain.image.data.size());
      EXPECT_GT(p.samples, samples);
      samples = p.samples;
      EXPECT_EQ(p.layers.size(), 1u);
      EXPECT_TRUE(p.layers[0].contains("report"));
    };
    const RenderResult watched = render(build_small("path", sampler), settings, callbacks);
    EXPECT_GE(asked, 2) << sampler;
    EXPECT_GE(given, 1) << sampler;
    EXPECT_LT(given, asked);
    EXPECT_EQ(watched.image.data, plain.image.data) << sampler;
  }
}

TEST(Render, RejectedSamplesAreCounted) {
  const auto bad = [](PrimarySample& u, Splats& out) {
    const dvec2 at = u.raster();
    const bool corner = at.x < 1.0 && at.y < 1.0;
    out.camera(Rgb(corner ? NAN : 1.f), {});
  };
  const RenderResult r = render(build_toy(bad, "sobol"), settings_for(16));
  EXPECT_GT(r.statistics["rejected"]["total"].get<int>(), 0);
  EXPECT_GT(r.statistics["rejected"]["examples"].size(), 0u);
  for (const float v : r.image.data) EXPECT_TRUE(std::isfinite(v));
}

TEST(Render, BadSettingsAreRefused) {
  EXPECT_THROW((void)render(build_small("path", "sobol"), settings_for(0.0)), Error);
  RenderSettings settings = settings_for(1.0);
  settings.seconds = -1.0;
  EXPECT_THROW((void)render(build_small("path", "sobol"), settings), Error);
  BuiltScene clamped = build_small("path", "pssmlt");
  clamped.max_component = 10.f;
  EXPECT_THROW((void)render(clamped, settings_for(1.0)), Error);
}

// Passes are parallel, seeded units before every round, merged serially in between.
class PassIntegrator final : public Integrator {
 public:
  void prepare(const Scene&) override {}
  void sample(PrimarySample& u, Splats& out, Workspace&) const override {
    (void)u.raster();
    out.camera(Rgb(merged_), {});
  }
  std::string sees() const override { return "L.*E"; }
  bool splats_light() const override { return false; }
  const PathLimits& limits() const override { return limits_; }
  int passes(int64_t) const override { return 16; }
  void pass(int64_t round, int unit, PrimarySample& u) override {
    units_[static_cast<size_t>(unit)] =
        u.numbers(Stream::light, unit).next() + static_cast<float>(round);
  }
  void merge_passes(int64_t) override {
    for (const float v : units_) merged_ += v;
  }
  bool fixed() const override { return false; }

 private:
  PathLimits limits_;
  std::array<float, 16> units_{};
  float merged_ = 0.f;
};

TEST(Render, PassesRunBeforeRounds) {
  const auto image = [](int threads) {
    BuiltScene scene = build_small("path", "sobol");
    scene.layers[0].integrator = std::make_shared<PassIntegrator>();
    return render(scene, settings_for(3, threads)).image.data;
  };
  const std::vector<float> one = image(1);
  EXPECT_GT(one[0], 0.f);
  EXPECT_EQ(one, image(5));
  BuiltScene chain = build_small("path", "pssmlt");
  chain.layers[0].integrator = std::make_shared<PassIntegrator>();
  EXPECT_THROW((void)render(chain, settings_for(1.0)), Error);
}

}  // namespace
}  // namespace pssmlt
