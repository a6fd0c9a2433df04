// Integrals of densities that are narrow: in a mapping in which they are nearly constant.
#include <cmath>
#include <numbers>

#include "app/stress/catalogue/probes.h"
#include "core/base/random.h"
#include "core/dielectric_bsdf.h"
#include "core/rough_mirror.h"

namespace pssmlt::stress {
namespace {

constexpr int rings = 400, spokes = 128, draws = 200'000;
constexpr double sure = 5.33;  // two-sided normal quantile of 10^-7

// Sum over facet normals m(a, phi), tan(theta) = alpha sqrt(a / (1 - a)), of f(m) times the solid
// angle that stands for the sample [sr].
template <typename F>
double over_normals(double alpha, const F& f) {
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double a = (i + .5) / rings;
    const double tan2 = alpha * alpha * a / (1.0 - a), cos2 = 1.0 / (1.0 + tan2);
    const double cosine = std::sqrt(cos2), sine = std::sqrt(tan2 * cos2);
    // d(cos) = cos^3 / 2 d(tan^2), d(tan^2) / da = alpha^2 / (1 - a)^2.
    const double weight = .5 * cosine * cos2 * alpha * alpha / ((1.0 - a) * (1.0 - a));
    for (int j = 0; j < spokes; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + .5) / spokes;
      const dvec3 m(sine * std::cos(phi), sine * std::sin(phi), cosine);
      sum += f(m) * weight * 2.0 * std::numbers::pi / (static_cast<double>(rings) * spokes);
    }
  }
  return sum;
}

double metal_integral(const RoughMirror& metal, double alpha, const dvec3& wo) {
  return over_normals(alpha, [&](const dvec3& m) {
    const double c = glm::dot(wo, m);
    const dvec3 wi = 2.0 * c * m - wo;
    if (!(c > 0.0) || !(wi.z > 0.0)) return 0.0;
    return static_cast<double>(metal.pdf(vec3(wo), vec3(wi))) * 4.0 * c;
  });
}

double drawn_share(const RoughMirror& metal, const dvec3& wo) {
  RandomStream random(17, RandomUse::test);
  int made = 0;
  for (int i = 0; i < draws; ++i) {
    const float u = random.next();
    const float v = random.next();
    made += metal.draw(vec3(wo), {u, v}) ? 1 : 0;
  }
  return static_cast<double>(made) / draws;
}

}  // namespace

Outcome integrate_density(double alpha) {
  const RoughMirror metal(MetalReflectance{.eta = 1.f, .k = Rgb(1.f)},
                          Ggx(static_cast<float>(alpha), static_cast<float>(alpha)));
  Outcome outcome;
  outcome.verdict = Verdict::pass;
  outcome.deviation = outcome.tolerance = 0.0;
  outcome.meaning = "quadrature to 1 % and the draws' binomial error, false alarm 1e-7 each";
  double worst = -1.0;
  for (const double z : {1.0, .7, .2, .05}) {
    const dvec3 wo(std::sqrt(1.0 - z * z), 0.0, z);
    const double share = drawn_share(metal, wo), integral = metal_integral(metal, alpha, wo);
    const double tolerance = .01 + sure * std::sqrt(std::max(share * (1.0 - share), 0.0) / draws);
    const double apart = std::abs(integral - share);
    if (apart / tolerance > worst) {
      worst = apart / tolerance;
      outcome.deviation = apart;
      outcome.tolerance = tolerance;
    }
  }
  if (worst > 1.0) {
    outcome.verdict = Verdict::fail;
    outcome.reason = "the density's integral is not the share of draws";
  }
  return outcome;
}

}  // namespace pssmlt::stress
