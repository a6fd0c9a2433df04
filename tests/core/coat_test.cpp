#include "core/coat.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "core/color/fresnel.h"
#include "core/rough_interface.h"

namespace pssmlt {
namespace {

// Of light from `mu`, all that leaves a white base's coat.
float albedo(const Coat& coat, float eta, float mu) {
  return coat.reflected(mu) +
         coat.transmitted(mu) * coat.mean_transmitted() / (eta * eta * (1.f - coat.sent_back()));
}

TEST(Coat, SmoothAndClearLosesNothing) {
  for (const float eta : {1.f, 1.2f, 1.5f, 2.5f}) {
    const Coat coat(eta, 0.f, 0.f);
    // 1 - R = (1 - mean F) / eta^2: equal radiance per eta^2 crosses both ways.
    EXPECT_NEAR(coat.mean_transmitted(), eta * eta * (1.f - coat.sent_back()), 2e-3f) << eta;
    for (const float mu : {0.05f, 0.3f, 0.7f, 1.f}) {
      EXPECT_NEAR(coat.reflected(mu) + coat.transmitted(mu), 1.f, 1e-6f);
      EXPECT_NEAR(albedo(coat, eta, mu), 1.f, 2e-3f) << eta << " " << mu;
    }
  }
}

TEST(Coat, AbsorbsAlongTheRefractedWay) {
  const Coat coat(1.5f, 2.f, 0.f);
  EXPECT_NEAR(coat.transmitted(1.f), 0.96f * std::exp(-2.f), 1e-5f);
  const float mu = 0.6f, inside = std::sqrt(1.f - (1.f - mu * mu) / 2.25f);
  EXPECT_NEAR(coat.transmitted(mu), (1.f - fresnel_dielectric(mu, 1.5f)) * std::exp(-2.f / inside),
              1e-5f);
  EXPECT_LT(coat.sent_back(), 0.05f);
}

TEST(Coat, RoughOnesTendToTheSmoothOne) {
  const Coat smooth(1.5f, 0.1f, 0.f), nearly(1.5f, 0.1f, 0.005f);
  for (const float mu : {0.2f, 0.5f, 0.9f}) {
    EXPECT_NEAR(nearly.reflected(mu), smooth.reflected(mu), 0.01f) << mu;
    EXPECT_NEAR(nearly.transmitted(mu), smooth.transmitted(mu), 0.01f) << mu;
  }
  EXPECT_NEAR(nearly.sent_back(), smooth.sent_back(), 0.01f);
  EXPECT_NEAR(nearly.mean_transmitted(), smooth.mean_transmitted(), 0.01f);
}

// Of light from `mu`, what a random walk between a rough boundary and a white base lets out again.
float walked_albedo(float eta, float alpha, float mu, RandomStream& random) {
  const Ggx ggx(alpha, alpha);
  const RoughInterface boundary(eta, ggx);
  const auto draw2 = [&random] {
    const float x = random.next();
    const float y = random.next();
    return vec2(x, y);
  };
  constexpr int walks = 40'000;
  double out = 0.0;
  for (int i = 0; i < walks; ++i) {
    vec3 wo(std::sqrt(1.f - mu * mu), 0.f, mu);
    double weight = 1.0;
    for (int events = 0; events < 400; ++events) {
      const float lobe = random.next();
      const auto s = boundary.draw(wo, lobe, draw2());
      if (!s) break;
      weight *= static_cast<double>(ggx.shadowing(wo, s->wi));
      if (s->wi.z > 0.f) {
        out += weight;
        break;
      }
      wo = cosine_hemisphere(draw2());  // from the base, upward: seen from the boundary, downward
      wo.z = -wo.z;
    }
  }
  return static_cast<float>(out / walks);
}

// Facets scatter once, and what others shadow is lost; between a white base and a rough boundary
// that adds up. 40000 walks: six sigma are below 0.015; tables and quadrature another 0.01.
TEST(Coat, RoughOnesAreWhatARandomWalkFinds) {
  RandomStream random(51, RandomUse::test);
  for (const float alpha : {0.1f, 0.4f, 1.f}) {
    const Coat coat(1.5f, 0.f, alpha);
    for (const float mu : {0.1f, 0.4f, 1.f}) {
      EXPECT_NEAR(albedo(coat, 1.5f, mu), walked_albedo(1.5f, alpha, mu, random), 0.025f)
          << alpha << " " << mu;
      EXPECT_LT(albedo(coat, 1.5f, mu), 1.005f) << alpha << " " << mu;
    }
  }
}

}  // namespace
}  // namespace pssmlt
