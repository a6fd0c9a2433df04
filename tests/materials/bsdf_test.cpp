// Every Bsdf: what sample() says agrees with eval() and pdf(), directions follow pdf(), and the
// laws of reciprocity and energy hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "tests/support/make_plugin.h"

namespace pssmlt {
namespace {

using namespace test;

struct Case {
  const char* name;
  const char* type;
  ParameterSet set;
  bool transmits = false;
};

std::vector<Case> rough_cases() {
  const auto alpha = [](float x, float y) {
    return ParameterSet{number("uroughness", x), number("vroughness", y),
                        flag("remaproughness", false)};
  };
  const auto glass = [&](float x, float y, float eta) {
    ParameterSet set = alpha(x, y);
    set.push_back(number("eta", eta));
    return set;
  };
  return {{"Diffuse", "diffuse", {rgb("reflectance", 0.2f, 0.5f, 0.9f)}},
          {"ConductorRough", "conductor", alpha(0.5f, 0.5f)},
          {"ConductorNarrow", "conductor", alpha(0.1f, 0.1f)},
          {"ConductorAnisotropic", "conductor", alpha(0.4f, 0.1f)},
          {"GlassRough", "dielectric", glass(0.5f, 0.5f, 1.5f), true},
          {"GlassNarrow", "dielectric", glass(0.15f, 0.15f, 1.5f), true},
          {"GlassAnisotropic", "dielectric", glass(0.1f, 0.4f, 1.33f), true},
          {"GlassThinner", "dielectric", glass(0.3f, 0.3f, 0.7f), true}};
}

vec3 direction(float degrees, float azimuth) {
  const float theta = degrees * pi / 180.f;
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

// Above, below, steep, grazing.
std::vector<vec3> views() {
  return {direction(0.5f, 0.f), direction(30.f, 1.f),  direction(60.f, 2.f),
          direction(80.f, 4.f), direction(120.f, 1.f), direction(150.f, 5.f)};
}

class BsdfTest : public testing::TestWithParam<Case> {
 protected:
  BsdfTest() : material_(make_material(GetParam().type, GetParam().set)) {
    bsdf_ = material_->bsdf(Hit(), {0.3f, 0.6f}, storage_);
  }
  std::shared_ptr<const Material> material_;
  BsdfStorage storage_;
  const Bsdf* bsdf_ = nullptr;
  RandomStream random_{1234, RandomUse::test};

  std::optional<BsdfSample> draw(const vec3& wo, Transport mode) {
    const float lobe = random_.next();
    const float x = random_.next();
    const float y = random_.next();
    return bsdf_->sample(wo, lobe, {x, y}, mode);
  }
};

TEST_P(BsdfTest, SampleAgreesWithEvalAndPdf) {
  ASSERT_TRUE(bsdf_->connectible());
  for (const Transport mode : {Transport::radiance, Transport::importance}) {
    for (const vec3& wo : views()) {
      int compared = 0;
      for (int i = 0; i < 2000; ++i) {
        const auto s = draw(wo, mode);
        if (!s) continue;
        ASSERT_FALSE(s->delta);
        ASSERT_NEAR(glm::length(s->wi), 1.f, 1e-5f);
        ASSERT_EQ(s->transmitted, wo.z * s->wi.z < 0.f);
        // At grazing angles the half vector of two float directions loses digits.
        if (std::abs(s->wi.z) < 0.02f) continue;
        ++compared;
        const float pdf = bsdf_->pdf(wo, s->wi);
        ASSERT_NEAR(s->pdf, pdf, 5e-3f * pdf) << i;
        const float reverse = bsdf_->pdf(s->wi, wo);
        ASSERT_NEAR(s->pdf_reverse, reverse, 5e-3f * reverse) << i;
        const Rgb expected = bsdf_->eval(wo, s->wi, mode) * (std::abs(s->wi.z) / pdf);
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(s->weight[c], expected[c], 5e-3f * expected[c] + 1e-6f) << i;
      }
      EXPECT_GT(compared, 500);
    }
  }
}

TEST_P(BsdfTest, BothWaysAreTheirParts) {
  for (const Transport mode : {Transport::radiance, Transport::importance}) {
    for (const vec3& wo : views()) {
      for (const vec3& wi : views()) {
        const Bsdf::BothWays v = bsdf_->both_ways(wo, wi, mode);
        EXPECT_EQ(v.f, bsdf_->eval(wo, wi, mode));
        if (is_black(v.f)) continue;
        EXPECT_EQ(v.pdf, bsdf_->pdf(wo, wi));
        EXPECT_EQ(v.pdf_reverse, bsdf_->pdf(wi, wo));
      }
    }
  }
}

// The integral of g over directions with theta and phi in the ranges, by Gauss's rule of two
// points along theta (the integrand has a slope at the poles) and the midpoint rule along phi.
double integrate(const std::function<double(const vec3&)>& g, double t0, double t1, double p0,
                 double p1, int steps) {
  double sum = 0.;
  for (int i = 0; i < steps; ++i) {
    const double node =
        i / 2 * 2 + (i % 2 == 0 ? 1. - std::sqrt(1. / 3.) : 1. + std::sqrt(1. / 3.));
    const double t = t0 + (t1 - t0) * node / steps;
    for (int j = 0; j < steps; ++j) {
      const double p = p0 + (p1 - p0) * (j + 0.5) / steps;
      sum += std::sin(t) *
             g(vec3(dvec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t))));
    }
  }
  return sum * (t1 - t0) * (p1 - p0) / (double(steps) * steps);
}

// Pearson's statistic as a normal deviate (Wilson and Hilferty 1931).
double chi_square_deviate(double statistic, double degrees) {
  const double v = 2. / (9. * degrees);
  return (std::cbrt(statistic / degrees) - (1. - v)) / std::sqrt(v);
}

// Directions against pdf(), failed samples included as a bin of their own.
TEST_P(BsdfTest, DirectionsFollowPdf) {
  constexpr int rows = 20, columns = 20, samples = 40000, steps = 24;
  constexpr double row_height = std::numbers::pi / rows,
                   column_width = 2. * std::numbers::pi / columns;
  for (const vec3& wo : views()) {
    std::vector<double> observed(rows * columns + 1), expected(rows * columns + 1);
    for (int i = 0; i < samples; ++i) {
      const auto s = draw(wo, Transport::radiance);
      if (!s) {
        observed.back() += 1.;
        continue;
      }
      float phi = std::atan2(s->wi.y, s->wi.x);
      if (phi < 0.f) phi += 2.f * pi;
      const float theta = std::acos(std::clamp(s->wi.z, -1.f, 1.f));
      const int row = std::min(int(theta / pi * rows), rows - 1);
      const int column = std::min(int(phi / (2.f * pi) * columns), columns - 1);
      observed[static_cast<size_t>(row * columns + column)] += 1.;
    }
    double total = 0.;
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const double e =
            integrate([&](const vec3& wi) { return double(bsdf_->pdf(wo, wi)); }, r * row_height,
                      (r + 1) * row_height, c * column_width, (c + 1) * column_width, steps);
        expected[static_cast<size_t>(r * columns + c)] = e * samples;
        total += e;
      }
    }
    ASSERT_LT(total, 1.005);
    expected.back() = std::max(0., 1. - total) * samples;
    double statistic = 0., degrees = -1., rest_observed = 0., rest_expected = 0.;
    const auto add = [&](double o, double e) {
      statistic += (o - e) * (o - e) / e;
      degrees += 1.;
    };
    for (size_t i = 0; i < observed.size(); ++i) {
      if (expected[i] >= 10.) {
        add(observed[i], expected[i]);
      } else {
        rest_observed += observed[i];
        rest_expected += expected[i];
      }
    }
    if (rest_expected > 1.) add(rest_observed, rest_expected);
    // One in 3e6 by chance, 48 uses.
    EXPECT_LT(chi_square_deviate(statistic, degrees), 5.)
        << GetParam().name << " wo.z " << wo.z << " total " << total;
  }
}

