// Integrals of densities that are narrow: in a mapping in which they are nearly constant.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/stress/catalogue/probes.h"
#include "core/base/random.h"
#include "core/rough_interface.h"
#include "core/rough_mirror.h"

namespace pssmlt::stress {
namespace {

constexpr int rings = 400, spokes = 128, draws = 200'000;
constexpr double eta = 1.5;    // of glass over air
constexpr double sure = 5.33;  // two-sided normal quantile of 10^-7

// Sum over facet normals m(a, phi), tan(theta) = alpha sqrt(a / (1 - a)), of f(m) times the solid
// angle that stands for the sample [sr].
template <typename F>
double over_normals(double alpha, const F& f) {
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    // Seen at a grazing angle, tilted normals count like (1 - a)^(-1/2): a = 1 - s^2.
    const double s = (i + .5) / rings, a = 1.0 - s * s;
    const double tan2 = alpha * alpha * a / (1.0 - a), cos2 = 1.0 / (1.0 + tan2);
    const double cosine = std::sqrt(cos2), sine = std::sqrt(tan2 * cos2);
    // d(cos) = cos^3 / 2 d(tan^2), d(tan^2) / da = alpha^2 / (1 - a)^2.
    const double weight = .5 * cosine * cos2 * alpha * alpha / ((1.0 - a) * (1.0 - a)) * 2.0 * s;
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

// Reflected at the facet, and refracted, with d(omega_i) = (wo.m + eta wi.m)^2 / (eta^2 |wi.m|)
// d(omega_m) (Walter et al. 2007, eq. 17).
double glass_integral(const RoughInterface& glass, double alpha, const dvec3& wo) {
  const auto density = [&](const dvec3& wi) {
    const auto facet = glass.facet(vec3(wo), vec3(wi));
    return facet ? static_cast<double>(glass.density(vec3(wo), *facet)) : 0.0;
  };
  return over_normals(alpha, [&](const dvec3& m) {
    const double c = glm::dot(wo, m), cos_t = std::sqrt(1.0 - (1.0 - c * c) / (eta * eta));
    if (!(c > 0.0)) return 0.0;
    const dvec3 up = 2.0 * c * m - wo, down = -wo / eta + (c / eta - cos_t) * m;
    const double reflected = up.z > 0.0 ? density(up) * 4.0 * c : 0.0;
    const double sum = c - eta * cos_t;
    const double refracted = down.z < 0.0 ? density(down) * sum * sum / (eta * eta * cos_t) : 0.0;
    return reflected + refracted;
  });
}

// Share of draws that succeed; draw() is called with three numbers in [0, 1).
template <typename Draw>
double drawn_share(const Draw& draw) {
  RandomStream random(17, RandomUse::test);
  int made = 0;
  for (int i = 0; i < draws; ++i) {
    const float lobe = random.next();
    const float u = random.next();
    const float v = random.next();
    made += draw(lobe, vec2(u, v)) ? 1 : 0;
  }
  return static_cast<double>(made) / draws;
}

// Keeps the pair that is furthest apart for its tolerance.
void keep_worst(double integral, double share, Outcome& o) {
  const double tolerance = .003 + sure * std::sqrt(std::max(share * (1.0 - share), 0.0) / draws);
  const double apart = std::abs(integral - share);
  if (apart > tolerance) {
    o.verdict = Verdict::fail;
    o.reason =
        fmt::format("the density's integral is {:.4f}, the share of draws {:.4f}", integral, share);
  }
  if (o.tolerance && apart / tolerance < *o.deviation / *o.tolerance) return;
  o.deviation = apart;
  o.tolerance = tolerance;
}

}  // namespace

Outcome integrate_density(double alpha) {
  const auto a = static_cast<float>(alpha);
  const RoughMirror metal(MetalReflectance{.eta = 1.f, .k = Rgb(1.f)}, Ggx(a, a));
  const RoughInterface glass(static_cast<float>(eta), Ggx(a, a));
  Outcome o;
  o.verdict = Verdict::pass;
  o.meaning = "quadrature to 0.3 % and the draws' binomial error, false alarm 1e-7 each";
  for (const double z : {1.0, .7, .2, .05}) {
    const dvec3 wo(std::sqrt(1.0 - z * z), 0.0, z);
    keep_worst(metal_integral(metal, alpha, wo),
               drawn_share([&](float, const vec2& u) { return bool(metal.draw(vec3(wo), u)); }), o);
    keep_worst(glass_integral(glass, alpha, wo), drawn_share([&](float lobe, const vec2& u) {
                 return bool(glass.draw(vec3(wo), lobe, u));
               }),
               o);
  }
  return o;
}

}  // namespace pssmlt::stress
