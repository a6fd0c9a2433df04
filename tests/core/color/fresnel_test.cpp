// Fresnel's formulas against complex arithmetic, and the RGB curves against the formulas.
#include "core/color/fresnel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <random>

#include "core/color/fresnel_rgb.h"
#include "core/color/named_spectra.h"
#include "core/color/spectrum.h"

namespace pssmlt {
namespace {

// Mean of |r_s|^2 and |r_p|^2 with the complex index n (of the far side over the near side).
double reference(double c, std::complex<double> n) {
  const std::complex<double> t = std::sqrt(n * n - (1. - c * c));  // n cos theta_t
  const auto rs = (c - t) / (c + t), rp = (n * n * c - t) / (n * n * c + t);
  return 0.5 * (std::norm(rs) + std::norm(rp));
}

TEST(Fresnel, DielectricAgreesWithComplexArithmetic) {
  for (const float eta : {0.5f, 0.9f, 1.0003f, 1.33f, 1.5f, 3.f})
    for (int i = 1; i <= 200; ++i) {
      const float c = float(i) / 200.f;
      // Beside the critical angle reflectance falls as a square root: rounding is magnified.
      const double outside = eta > 1.f ? 2e-5 : 2e-3, inside = eta > 1.f ? 2e-3 : 2e-5;
      EXPECT_NEAR(fresnel_dielectric(c, eta), reference(c, eta), outside) << c << " " << eta;
      EXPECT_NEAR(fresnel_dielectric(-c, eta), reference(c, 1. / double(eta)), inside);
    }
}

TEST(Fresnel, DielectricSpecialAngles) {
  EXPECT_NEAR(fresnel_dielectric(1.f, 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(-1.f, 1.5f), 0.04f, 1e-6f);
  EXPECT_EQ(fresnel_dielectric(0.f, 1.5f), 1.f);
  EXPECT_EQ(fresnel_dielectric(-0.5f, 1.5f), 1.f);  // beyond the critical angle of 41.8 degrees
  // Reflectance is the same along both directions of the same path.
  const float cos_i = 0.6f, cos_t = std::sqrt(1.f - (1.f - 0.36f) / 2.25f);
  EXPECT_NEAR(fresnel_dielectric(cos_i, 1.5f), fresnel_dielectric(-cos_t, 1.5f), 1e-6f);
}

TEST(Fresnel, ConductorAgreesWithComplexArithmetic) {
  for (const double eta : {0.04, 0.2, 1., 1.5, 4.})
    for (const double k : {0., 0.01, 1., 3., 8., 50.})
      for (int i = 0; i <= 200; ++i) {
        const double c = i / 200.;
        if (i == 0 && eta == 1. && k == 0.) continue;  // 0 / 0
        const double expected = reference(c, {eta, k});
        EXPECT_NEAR(fresnel_conductor(c, eta, k), expected, 1e-9) << c << " " << eta << " " << k;
        const float single = fresnel_conductor(float(c), float(eta), float(k));
        EXPECT_NEAR(single, expected, 5e-4) << c << " " << eta << " " << k;
      }
}

TEST(Fresnel, ConductorWithoutContrastReflectsNothing) {
  EXPECT_NEAR(fresnel_conductor(0.5f, 1.f, 0.f), 0.f, 1e-6f);
  EXPECT_TRUE(std::isfinite(fresnel_conductor(0.f, 1.f, 0.f)));
  EXPECT_TRUE(std::isfinite(fresnel_conductor(0.f, 0.f, 0.f)));
}

TEST(Fresnel, ReflectanceParameterIsMetAtNormalIncidence) {
  const Rgb r(0.9f, 0.5f, 0.02f);
  const Rgb f = fresnel_conductor(1.f, Rgb(1.f), conductor_k_from_reflectance(r));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(f[i], r[i], 1e-4);
  EXPECT_TRUE(is_valid(conductor_k_from_reflectance(Rgb(1.f, 0.f, 2.f))));
}

void expect_curve(const FresnelCurve& curve, const std::function<dvec3(double)>& formula,
                  const std::string& name) {
  double worst = 0.;
  for (int i = 0; i <= 1000; ++i) {
    const double c = sqr(i / 1000.);
    const dvec3 difference = glm::abs(dvec3(curve(float(c))) - formula(c));
    worst = std::max({worst, difference.x, difference.y, difference.z});
  }
  EXPECT_LE(worst, 1e-3) << name;
  EXPECT_EQ(curve(0.f), Rgb(1.f)) << name;
  EXPECT_EQ(curve(-0.3f), curve(0.3f)) << name;
}

TEST(FresnelCurve, OfMeasuredMetalsIsWithinAThousandth) {
  for (const std::string metal : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"})
    for (const float outside : {1.f, 1.5f}) {
      const Samples eta = *named_spectrum("metal-" + metal + "-eta");
      const Samples k = *named_spectrum("metal-" + metal + "-k");
      const auto formula = [&](double c) {
        const dvec3 rgb = reflectance_rgb([&](double l) {
          return reference(c, {evaluate(eta, l, Outside::Clamp) / outside,
                               evaluate(k, l, Outside::Clamp) / outside});
        });
        return glm::clamp(rgb, 0., 1.);
      };
      expect_curve(FresnelCurve::from_spectra(eta, k, outside), formula, metal);
    }
}

TEST(FresnelCurve, OfRgbIsWithinAThousandth) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> eta_of(0.05f, 4.f), k_of(0.2f, 20.f), r_of(0.01f, 1.f);
  for (int i = 0; i < 20; ++i) {
    Rgb eta, k, r;
    for (int j = 0; j < 3; ++j) {
      eta[j] = eta_of(random);
      k[j] = k_of(random);
      r[j] = r_of(random);
    }
    const auto by_channel = [](const Rgb& n, const Rgb& kappa) {
      return [=](double c) {
        return dvec3(reference(c, {n.x, kappa.x}), reference(c, {n.y, kappa.y}),
                     reference(c, {n.z, kappa.z}));
      };
    };
    expect_curve(FresnelCurve::from_rgb(eta, k), by_channel(eta, k), "rgb");
    expect_curve(FresnelCurve::from_reflectance(r),
                 by_channel(Rgb(1.f), conductor_k_from_reflectance(r)), "reflectance");
  }
}

TEST(FresnelCurve, MetalsHaveTheirColours) {
  const auto at_normal = [](const std::string& metal) {
    return FresnelCurve::from_spectra(*named_spectrum("metal-" + metal + "-eta"),
                                      *named_spectrum("metal-" + metal + "-k"))(1.f);
  };
  const Rgb gold = at_normal("Au"), silver = at_normal("Ag"), copper = at_normal("Cu");
  EXPECT_NEAR(gold.x, 1.00f, 0.03f);
  EXPECT_NEAR(gold.y, 0.77f, 0.03f);
  EXPECT_NEAR(gold.z, 0.34f, 0.04f);
  EXPECT_GT(std::min({silver.x, silver.y, silver.z}), 0.9f);
  EXPECT_GT(copper.x, copper.y + 0.15f);
  EXPECT_GT(copper.y, copper.z + 0.05f);
  EXPECT_NEAR(luminance(at_normal("Al")), 0.91f, 0.015f);
}

}  // namespace
}  // namespace pssmlt
