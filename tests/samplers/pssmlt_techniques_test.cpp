// What the sampler "pssmlt" can do beside the plain algorithm: each leaves the picture what it is.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/samplers/peaked.h"

namespace pssmlt {
namespace {

using test::ToyRender;
using namespace test::peaked;

TEST(PssmltTechniques, IsRightWithDelayedRejection) {
  expect_right({test::flag("delayedrejection", true)});
  expect_right({test::flag("delayedrejection", true), test::text("weights", "kelemen")});
}
TEST(PssmltTechniques, IsRightWithTunedSteps) { expect_right({test::flag("tunesteps", true)}); }
TEST(PssmltTechniques, IsRightWithTheEqualisedTarget) {
  expect_right({test::text("target", "equalised")}, 10);
}
TEST(PssmltTechniques, IsRightWithStepsOfEnsembles) {
  expect_right({test::number("ensembleprobability", 0.5f), test::integer("chains", 128)});
}

// Light 10 times as bright in one half of the picture: the relative errors of the two halves' sums,
// from the groups. All credits adding up to the same, each half's error is the other's: 10 times as
// large, relative to the dark half, if chains follow the luminance; 1.1 times if they follow what
// relative errors are measured by (0.11 and 0.51 are the denominators of light of 0.1 and 1). The
// limits are far from either.
TEST(PssmltTechniques, TheEqualisedTargetGivesEvenRelativeErrors) {
  const RasterMap map = test::box_map(width, height);
  const auto f = [](PrimarySample& u, Splats& out) {
    const bool dark = u.raster().x < width / 2;
    out.camera(Rgb((dark ? 0.1f : 1.f) * (0.5f + u.numbers(Stream::camera, 1).next())), {});
  };
  const auto ratio = [&](const char* target) {
    ToyRender render("pssmlt",
                     {test::text("target", target), test::integer("bootstrapsamples", 4000),
                      test::integer("chains", 512)},
                     f, map, 3);
    render.rounds(40);
    std::array<MeanTally, 2> halves;
    for (int g = 0; g < group_count; ++g) {
      std::array<double, 2> sums{};
      for (int p = 0; p < pixels; ++p) {
        sums[p % width < width / 2 ? 0 : 1] += render.film().sum(0, p, g);
      }
      for (size_t i = 0; i < 2; ++i) halves[i].add(sums[i]);
    }
    const auto relative = [](const MeanTally& t) { return t.standard_error() / t.mean(); };
    return relative(halves[0]) / relative(halves[1]);
  };
  EXPECT_LT(std::abs(std::log(ratio("equalised"))), std::log(2.0));
  EXPECT_GT(ratio("luminance"), 5.0);
}

}  // namespace
}  // namespace pssmlt
