// The samplers "erpt" and "auto" over integrators in closed form.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/samplers/outliers.h"

namespace pssmlt {
namespace {

using namespace test::toy_outliers;
using test::ToyRender;

constexpr double bias = 0.0, precision = 0.0052;

ParameterSet settings(const ParameterSet& more) {
  ParameterSet set = {test::integer("pilotsamples", 8192)};
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

// Nearly all light is spread, over chains long and short, one or many from a sample.
TEST(Erpt, IsRightWithMostAboveTheLimit) {
  expect_right("erpt",
               settings({test::number("threshold", 0.2f), test::number("mutations", 2.f),
                         test::integer("chainlength", 5)}),
               170, bias, precision);
}
TEST(Erpt, IsRightWithManyChainsOfASample) {
  expect_right("erpt",
               settings({test::number("threshold", 3.f), test::number("mutations", 4.f),
                         test::integer("chainlength", 7)}),
               180, bias, precision);
}
TEST(Erpt, IsRightWithLargeSteps) {
  expect_right(
      "erpt",
      settings({test::number("threshold", 2.f), test::number("mutations", 1.f),
                test::integer("chainlength", 30), test::number("largestepprobability", 0.3f)}),
      180, bias, precision);
}

// Where nothing is above the limit the picture is that of Sobol' points, bit by bit.
TEST(Erpt, WithoutChainsItIsSobol) {
  const RasterMap map = test::box_map(width, height);
  ToyRender erpt("erpt", settings({test::number("mutations", 0.f)}), outliers, map, 5);
  ToyRender sobol("sobol", {}, outliers, map, 5);
  erpt.rounds(5);
  sobol.rounds(5);
  for (int p = 0; p < pixels; ++p) {
    for (int g = 0; g < group_count; ++g) {
      EXPECT_EQ(erpt.film().sum(0, p, g), sobol.film().sum(0, p, g));
    }
  }
}

// The order of units, as other numbers of threads would have it, changes nothing: sums of one unit
// are added in another order, no more.
TEST(Erpt, UnitsAreIndependent) {
  const RasterMap map = test::box_map(40, 36);
  const ParameterSet set =
      settings({test::number("threshold", 2.f), test::number("mutations", 1.f)});
  ToyRender forwards("erpt", set, outliers, map, 5), backwards("erpt", set, outliers, map, 5);
  forwards.rounds(3);
  backwards.rounds(3, true);
  for (size_t i = 0; i < forwards.film().all().size(); ++i) {
    const double a = forwards.film().all()[i], b = backwards.film().all()[i];
    EXPECT_NEAR(a, b, 1e-9 * (a + b));
  }
}

// "auto" is "erpt" where an integrator is given.
TEST(Auto, IsErptUnderOneIntegrator) {
  const RasterMap map = test::box_map(width, height);
  const ParameterSet set =
      settings({test::number("threshold", 2.f), test::number("mutations", 1.f)});
  ToyRender chosen("auto", set, outliers, map, 5), erpt("erpt", set, outliers, map, 5);
  chosen.rounds(4);
  erpt.rounds(4);
  EXPECT_EQ(chosen.film().all(), erpt.film().all());
  EXPECT_TRUE(chosen.sampler().chooses_integrator());
  EXPECT_FALSE(erpt.sampler().chooses_integrator());
}

// Budgets count mutations: as many are made as samples() says, within the spread of their number.
TEST(Erpt, MakesAsManyMutationsAsItSays) {
  const RasterMap map = test::box_map(width, height);
  ToyRender render("erpt",
                   settings({test::number("threshold", 2.f), test::number("mutations", 1.f),
                             test::integer("chainlength", 20)}),
                   outliers, map, 5);
  const uint64_t before = render.worker().evaluator.samples();
  constexpr int rounds = 400;
  render.rounds(rounds);
  const auto made = static_cast<double>(render.worker().evaluator.samples() - before);
  EXPECT_NEAR(made / (rounds * render.sampler().samples(0)), 1.0, 0.15);
}

}  // namespace
}  // namespace pssmlt
