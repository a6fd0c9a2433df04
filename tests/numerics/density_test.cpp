// Densities of narrow lobes, roughness 1 to 1e-4 and cosines 1 to 1e-7: the arithmetic against the
// same formula in 80 bits, and the density that sampling states against the one that evaluation
// finds for the direction as rounded.
#include "core/rough_interface.h"
#include "core/rough_mirror.h"
#include "tests/numerics/measured.h"

namespace pssmlt {
namespace {

using namespace test;

struct Widths {
  float x, y;
};

Widths random_widths(RandomStream& random) {
  Widths a{static_cast<float>(spread(random, 1e-4, 1.0)),
           static_cast<float>(spread(random, 1e-4, 1.0))};
  if (random.next() < 0.5f) a.y = a.x = std::max(a.x, Ggx::smooth_below);
  // A lobe that is smooth along both axes is a mirror, without a density.
  if (std::max(a.x, a.y) < Ggx::smooth_below) a.x = Ggx::smooth_below;
  return a;
}

vec3 direction(RandomStream& random, double least_cosine) {
  const auto z = static_cast<float>(spread(random, least_cosine, 1.0));
  const float phi = 2.f * pi * random.next();
  const float sine = std::sqrt(1.f - z * z);
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

// The formulas of core/microfacet.h in 80 bits, of the same float inputs.
struct LongGgx {
  LongGgx(const Widths& a) : ax(std::max(a.x, 1e-4f)), ay(std::max(a.y, 1e-4f)) {}
  long double stretched(const LongVec& w) const {
    return std::sqrt(ax * w.x * ax * w.x + ay * w.y * ay * w.y + w.z * w.z);
  }
  long double d(const LongVec& m) const {
    const long double s = m.x / ax * m.x / ax + m.y / ay * m.y / ay + m.z * m.z;
    return std::numbers::inv_pi_v<long double> / (ax * ay * s * s);
  }
  long double visibility(const LongVec& a, const LongVec& b) const {
    return 0.5L / (b.z * stretched(a) + a.z * stretched(b));
  }
  // Of reflecting toward `wi`.
  long double pdf(const LongVec& wo, const LongVec& wi) const {
    return d(unit(wo + wi)) / (2.0L * (wo.z + stretched(wo)));
  }
  long double ax, ay;
};

TEST(DensityNumerics, EvaluationIsAsExactAsItsOperations) {
  RandomStream random(1, RandomUse::test);
  Worst d("GGX D(m)", "15 u"), visibility("GGX visibility", "7 u");
  Worst pdf("density of a GGX reflection at given directions", "51 u");
  for (int i = 0; i < 400'000; ++i) {
    const Widths a = random_widths(random);
    const Ggx ggx(a.x, a.y);
    const LongGgx exact(a);
    const vec3 m = direction(random, 1e-7), wo = direction(random, 1e-7);
    // Where the lobe is, else densities are no more than zeros of different sizes.
    const float x = random.next();
    const float y = random.next();
    const vec3 wi = glm::normalize(reflect(wo, ggx.sample_visible(wo, {x, y}).value_or(m)));
    d.add(relative(ggx.d(m), exact.d(LongVec(m))), 15.0L * float_unit);
    if (!(wi.z > 0.f)) continue;
    const LongVec o(wo), n(wi);
    visibility.add(relative(ggx.visibility(wo, wi), exact.visibility(o, n)), 7.0L * float_unit);
    pdf.add(relative(RoughMirror({}, ggx).pdf(wo, wi), exact.pdf(o, n)), 51.0L * float_unit);
  }
  d.check();
  visibility.check();
  pdf.check();
}

// A drawn direction is off by up to 8 u, the half vector found again by that over 2 c, c = wo.m,
// and D by twice that over the width: 8 u / (c alpha).
TEST(DensityNumerics, DrawnAndEvaluatedDensityOfReflection) {
  RandomStream random(2, RandomUse::test);
  Worst worst("density of a drawn GGX reflection against its evaluation, times c alpha",
              "8 u + 102 u c alpha");
  for (int i = 0; i < 400'000; ++i) {
    const Widths a = random_widths(random);
    const RoughMirror mirror({}, Ggx(a.x, a.y));
    const vec3 wo = direction(random, 1e-7);
    const float x = random.next();
    const float y = random.next();
    const auto draw = mirror.draw(wo, {x, y});
    if (!draw) continue;
    const auto c = static_cast<long double>(glm::dot(wo, glm::normalize(wo + draw->wi)));
    const long double alpha = std::max(std::min(a.x, a.y), 1e-4f);
    if (c * alpha < 1e-4L) continue;  // where the bound is no longer linear, see the note
    const long double error = relative(mirror.pdf(wo, draw->wi), draw->pdf);
    worst.add(error * c * alpha, 8.0L * float_unit + 102.0L * float_unit * c * alpha);
  }
  worst.check();
}

// The same through a rough boundary: the half vector is a difference of directions |eta - 1| apart,
// the refracted one is known to (8 + 5 / c) u, D squares that error, and so does the Jacobian.
// Below a product of 2^-16 boundaries are smooth (refracts_sharply).
TEST(DensityNumerics, DrawnAndEvaluatedDensityOfRefraction) {
  RandomStream random(3, RandomUse::test);
  Worst worst("density of a drawn refraction against its evaluation, times |eta - 1| c alpha",
              "42 u + 102 u |eta - 1| c alpha");
  int64_t lost = 0, draws = 0;
  for (int i = 0; i < 400'000; ++i) {
    const float distance = static_cast<float>(spread(random, 1e-6, 0.5));
    const float width = static_cast<float>(spread(random, 1e-3, 1.0));
    const float eta = random.next() < 0.5f ? 1.f + distance : 1.f / (1.f + distance);
    const Ggx ggx(width, width);
    if (refracts_sharply(eta, ggx)) continue;
    const RoughInterface boundary(eta, ggx);
    const vec3 wo = direction(random, 0.1);
    const float x = random.next();
    const float y = random.next();
    const auto draw = boundary.draw(wo, one_minus_epsilon, {x, y});
    if (!draw || draw->facet.reflects) continue;
    const auto c = static_cast<long double>(
        std::min(std::abs(draw->facet.cos_o), std::abs(draw->facet.cos_i)));
    if (c < 1e-2L) continue;
    ++draws;
    const auto facet = boundary.facet(wo, draw->wi);
    if (!facet) {
      ++lost;
      continue;
    }
    const long double error =
        relative(boundary.density(wo, *facet), boundary.density(wo, draw->facet));
    const long double scale = static_cast<long double>(std::abs(eta - 1.f) * width) * c;
    worst.add(error * scale, 42.0L * float_unit + 102.0L * float_unit * scale);
  }
  worst.check();
  // Directions whose facet shows them its edge may be told to be on the wrong side when found
  // again.
  std::printf("numerics: refractions whose evaluation finds no facet: %lld of %lld\n",
              static_cast<long long>(lost), static_cast<long long>(draws));
  EXPECT_LE(lost, draws / 10'000);
}

}  // namespace
}  // namespace pssmlt
