// The sampler "pssmlt" over integrators in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/archive.h"
#include "core/metropolis/normalisation.h"
#include "core/sampling/replay.h"
#include "tests/samplers/peaked.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using test::ToyRender;
using namespace test::peaked;

TEST(Pssmlt, IsRightByDefault) { expect_right({}); }
TEST(Pssmlt, IsRightWithTheBootstrapsB) { expect_right({test::text("b", "bootstrap")}); }
TEST(Pssmlt, IsRightWithKelemenWeights) { expect_right({test::text("weights", "kelemen")}); }
TEST(Pssmlt, IsRightWithGaussianStepsOfAllKinds) {
  expect_right({test::text("kernel", "gaussian"), test::number("sigma", 0.05f),
                test::number("filmsigma", 0.2f), test::number("rangeprobability", 0.3f)});
}
TEST(Pssmlt, IsRightWithCauchyStepsAndOneKind) {
  expect_right({test::text("kernel", "cauchy"), test::number("filmprobability", 0.f),
                test::number("streamprobability", 0.f)});
}

// An island that 12 of 12000 candidates find on average holds half the light and lights the first
// pixel: each of them starts about ten chains, which seldom leave it and seldom are joined.
void island(PrimarySample& u, Splats& out) {
  (void)u.raster();
  const float p = u.numbers(Stream::camera, 1).next();
  if (p < 0.001f) {
    out.light(dvec2(0.5), Rgb(1000.f), {});
  } else {
    out.camera(Rgb(1.f), {});
  }
}

// What few candidates found must make the halves differ as much as runs do: over 300 seeds the mean
// of the squared half difference is that of the squared deviation from the mean (z-score, false
// alarm 1e-7). It is the island's share of the picture that is measured: a chain's credits always
// add up to b. Were the chains of one candidate dealt to both halves, the first would be a small
// part of the second.
TEST(Pssmlt, HalvesDifferAsMuchAsRunsDo) {
  const RasterMap map = test::box_map(width, height);
  constexpr int seeds = 300;
  std::vector<double> shares, stated;
  MeanTally mean;
  for (int seed = 0; seed < seeds; ++seed) {
    ToyRender render("pssmlt",
                     {test::integer("bootstrapsamples", 12000), test::integer("chains", 256),
                      test::number("largestepprobability", 0.02f)},
                     island, map, static_cast<uint64_t>(seed));
    render.rounds(2);
    std::array<double, 2> first{}, all{};
    for (int g = 0; g < group_count; ++g) {
      const auto half = static_cast<size_t>(g % 2);
      first[half] += render.film().sum(0, 0, g);
      for (int p = 0; p < pixels; ++p) all[half] += render.film().sum(0, p, g);
    }
    shares.push_back((first[0] + first[1]) / (all[0] + all[1]));
    stated.push_back(sqr((first[0] / all[0] - first[1] / all[1]) / 2));
    mean.add(shares.back());
  }
  MeanTally surplus;
  for (size_t i = 0; i < shares.size(); ++i) {
    surplus.add(stated[i] - sqr(shares[i] - mean.mean()) * seeds / (seeds - 1.0));
  }
  EXPECT_LT(std::abs(surplus.mean()), test::z_limit * surplus.standard_error());
}

TEST(Pssmlt, FollowsAnIntegratorThatReadsNoRaster) {
  const RasterMap map = test::box_map(width, height);
  const auto f = [](PrimarySample& u, Splats& out) {
    Numbers light = u.numbers(Stream::light, 0);
    const vec2 at = light.next2();
    out.light(dvec2(at.x * float{width}, at.y * float{height}), Rgb(at.x < 0.5f ? 3.f : 1.f), {});
  };
  ToyRender render("pssmlt", settings(), f, map, 1);
  render.rounds(60);
  for (int p = 0; p < pixels; ++p) {
    EXPECT_NEAR(render.pixel(p), p % width < 4 ? 3.0 : 1.0, 0.35);
  }
  nlohmann::json report;
  render.sampler().report(report);
  EXPECT_FALSE(report["acceptance"].contains("film"));
  EXPECT_FALSE(report["acceptance"].contains("camera"));
}

