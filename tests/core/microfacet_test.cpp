#include "core/microfacet.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace pssmlt {
namespace {

struct Widths {
  float x, y;
};

// Over the hemisphere of normals, finer toward the pole: m = (theta(t), phi), theta = pi/2 t^2.
template <typename F>
double over_normals(F&& f) {
  constexpr int steps = 800;
  double sum = 0.;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps, theta = 0.5 * std::numbers::pi * t * t;
    const double area = std::sin(theta) * std::numbers::pi * t / steps;
    for (int j = 0; j < steps; ++j) {
      const double phi = 2. * std::numbers::pi * (j + 0.5) / steps;
      const vec3 m(float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)),
                   float(std::cos(theta)));
      sum += f(m) * area * 2. * std::numbers::pi / steps;
    }
  }
  return sum;
}

const Widths all_widths[] = {{0.05f, 0.05f}, {0.3f, 0.3f}, {1.f, 1.f}, {0.1f, 0.5f}};

TEST(Ggx, ProjectedAreaOfNormalsIsOne) {
  for (const Widths& a : all_widths) {
    const Ggx ggx(a.x, a.y);
    EXPECT_NEAR(over_normals([&](const vec3& m) { return double(ggx.d(m)) * m.z; }), 1., 2e-3);
  }
}

// Weak white furnace test (Heitz 2014, section 5.3): visible normals add up to the projected area.
TEST(Ggx, VisibleNormalsAreNormalised) {
  for (const Widths& a : all_widths) {
    const Ggx ggx(a.x, a.y);
    for (const vec3& w : {vec3(0.f, 0.f, 1.f), glm::normalize(vec3(1.f, 0.5f, 0.6f)),
                          glm::normalize(vec3(-1.f, 0.2f, 0.1f))}) {
      const double sum = over_normals(
          [&](const vec3& m) { return glm::dot(w, m) > 0.f ? double(ggx.pdf_visible(w, m)) : 0.; });
      EXPECT_NEAR(sum, 1., 3e-3) << a.x << " " << a.y << " " << w.z;
    }
  }
}

// Means of sampled normals against the density, from above and below.
TEST(Ggx, SampledNormalsFollowTheDensity) {
  constexpr int samples = 100000;
  RandomStream random(7, RandomUse::test);
  for (const Widths& a : all_widths) {
    const Ggx ggx(a.x, a.y);
    for (const vec3& w :
         {glm::normalize(vec3(1.f, 0.5f, 0.6f)), glm::normalize(vec3(0.3f, -0.5f, -0.2f))}) {
      const vec3 up = w.z < 0.f ? -w : w;
      for (int c = 0; c < 3; ++c) {
        const double exact = over_normals([&](const vec3& m) {
          return glm::dot(up, m) > 0.f ? double(ggx.pdf_visible(up, m)) * m[c] : 0.;
        });
        double sum = 0.;
        for (int i = 0; i < samples; ++i) {
          const float x = random.next();
          const float y = random.next();
          sum += double((*ggx.sample_visible(w, {x, y}))[c]);
        }
        // A component's deviation is below 1: five standard errors, 1 in 2e6, and quadrature.
        EXPECT_NEAR(sum / samples, exact, 5. / std::sqrt(samples) + 3e-3);
      }
    }
  }
}

TEST(Ggx, ShadowingIsTheRatioOfItsParts) {
  const Ggx ggx(0.3f, 0.6f);
  const vec3 wo = glm::normalize(vec3(1.f, 0.f, 0.4f)), wi = glm::normalize(vec3(-0.5f, 1.f, 0.3f));
  const auto lambda = [](const vec3& w) {
    return 0.5f * (std::sqrt(1.f + (sqr(0.3f * w.x) + sqr(0.6f * w.y)) / sqr(w.z)) - 1.f);
  };
  const float g2 = 1.f / (1.f + lambda(wo) + lambda(wi)), g1 = 1.f / (1.f + lambda(wo));
  EXPECT_NEAR(ggx.shadowing(wo, wi), g2 / g1, 1e-5f);
  EXPECT_NEAR(ggx.visibility(wo, wi), g2 / (4.f * wo.z * wi.z), 1e-4f);
}

TEST(Refract, FollowsSnellBothWays) {
  const vec3 m = glm::normalize(vec3(0.1f, 0.2f, 1.f)), w = glm::normalize(vec3(0.7f, 0.f, 0.6f));
  const auto in = refract(w, m, 1.5f);
  ASSERT_TRUE(in);
  EXPECT_FLOAT_EQ(in->eta, 1.5f);
  const auto out = refract(in->direction, m, 1.5f);
  ASSERT_TRUE(out);
  EXPECT_NEAR(glm::length(out->direction - w), 0.f, 1e-5f);
  EXPECT_FALSE(refract(glm::normalize(vec3(1.f, 0.f, -0.2f)), vec3(0.f, 0.f, 1.f), 1.5f));
}

}  // namespace
}  // namespace pssmlt
