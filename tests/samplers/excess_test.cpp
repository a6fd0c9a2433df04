// The sampler "excess" over integrators in closed form.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/samplers/outliers.h"

namespace pssmlt {
namespace {

using namespace test::toy_outliers;
using test::ToyRender;

constexpr double bias = 3e-4;  // of b, as for "pssmlt"
constexpr double precision = 0.0026;

ParameterSet settings(const ParameterSet& more) {
  ParameterSet set = {test::integer("pilotsamples", 8192),
                      test::integer("bootstrapsamples", 100000)};
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

// Limit and share are chosen; chains on trial would find that these strips are not worth any.
TEST(Excess, IsRightWithLimitAndShareChosen) {
  expect_right("excess", settings({test::number("stickiness", 8.f)}), 60, bias, precision);
}
TEST(Excess, IsRightWithMostAboveTheLimit) {
  expect_right("excess",
               settings({test::number("threshold", 0.2f), test::number("chainshare", 0.8f)}), 160,
               bias, precision);
}
TEST(Excess, IsRightWithKelemenWeights) {
  expect_right("excess",
               settings({test::number("threshold", 3.f), test::number("chainshare", 0.3f),
                         test::text("weights", "kelemen")}),
               60, bias, precision);
}
// Without chains the picture is that of Sobol' points, bit by bit.
TEST(Excess, WithoutASplitItIsSobol) {
  const RasterMap map = test::box_map(width, height);
  ToyRender excess("excess", settings({test::number("threshold", 1e6f)}), outliers, map, 5);
  ToyRender sobol("sobol", {}, outliers, map, 5);
  excess.rounds(5);
  sobol.rounds(5);
  for (int p = 0; p < pixels; ++p) {
    for (int g = 0; g < group_count; ++g) {
      EXPECT_EQ(excess.film().sum(0, p, g), sobol.film().sum(0, p, g));
    }
  }
}

// A pilot that finds enough for a limit, but too few for the number of candidates that are to start
// the chains: what is cut off might be lost, so nothing is.
TEST(Excess, CutsNothingOffThatTooFewFound) {
  const auto rare = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    const float p = u.numbers(Stream::camera, 1).next();
    out.camera(Rgb(p < 1e-3f ? 500.f : .5f), {});
  };
  const RasterMap map = test::box_map(width, height);
  const auto share = [&](int candidates) {
    ToyRender render("excess",
                     {test::number("threshold", 4.f), test::integer("pilotsamples", 50000),
                      test::integer("bootstrapsamples", candidates)},
                     rare, map, 1);
    render.rounds(1);
    nlohmann::json report;
    render.sampler().report(report);
    return report["chain_share"].get<double>();
  };
  EXPECT_EQ(share(1000), 0.0);
  EXPECT_GT(share(50000), 0.0);
}

}  // namespace
}  // namespace pssmlt