TEST(Pssmlt, HasTheRightScaleFromTheFirstRound) {
  const RasterMap map = test::box_map(width, height);
  double exact = 0.0;
  for (int p = 0; p < pixels; ++p) exact += peaked_pixel(p);
  ToyRender render("pssmlt", settings(), peaked, map, 4);
  EXPECT_EQ(render.sampler().scale(0, 0, 0), 0.0);
  for (int round = 1; round < 10; ++round) {
    render.rounds(1);
    double sum = 0.0;
    for (int p = 0; p < pixels; ++p) sum += render.pixel(p);
    EXPECT_NEAR(sum, exact, 0.2 * exact) << round;
  }
}

TEST(Pssmlt, BIsRefinedAndItsErrorFalls) {
  const RasterMap map = test::box_map(width, height);
  ToyRender refined("pssmlt", settings(), peaked, map, 4);
  ToyRender kept("pssmlt", settings({test::text("b", "bootstrap")}), peaked, map, 4);
  const double start = refined.sampler().scale_relative_variance();
  EXPECT_GT(start, 0.0);
  EXPECT_EQ(kept.sampler().scale_relative_variance(), start);
  refined.rounds(100);
  kept.rounds(100);
  // 16000 samples and 0.3 * 64 * 16 * 100 large steps: the variance falls by 2.92. The ratio's
  // relative deviation is about 1 %.
  EXPECT_NEAR(refined.sampler().scale_relative_variance(), start / 2.92, 0.1 * start / 2.92);
  EXPECT_EQ(kept.sampler().scale_relative_variance(), start);
  double exact = 0.0;
  for (int p = 0; p < pixels; ++p) exact += peaked_pixel(p) / pixels;
  nlohmann::json report;
  refined.sampler().report(report);
  EXPECT_LT(std::abs(report["b"].get<double>() - exact),
            test::z_limit * report["b_standard_error"].get<double>());
  EXPECT_GT(report["b_samples"].get<int>(), 30000);
  EXPECT_GT(report["bootstrap_contributing"].get<int>(), 500);
  EXPECT_EQ(report["mutations"].get<int>(), 64 * 16 * 100);
  for (const char* kind : {"large", "all", "film", "camera", "light", "connection"}) {
    ASSERT_TRUE(report["acceptance"].contains(kind)) << kind;
    EXPECT_GT(report["acceptance"][kind]["rate"].get<double>(), 0.0);
    EXPECT_LE(report["acceptance"][kind]["rate"].get<double>(), 1.0);
  }
}

TEST(Pssmlt, IsAFunctionOfTheSeedAlone) {
  const RasterMap map = test::box_map(width, height);
  ToyRender a("pssmlt", settings(), peaked, map, 8), b("pssmlt", settings(), peaked, map, 8);
  ToyRender c("pssmlt", settings(), peaked, map, 9);
  a.rounds(5);
  b.rounds(5, true);
  c.rounds(5);
  Archive states[3];
  a.sampler().save(states[0]);
  b.sampler().save(states[1]);
  c.sampler().save(states[2]);
  EXPECT_TRUE(states[0].bytes() == states[1].bytes());
  EXPECT_TRUE(states[0].bytes() != states[2].bytes());
  EXPECT_EQ(a.sampler().scale(0, 0, 5), b.sampler().scale(0, 0, 5));
}

TEST(Pssmlt, GoesOnBitForBitAfterLoading) {
  const RasterMap map = test::box_map(width, height);
  for (const char* weights : {"expected", "kelemen"}) {
    const ParameterSet set = settings({test::text("weights", weights)});
    ToyRender whole("pssmlt", set, peaked, map, 8), first("pssmlt", set, peaked, map, 8);
    ToyRender second("pssmlt", set, peaked, map, 8);
    whole.rounds(3);
    first.rounds(3);
    Archive saved;
    first.sampler().save(saved);
    Archive loaded(saved.bytes());
    second.sampler().load(loaded);
    second.set_rounds(3);
    const std::vector<double> before = whole.film().all();
    whole.rounds(4);
    second.rounds(4);
    for (size_t i = 0; i < before.size(); ++i) {
      EXPECT_NEAR(whole.film().all()[i] - before[i], second.film().all()[i],
                  1e-9 * (1.0 + std::abs(before[i])));
    }
    Archive a, b;
    whole.sampler().save(a);
    second.sampler().save(b);
    EXPECT_TRUE(a.bytes() == b.bytes());
    Archive truncated(saved.bytes().substr(0, saved.bytes().size() / 2));
    EXPECT_THROW(second.sampler().load(truncated), Error);
  }
}

