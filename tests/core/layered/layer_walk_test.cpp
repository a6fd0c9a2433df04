// Walks between layers against closed forms. The means of independent estimates are compared at
// z_limit standard errors, a false alarm of 1e-7 each, plus what closed forms do not know: the
// tables' steps and the light of walks longer than the numbers reach.
#include "core/layered/layer_walk.h"

#include <gtest/gtest.h>

#include "core/coat.h"
#include "core/layered/layered_bsdf.h"
#include "tests/support/statistics.h"
#include "tests/support/walk_source.h"

namespace pssmlt {
namespace {

using test::WalkSource;
constexpr int walks = 40000;

struct Mean {
  double value = 0.0, error = 0.0;
};
// Of the first component of estimates.
template <typename Estimate>
Mean mean_of(int n, Estimate&& estimate) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = static_cast<double>(estimate());
    sum += x;
    squares += x * x;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
}

vec3 direction(float mu, float phi) {
  const float s = safe_sqrt(1.f - mu * mu);
  return {s * std::cos(phi), s * std::sin(phi), mu};
}

LayerBase paint(float reflectance) {
  LayerBase base;
  base.lambertian = true;
  base.reflectance = Rgb(reflectance);
  return base;
}
LayerBase metal(float alpha) {
  LayerBase base;
  base.metal = {{nullptr, 0.5f, Rgb(3.f)}, Ggx(alpha, alpha)};
  return base;
}

struct Pair {
  vec3 a, b;
};
const std::vector<Pair> pairs = {{direction(0.9f, 0.f), direction(0.7f, 2.5f)},
                                 {direction(0.3f, 1.f), direction(0.8f, 3.f)},
                                 {direction(0.5f, 0.f), direction(0.5f, 3.1415f)}};

// T T rho / (pi eta^2 (1 - rho R)), with the fractions of core/coat.h.
TEST(LayerWalk, PaintUnderAnAbsorbingCoat) {
  for (const float alpha : {0.f, 0.3f}) {
    const LayerMedium medium{.eta = 1.5f, .thickness = 0.4f, .events = 20};
    const Coat coat(medium.eta, medium.thickness, alpha);
    const LayerBase base = paint(0.8f);
    const Ggx boundary(alpha, alpha);
    const LayerWalk walk(medium, boundary, base);
    WalkSource source(1);
    for (const Pair& p : pairs) {
      const float f = coat.transmitted(p.a.z) * coat.transmitted(p.b.z) * 0.8f * inv_pi /
                      (sqr(medium.eta) * (1.f - 0.8f * coat.sent_back()));
      const Mean m =
          mean_of(walks, [&] { return walk.estimate(p.a, p.b, WalkNumbers(source.next(), 22)).x; });
      EXPECT_NEAR(m.value, f, test::z_limit * m.error + 5e-3 * f) << alpha << " " << p.a.z;
    }
  }
}

TEST(LayerWalk, ACoatOfNothingShowsTheBase) {
  const LayerMedium nothing{.eta = 1.f};
  const LayerBase base = metal(0.2f);
  const Ggx smooth(0.f, 0.f);
  const LayerWalk walk(nothing, smooth, base);
  WalkSource source(2);
  for (const Pair& p : pairs) {
    const Rgb f = base.metal.eval(p.a, p.b);
    const Rgb found = walk.estimate(p.a, p.b, WalkNumbers(source.next(), 22));
    EXPECT_NEAR(found.x, f.x, 1e-4f * f.x);
  }
}

TEST(LayerWalk, IsSymmetricInTheMean) {
  const LayerMedium medium{
      .eta = 1.4f, .thickness = 0.7f, .albedo = Rgb(0.8f), .g = 0.4f, .events = 20};
  const LayerBase base = metal(0.3f);
  const Ggx boundary(0.25f, 0.25f);
  const LayerWalk walk(medium, boundary, base);
  WalkSource source(3);
  for (const Pair& p : pairs) {
    const auto toward = [&](const vec3& a, const vec3& b) {
      return mean_of(5 * walks,
                     [&] { return walk.estimate(a, b, WalkNumbers(source.next(), 22)).x; });
    };
    const Mean forth = toward(p.a, p.b), back = toward(p.b, p.a);
    EXPECT_LT(forth.error, 0.03 * forth.value);
    EXPECT_NEAR(forth.value, back.value, test::z_limit * std::hypot(forth.error, back.error));
  }
}

// All that enters leaves: nothing absorbs. Of walks longer than 20 events less than 0.3 % is left
// (5 % at most is reflected back at the low index, half of the rest scatters again).
TEST(LayerWalk, WhiteLayersLoseNothing) {
  for (const float g : {0.f, 0.6f, -0.3f}) {
    const LayerMedium medium{
        .eta = 1.1f, .thickness = 0.3f, .albedo = Rgb(1.f), .g = g, .events = 20};
    const Ggx smooth(0.f, 0.f);
    WalkSource source(4);
    RandomStream random(4, RandomUse::test);
    for (const float mu : {1.f, 0.6f, 0.3f}) {
      const vec3 a = direction(mu, 0.5f);
      const Mean m = mean_of(6 * walks, [&] {
        const LayeredBsdf bsdf(medium, smooth, paint(1.f), source.next());
        const float lobe = random.next();
        const float x = random.next();
        const float y = random.next();
        const auto s = bsdf.sample(a, lobe, {x, y}, Transport::radiance);
        return s ? s->weight.x : 0.f;
      });
      EXPECT_NEAR(m.value, 1.0, test::z_limit * m.error + 3e-3) << g << " " << mu;
      EXPECT_LT(m.error, 2e-3);
    }
  }
}

// A narrow lobe under a smooth boundary reflects in total what the mirror's series does.
TEST(LayeredBsdf, NarrowLobesTendToTheMirror) {
  const LayerMedium medium{.eta = 1.5f, .thickness = 0.2f, .events = 20};
  const Ggx smooth(0.f, 0.f);
  const MetalReflectance fresnel{nullptr, 0.5f, Rgb(3.f)};
  const LayeredMirrorBsdf mirror(medium, fresnel);
  WalkSource source(5);
  RandomStream random(5, RandomUse::test);
  for (const float mu : {0.95f, 0.5f}) {
    const vec3 wo = direction(mu, 0.5f);
    const Mean m = mean_of(walks, [&] {
      const LayeredBsdf bsdf(medium, smooth, metal(0.01f), source.next());
      const float lobe = random.next();
      const float x = random.next();
      const float y = random.next();
      const auto s = bsdf.sample(wo, lobe, {x, y}, Transport::radiance);
      return s ? s->weight.x : 0.f;
    });
    EXPECT_NEAR(m.value, mirror.albedo(wo).x, test::z_limit * m.error + 5e-3);
  }
}

// Of one hit: the same numbers give the same value, both ways.
TEST(LayeredBsdf, IsAFunctionOfItsNumbers) {
  const LayerMedium medium{.eta = 1.5f, .thickness = 0.5f, .albedo = Rgb(0.7f)};
  const Ggx boundary(0.2f, 0.2f);
  WalkSource source(6);
  const LayeredBsdf bsdf(medium, boundary, metal(0.1f), source.next());
  for (const Pair& p : pairs) {
    const Rgb f = bsdf.eval(p.a, p.b, Transport::radiance);
    EXPECT_EQ(f, bsdf.eval(p.a, p.b, Transport::radiance));
    EXPECT_EQ(f, bsdf.eval(p.b, p.a, Transport::importance));
    const vec3 below(1.f, 1.f, -1.f);  // coated alike
    EXPECT_EQ(f, bsdf.eval(below * p.a, below * p.b, Transport::radiance));
  }
}

}  // namespace
}  // namespace pssmlt