// Radiance one way is importance the other way, and eta^2 is all that makes the two differ.
TEST_P(BsdfTest, IsReciprocal) {
  for (int i = 0; i < 20000; ++i) {
    const float a = random_.next();
    const float b = random_.next();
    const float c = random_.next();
    const float d = random_.next();
    const vec3 wo = uniform_sphere({a, b}), wi = uniform_sphere({c, d});
    const Rgb forward = bsdf_->eval(wo, wi, Transport::radiance);
    const Rgb adjoint = bsdf_->eval(wi, wo, Transport::importance);
    for (int k = 0; k < 3; ++k)
      ASSERT_NEAR(forward[k], adjoint[k], 2e-3f * forward[k] + 1e-6f) << i;
    ASSERT_TRUE(GetParam().transmits || wo.z * wi.z > 0.f || is_black(forward));
    if (wo.z * wi.z > 0.f) {
      const Rgb back = bsdf_->eval(wi, wo, Transport::radiance);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(forward[k], back[k], 2e-3f * forward[k] + 1e-6f);
    }
  }
}

// The integral of f cos is at most 1 and is the mean of the samples' weights.
TEST_P(BsdfTest, AlbedoAgreesAndIsBelowOne) {
  constexpr int samples = 20000;
  for (const vec3& wo : views()) {
    const auto value = [&](const vec3& wi) {
      return double(bsdf_->eval(wo, wi, Transport::importance).y) * std::abs(wi.z);
    };
    constexpr double turn = 2. * std::numbers::pi, right = 0.5 * std::numbers::pi;
    const double exact = integrate(value, 0., right, 0., turn, 500) +
                         integrate(value, right, 2. * right, 0., turn, 500);
    EXPECT_LT(exact, 1.001);
    double sum = 0., squares = 0.;
    for (int i = 0; i < samples; ++i) {
      const auto s = draw(wo, Transport::importance);
      const double w = s ? double(s->weight.y) : 0.;
      ASSERT_LE(w, 1.00001);
      sum += w;
      squares += w * w;
    }
    const double mean = sum / samples;
    const double error = std::sqrt(std::max(0., squares / samples - mean * mean) / samples);
    // Five standard errors (1 in 2e6) and the quadrature's own error.
    EXPECT_NEAR(mean, exact, 5. * error + 3e-3) << "wo.z " << wo.z;
  }
}