TEST(Pssmlt, KeepsChainsCompactly) {
  const RasterMap map = test::box_map(width, height);
  ToyRender render("pssmlt", settings(), peaked, map, 8);
  render.rounds(20);
  Archive saved;
  render.sampler().save(saved);
  // At most 16 numbers and 2 splats are in use here.
  EXPECT_LT(saved.bytes().size() / 64, 1024 + 8 * 16 + 2 * sizeof(Splat));
}

TEST(Pssmlt, ABlackSceneIsBlack) {
  const RasterMap map = test::box_map(width, height);
  ToyRender render(
      "pssmlt", settings(), [](PrimarySample& u, Splats&) { (void)u.raster(); }, map, 1);
  render.rounds(3);
  for (int p = 0; p < pixels; ++p) EXPECT_EQ(render.pixel(p), 0.0);
  EXPECT_EQ(render.film().adds(), 0u);
  EXPECT_EQ(render.sampler().group_scale(0, 0, 3), 0.0);
  EXPECT_EQ(render.sampler().scale_relative_variance(), 0.0);
  EXPECT_GT(render.sampler().samples(0), 0.0);
  nlohmann::json report;
  render.sampler().report(report);
  EXPECT_EQ(report["b"].get<double>(), 0.0);
  Archive saved;
  render.sampler().save(saved);
  Archive loaded(saved.bytes());
  EXPECT_NO_THROW(render.sampler().load(loaded));
}

// Bad samples never become current and never reach the film; what is left is the picture without
// them. Each kind in a part of its own of the space.
TEST(Pssmlt, BadSamplesAreRejectedCountedAndReplayable) {
  const RasterMap map = test::box_map(width, height);
  const auto f = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    const float x = u.numbers(Stream::camera, 1).next();
    if (x > 0.9f) out.camera(Rgb(std::numeric_limits<float>::quiet_NaN()), {});
    if (x > 0.8f && x <= 0.9f) out.camera(Rgb(infinity), {});
    if (x > 0.7f && x <= 0.8f) out.camera(Rgb(-1.f), {});
    if (x > 0.6f && x <= 0.7f) throw std::runtime_error("broken");
    if (x <= 0.6f) out.camera(Rgb(2.f), {});
  };
  ToyRender render("pssmlt", settings(), f, map, 1);
  render.rounds(60);
  for (const Rejection cause :
       {Rejection::nan, Rejection::infinite, Rejection::negative, Rejection::threw}) {
    EXPECT_GT(render.log().of(cause), 100u);
  }
  for (int p = 0; p < pixels; ++p) EXPECT_NEAR(render.pixel(p), 1.2, 0.2);
  for (const ReplayKey& key : render.log().examples()) {
    ToyRender again("pssmlt", settings(), f, map, 1);
    const uint64_t before = again.log().of(key.cause);
    ASSERT_TRUE(again.sampler().replay(key.text, again.worker()));
    EXPECT_EQ(again.log().of(key.cause), before + 1);
  }
}

TEST(Pssmlt, RefusesAnIntegratorThatChanges) {
  const RasterMap map = test::box_map(width, height);
  EXPECT_THROW(ToyRender("pssmlt", {}, peaked, map, 1, false), Error);
}

TEST(Pssmlt, ChecksItsParameters) {
  EXPECT_EQ(ToyRender::make("pssmlt", {})->default_spp(), 100.0);
  EXPECT_TRUE(ToyRender::make("pssmlt", {})->is_chain());
  EXPECT_EQ(ToyRender::make("pssmlt", {test::text("weights", "kelemen")})->planes(), 2);
  EXPECT_NO_THROW(ToyRender::make("pssmlt", {test::number("sigma", 0.02f)}));
  const std::vector<ParameterSet> bad = {
      {test::number("largestepprobability", -0.1f)},
      {test::number("largestepprobability", 1.5f)},
      {test::number("filmprobability", 0.6f), test::number("streamprobability", 0.6f)},
      {test::text("kernel", "kelemen"), test::number("sigma", 0.02f)},
      {test::number("sigma", 0.f)},
      {test::number("filmsigma", -1.f)},
      {test::text("kernel", "normal")},
      {test::text("target", "red")},
      {test::integer("chains", -1)},
      {test::integer("bootstrapsamples", 0)},
      {test::integer("mutationsperpixel", 0)},
      {test::integer("pixelsamples", 4)}};
  for (const ParameterSet& set : bad) EXPECT_THROW(ToyRender::make("pssmlt", set), Error);
}

}  // namespace
}  // namespace pssmlt
