// Filters against their integrals and particular values.
#include <gtest/gtest.h>

#include "tests/support/make_endpoint.h"

namespace pssmlt {
namespace {

using namespace test;

double integral(const Filter& f) {
  constexpr int n = 800;
  const dvec2 r(f.radius());
  double sum = 0.0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      sum += f.evaluate(vec2(r * (2.0 * dvec2(x + 0.5, y + 0.5) / double(n) - 1.0)));
  return sum * 4.0 * r.x * r.y / n / n;
}

void expect_support(const std::string& name, float radius) {
  const auto f = make_filter("\"" + name + "\"");
  EXPECT_EQ(f->radius(), vec2(radius)) << name;
  EXPECT_EQ(f->evaluate({1.001f * radius, 0.f}), 0.f) << name;
  EXPECT_EQ(f->evaluate({0.f, -1.001f * radius}), 0.f) << name;
  EXPECT_EQ(f->evaluate({0.3f, 0.2f}), f->evaluate({-0.3f, 0.2f})) << name;
  const auto wide = make_filter("\"" + name + "\" \"float xradius\" 3 \"float yradius\" 1.25");
  EXPECT_EQ(wide->radius(), vec2(3.f, 1.25f)) << name;
  EXPECT_NE(error_of([&] { make_filter("\"" + name + "\" \"float xradius\" 0"); }).find("xradius"),
            std::string::npos);
}

TEST(Filter, DefaultsAndSupport) {
  expect_support("box", 0.5f);
  expect_support("triangle", 2.f);
  expect_support("gaussian", 1.5f);
  expect_support("mitchell", 2.f);
  expect_support("sinc", 4.f);
}

TEST(Filter, Integrals) {
  EXPECT_NEAR(integral(*make_filter("\"box\"")), 1.0, 1e-6);
  // The square of the integral of r - |x| over [-r, r].
  EXPECT_NEAR(integral(*make_filter("\"triangle\"")), 16.0, 1e-3);
  const double edge = std::exp(-4.5) / (std::sqrt(2.0 * std::numbers::pi) * 0.5);
  EXPECT_NEAR(integral(*make_filter("\"gaussian\"")),
              std::pow(std::erf(3.0 / std::sqrt(2.0)) - 3.0 * edge, 2.0), 1e-5);
  // The cubic has unit integral over [-2, 2] whatever B and C; the radius of 2 keeps the scale.
  EXPECT_NEAR(integral(*make_filter("\"mitchell\"")), 1.0, 1e-4);
  EXPECT_NEAR(integral(*make_filter("\"mitchell\" \"float B\" 1 \"float C\" 0")), 1.0, 1e-4);
}

TEST(Filter, ParticularValues) {
  // Mitchell and Netravali 1988: at 0 (6 - 2B)/6, at 1 (in units of half the radius) B/6.
  const auto mitchell = make_filter("\"mitchell\"");
  EXPECT_NEAR(mitchell->evaluate({0.f, 0.f}), std::pow(16.0 / 18.0, 2.0), 1e-6);
  EXPECT_NEAR(mitchell->evaluate({1.f, 0.f}), 16.0 / 18.0 / 18.0, 1e-6);
  EXPECT_LT(mitchell->evaluate({1.5f, 0.f}), 0.f);
  const auto sinc = make_filter("\"sinc\"");
  EXPECT_NEAR(sinc->evaluate({0.f, 0.f}), 1.f, 1e-6f);
  EXPECT_NEAR(sinc->evaluate({1.f, 0.f}), 0.f, 1e-6f);
  const double t = 1.5 * std::numbers::pi;
  EXPECT_NEAR(sinc->evaluate({1.5f, 0.f}), std::sin(t) / t * std::sin(t / 3) / (t / 3), 1e-6);
}

}  // namespace
}  // namespace pssmlt