// Corners of the numbers, grazing directions and lobes as narrow as they get: nothing that is not a
// number, no weight above 1.
TEST(Bsdf, StaysFiniteAtTheEdges) {
  const float numbers[] = {0.f, 0x1p-24f, 0.25f, 0.5f, one_minus_epsilon};
  for (const char* type : {"diffuse", "conductor", "dielectric", "thindielectric"}) {
    for (const float width : {0.f, 1.1e-3f, 1.f}) {
      ParameterSet set;
      if (type != std::string("diffuse") && type != std::string("thindielectric"))
        set = {number("uroughness", width), number("vroughness", 0.f),
               flag("remaproughness", false)};
      const auto material = make_material(type, set);
      BsdfStorage storage;
      const Bsdf* const bsdf = material->bsdf(Hit(), {}, storage);
      for (const float z : {1.f, 0.5f, 1e-3f, 1e-7f, 0.f, -1e-7f, -0.5f, -1.f}) {
        const vec3 wo(safe_sqrt(1.f - z * z), 0.f, z);
        for (const float lobe : numbers)
          for (const float x : numbers)
            for (const float y : numbers) {
              const auto s = bsdf->sample(wo, lobe, {x, y}, Transport::importance);
              if (!s) continue;
              ASSERT_TRUE(is_valid(s->weight)) << type << width << " " << z;
              ASSERT_LE(max_component(s->weight), 1.0001f);
              ASSERT_TRUE(std::isfinite(s->pdf) && s->pdf > 0.f);
              ASSERT_TRUE(std::isfinite(s->pdf_reverse) && s->pdf_reverse >= 0.f);
              ASSERT_NEAR(glm::length(s->wi), 1.f, 1e-5f);
              ASSERT_TRUE(is_valid(bsdf->eval(wo, s->wi, Transport::radiance)));
              ASSERT_TRUE(std::isfinite(bsdf->pdf(wo, s->wi)));
            }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, BsdfTest, testing::ValuesIn(rough_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pssmlt
