// What chains are worth by region, and what is said where the error cannot be known.
#include "core/render/efficiency.h"

#include <gtest/gtest.h>

#include "app/render_record.h"
#include "app/summary.h"
#include "tests/core/render/session_support.h"

namespace pssmlt {
namespace {

using namespace test;

// 64 x 64 pixels, 16 regions, 32 chains.
BuiltScene build_chains(ToyIntegrator::Function f, std::vector<std::string> set) {
  BuildOptions options;
  options.size = ivec2(64, 64);
  options.set = std::move(set);
  options.set.push_back("sampler.chains=32");
  BuiltScene scene = build_small("path", "pssmlt", "", options);
  scene.layers[0].integrator = std::make_shared<ToyIntegrator>(std::move(f));
  return scene;
}

void constant(PrimarySample& u, Splats& out) {
  (void)u.raster();
  out.camera(Rgb(1.f), {});
}

// Islands of light: one in a hundred points of two numbers, a hundred of them.
void islands(PrimarySample& u, Splats& out) {
  (void)u.raster();
  const vec2 p = u.numbers(Stream::camera, 1).next2() * 10.f;
  if (p.x - std::floor(p.x) < 0.1f && p.y - std::floor(p.y) < 0.1f) out.camera(Rgb(1.f), {});
}

const ChainEfficiency& efficiency_of(const RenderResult& r) {
  EXPECT_EQ(r.efficiency.size(), 1u);
  EXPECT_TRUE(r.efficiency.at(0).has_value());
  return *r.efficiency[0];
}

// Large steps alone over a constant target are independent samples: a mutation is worth one. Each
// region's ratio has a relative deviation of sqrt(2/31), the median of 16 of 8 %; five of those.
TEST(ChainEfficiency, IsOneForIndependentSamples) {
  const BuiltScene scene = build_chains(constant, {"sampler.largestepprobability=1"});
  const RenderResult r = render(scene, settings_for(32));
  const ChainEfficiency& e = efficiency_of(r);
  EXPECT_EQ(e.regions, 16);
  EXPECT_GT(e.median, 0.6);
  EXPECT_LT(e.median, 1.5);
  EXPECT_NEAR(e.worst.share, 1.0 / 16, 0.01);
  EXPECT_TRUE(r.warnings.empty());
}

TEST(ChainEfficiency, OrdinaryChainsDoNotWarn) {
  const RenderResult r = render(build_chains(islands, {}), settings_for(64));
  const ChainEfficiency& e = efficiency_of(r);
  EXPECT_GT(e.worst.effective, 10 * least_efficiency);
  EXPECT_LT(e.worst.effective, e.median);
  EXPECT_TRUE(r.warnings.empty()) << r.warnings.at(0);
  const nlohmann::json& json = r.statistics["layers"][0]["efficiency"];
  EXPECT_EQ(json["collapsed"], false);
  EXPECT_DOUBLE_EQ(json["between_over_within"]["median"].get<double>() * e.median, 1.0);
}

// Chains that stay where they started: 32 independent samples, however long they run. The summary
// names a region inside the picture and the parameter that is wrong.
TEST(ChainEfficiency, CollapseIsSaidWithRegionAndRemedy) {
  const RenderResult r =
      render(build_chains(islands, {"sampler.largestepprobability=0.000001",
                                    "sampler.kernel=gaussian", "sampler.sigma=0.000001"}),
             settings_for(320));
  const ChainEfficiency& e = efficiency_of(r);
  EXPECT_TRUE(e.collapsed());
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("effective samples a mutation in pixels x "), std::string::npos);
  EXPECT_NE(r.warnings[0].find("larger steps (\"sigma\""), std::string::npos) << r.warnings[0];
  const PixelRegion& p = e.worst.pixels;
  EXPECT_TRUE(p.x0 >= 0 && p.x0 % 16 == 0 && p.x1 == p.x0 + 15 && p.y1 == p.y0 + 15 && p.y1 < 64);
  nlohmann::json statistics = r.statistics;
  EXPECT_EQ(statistics["warnings"][0], r.warnings[0]);
  EXPECT_NE(summary_text(statistics).find("warning: " + r.warnings[0]), std::string::npos);
}

TEST(ChainEfficiency, NoLargeStepsAlwaysWarn) {
  const RenderResult r =
      render(build_chains(constant, {"sampler.largestepprobability=0"}), settings_for(16));
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings[0].find("\"largestepprobability\" is 0"), std::string::npos);
  ASSERT_TRUE(r.efficiency.at(0).has_value());  // reported by region all the same
  // b is the bootstrap's, and the picture's mean with it.
  EXPECT_NEAR(r.error.mean, 1.0, 1e-5);
}

TEST(ChainEfficiency, IsForChainsAlone) {
  const BuiltScene scene = build_toy(constant, "sobol", ivec2(64, 64));
  const RenderResult r = render(scene, settings_for(64));
  ASSERT_EQ(r.efficiency.size(), 1u);
  EXPECT_FALSE(r.efficiency[0].has_value());
  EXPECT_FALSE(r.statistics["layers"][0].contains("efficiency"));
}

// A light that one sample in 1000 finds, 2000 of them: two finds say nothing about the error.
TEST(UnknownError, FewContributingBootstrapSamples) {
  const auto rare = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    if (u.numbers(Stream::camera, 1).next() < 1e-3f) out.camera(Rgb(1000.f), {});
  };
  const BuiltScene scene = build_chains(rare, {});
  const RenderResult r = render(scene, settings_for(64));
  const auto found = r.statistics["layers"][0]["report"]["bootstrap_contributing"].get<int>();
  ASSERT_TRUE(found > 0 && found < least_bootstrap) << found;
  EXPECT_FALSE(r.error.known);
  EXPECT_FALSE(r.error.mean_known);
  EXPECT_TRUE(r.variance.data.empty());
  const std::string why =
      "only " + std::to_string(found) + " of 2000 bootstrap samples found light";
  EXPECT_NE(r.error.why.find(why), std::string::npos) << r.error.why;
  ASSERT_FALSE(r.warnings.empty());
  EXPECT_NE(r.warnings[0].find(why), std::string::npos) << r.warnings[0];
  EXPECT_NE(r.warnings[0].find("\"bootstrapsamples\""), std::string::npos);
  EXPECT_EQ(r.statistics["error"]["known"], false);
  EXPECT_FALSE(r.statistics["error"].contains("relative_mse"));
  EXPECT_NE(summary_text(r.statistics).find("error estimate: unknown (" + why), std::string::npos);
  const ImageMetadata data = to_metadata(make_record("scene", scene, 1, r));
  const auto said = std::ranges::find(data, "pssmlt:error", &ImageMetadata::value_type::first);
  ASSERT_NE(said, data.end());
  EXPECT_EQ(said->second.find("unknown (only "), 0u) << said->second;
  EXPECT_FALSE(read_record(data)->error);
}

TEST(UnknownError, NeverEndsARender) {
  const auto rare = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    if (u.numbers(Stream::camera, 1).next() < 1e-3f) out.camera(Rgb(1000.f), {});
  };
  const BuiltScene scene = build_chains(rare, {});
  RenderSettings settings = settings_for(16);
  settings.target_error = 1e6;
  EXPECT_EQ(render(scene, settings).stop, StopReason::samples);
}

}  // namespace
}  // namespace pssmlt
