// Hair: the white furnace in closed form, sampling against density, one lobe after the other
// against what a smooth circle does, and the parameters in pbrt-v4's order.
#include <gtest/gtest.h>

#include "app/defaults.h"
#include "core/base/random.h"
#include "core/fibre.h"
#include "core/hair_bsdf.h"
#include "core/scene/builder.h"
#include "core/scene/parser.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_plugin.h"

namespace pssmlt {
namespace {

using namespace test;

vec3 draw_direction(RandomStream& random) {
  const double x = random.next_double();
  const double y = random.next_double();
  return direction_of({x, y});
}
std::optional<BsdfSample> draw(const Bsdf& bsdf, RandomStream& random, const vec3& wo,
                               Transport mode = Transport::radiance) {
  const float lobe = random.next();
  const float x = random.next();
  const float y = random.next();
  return bsdf.sample(wo, lobe, {x, y}, mode);
}

// In front and behind, across and nearly along the fibre.
std::vector<vec3> views() {
  return {{0.f, 0.f, 1.f}, {.6f, 0.f, .8f}, {-.3f, -.8f, .5196152f}, {.9f, .3f, -.3162278f}};
}

struct Roughness {
  float m, n;
};
const Roughness roughnesses[] = {{.1f, .2f}, {.3f, .3f}, {.6f, .9f}, {1.f, 1.f}};

// The integral over all directions of g [1/sr]; its poles, where cells are wide, lie along the
// fibre.
template <typename G>
double sphere_integral(G&& g, int steps) {
  double sum = 0.;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < 2 * steps; ++i) {
      const vec3 d = direction_of({(i + .5) / (2 * steps), (j + .5) / steps});
      sum += g(vec3(d.z, d.x, d.y));
    }
  return sum * 4. * std::numbers::pi / (2. * steps * steps);
}

// Without absorption everything that enters leaves: the integral of f cos is 1, whatever the
// roughness, offset and tilt.
TEST(Hair, WhiteFurnaceIsOne) {
  for (const Roughness& r : roughnesses) {
    for (const float h : {-.97f, -.5f, 0.f, .8f}) {
      const HairBsdf hair({.h = h, .beta_m = r.m, .beta_n = r.n});
      for (const vec3& wo : views()) {
        const double albedo = sphere_integral(
            [&](const vec3& wi) {
              return double(hair.eval(wo, wi, Transport::radiance).y) * double(std::abs(wi.z));
            },
            200);
        EXPECT_NEAR(albedo, 1., 3e-3) << r.m << " " << r.n << " " << h << " " << wo.x;
        EXPECT_NEAR(hair.albedo(wo).y, 1.f, 1e-5f);
      }
    }
  }
}

// With absorption the integral is the sum of the lobes' attenuations.
TEST(Hair, AlbedoIsTheIntegral) {
  const HairBsdf hair({.h = .4f, .sigma_a = Rgb(.2f, .6f, 2.f), .beta_m = .4f, .beta_n = .5f});
  for (const vec3& wo : views()) {
    for (int c = 0; c < 3; ++c) {
      const double integral = sphere_integral(
          [&](const vec3& wi) {
            return double(hair.eval(wo, wi, Transport::radiance)[c]) * double(std::abs(wi.z));
          },
          200);
      EXPECT_NEAR(integral, hair.albedo(wo)[c], 2e-3) << wo.x << " " << c;
    }
  }
}

// The smallest p of 16 tests fails by chance with probability 1.6e-6 at most.
TEST(Hair, DirectionsFollowTheirDensity) {
  uint64_t seed = 1;
  for (const Roughness& r : roughnesses) {
    const HairBsdf hair({.h = .3f, .sigma_a = Rgb(.1f, .2f, .5f), .beta_m = r.m, .beta_n = r.n});
    for (const vec3& wo : views()) {
      const auto result = chi_square_sphere(
          [&](RandomStream& random) -> std::optional<vec3> {
            const auto s = draw(hair, random, wo);
            return s ? std::optional(s->wi) : std::nullopt;
          },
          [&](const vec3& wi) { return double(hair.pdf(wo, wi)); },
          {.bins_x = 32, .bins_y = 32, .samples = 60'000, .fine = 24, .seed = seed++});
      EXPECT_GT(result.p, false_alarm) << r.m << " " << r.n << " " << wo.x;
      EXPECT_NEAR(result.integral, 1., 4e-3) << r.m << " " << r.n << " " << wo.x;
    }
  }
}

TEST(Hair, SamplesSayWhatEvalSays) {
  RandomStream random(3, RandomUse::test);
  const HairBsdf hair({.h = -.6f, .sigma_a = Rgb(.1f, .2f, .5f)});
  for (const Transport mode : {Transport::radiance, Transport::importance}) {
    for (int i = 0; i < 3000; ++i) {
      const vec3 wo = draw_direction(random);
      const auto s = draw(hair, random, wo, mode);
      if (!s) continue;
      EXPECT_NEAR(s->pdf, hair.pdf(wo, s->wi), 1e-3f * s->pdf);
      EXPECT_NEAR(s->pdf_reverse, hair.pdf(s->wi, wo), 1e-3f * s->pdf_reverse);
      EXPECT_EQ(s->transmitted, wo.z * s->wi.z < 0.f);
      const Rgb expected = hair.eval(wo, s->wi, mode) * (std::abs(s->wi.z) / s->pdf);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(s->weight[c], expected[c], 2e-3f * expected[c]);
    }
  }
}

// With radiance sampled by luminance and no colour the weight is the albedo: nothing is left to
// chance but the direction.
TEST(Hair, GreySamplesWeighTheAlbedo) {
  RandomStream random(4, RandomUse::test);
  const HairBsdf hair({.h = .2f, .sigma_a = Rgb(.7f)});
  for (int i = 0; i < 1000; ++i) {
    const vec3 wo = draw_direction(random);
    const auto s = draw(hair, random, wo);
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->weight.y, hair.albedo(wo).y, 1e-4f);
  }
}

// A thin, clear fibre reflects about the normal of its circle, and refracts through it: lobes
// point where the ray optics of a circle say.
TEST(Hair, LobesPointWhereRaysGo) {
  const float h = .5f, eta = 1.55f;
  for (const float side : {1.f, -1.f}) {
    const HairBsdf hair({.h = h, .eta = eta, .beta_m = .02f, .beta_n = .02f, .alpha = 0.f});
    const vec3 wo(0.f, 0.f, side);
    // On the circle at y = h, seen from +-z.
    const vec3 normal(0.f, h, side * std::sqrt(1.f - h * h));
    const vec3 mirrored = 2.f * glm::dot(wo, normal) * normal - wo;
    const vec3 inside =
        -wo / eta + (std::sqrt(1.f - h * h) / eta - std::sqrt(1.f - h * h / (eta * eta))) * normal;
    // Leaves at the far end of the chord, refracted about the normal there.
    const vec3 exit = normal - 2.f * glm::dot(normal, inside) * inside;
    const float c = glm::dot(inside, exit);
    const vec3 through =
        eta * inside + (std::sqrt(1.f - eta * eta * (1.f - c * c)) - eta * c) * exit;
    for (const vec3& peak : {mirrored, glm::normalize(through)}) {
      const auto at = [&](float turn) {
        const float a = std::atan2(peak.z, peak.y) + turn;
        return hair.pdf(wo, {0.f, std::cos(a), std::sin(a)});
      };
      EXPECT_GT(at(0.f), 1.f);
      EXPECT_GT(at(0.f), 3.f * at(.1f));
      EXPECT_GT(at(0.f), 3.f * at(-.1f));
    }
  }
}

// Scales tilt the highlight of R toward the root by twice their angle.
TEST(Hair, ScalesTiltTheHighlight) {
  const float alpha = 3.f * pi / 180.f;
  const HairBsdf hair({.h = 0.f, .sigma_a = Rgb(1e3f), .beta_m = .05f, .alpha = alpha});
  const vec3 wo(std::sin(.4f), 0.f, std::cos(.4f));
  float best = 0.f, at = 0.f;
  for (float theta = -1.f; theta < 1.f; theta += 1e-3f) {
    const float value = hair.pdf(wo, {std::sin(theta), 0.f, std::cos(theta)});
    if (value > best) best = value, at = theta;
  }
  EXPECT_NEAR(at, -.4f + 2.f * alpha, 5e-3f);
}

// Light the other way round: exactly the adjoint.
TEST(Hair, ImportanceIsTheAdjoint) {
  RandomStream random(5, RandomUse::test);
  const HairBsdf hair({.h = .7f, .sigma_a = Rgb(.1f, .2f, .5f)});
  for (int i = 0; i < 1000; ++i) {
    const vec3 a = draw_direction(random);
    const vec3 b = draw_direction(random);
    EXPECT_EQ(hair.eval(a, b, Transport::radiance), hair.eval(b, a, Transport::importance));
  }
}

TEST(Hair, StaysFiniteAtTheEdges) {
  const float numbers[] = {0.f, 0x1p-24f, .5f, one_minus_epsilon};
  for (const float h : {-1.f, 0.f, 1.f})
    for (const float beta : {.01f, 1.f})
      for (const float absorption : {0.f, 1e-3f, 1e6f})
        for (const vec3& wo : {vec3(1.f, 0.f, 0.f), vec3(0.f, 1.f, 0.f), vec3(0.f, 0.f, -1.f),
                               vec3(1.f, 0.f, 1e-7f), vec3(-.6f, .8f, 1e-7f)}) {
          const HairBsdf hair({.h = h, .sigma_a = Rgb(absorption), .beta_m = beta, .beta_n = beta});
          for (const float l : numbers)
            for (const float x : numbers)
              for (const float y : numbers) {
                const auto s = hair.sample(wo, l, {x, y}, Transport::radiance);
                if (!s) continue;
                ASSERT_TRUE(is_valid(s->weight)) << h << " " << beta << " " << wo.x;
                ASSERT_LE(max_component(s->weight), 1.01f);
                ASSERT_TRUE(std::isfinite(s->pdf) && s->pdf > 0.f);
                ASSERT_TRUE(std::isfinite(s->pdf_reverse) && s->pdf_reverse >= 0.f);
                ASSERT_NEAR(glm::length(s->wi), 1.f, 1e-5f);
              }
        }
}

// At uv (0, v): what a material's Bsdf reflects in all.
Rgb albedo_of(const ParameterSet& set, Resolver* resolver = nullptr, float v = .7f) {
  const auto material = make_material("hair", set, resolver);
  Hit hit;
  hit.uv = {0.f, v};
  BsdfStorage storage;
  return material->bsdf(hit, {}, storage)->albedo(vec3(.2f, .3f, .9327379f));
}
Rgb albedo_with(const Rgb& sigma_a) {
  return HairBsdf({.h = .4f, .sigma_a = sigma_a}).albedo(vec3(.2f, .3f, .9327379f));
}
void expect_same(const Rgb& a, const Rgb& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-5f);
}

// The first of sigma_a, reflectance, color, pigments counts; brown is the default.
TEST(Hair, ColoursInPbrtsOrder) {
  const Parameter sigma = rgb("sigma_a", .1f, .2f, .3f), red = rgb("reflectance", .8f, .3f, .2f),
                  green = rgb("color", .2f, .7f, .3f), brown = number("eumelanin", .5f),
                  ginger = number("pheomelanin", .9f);
  expect_same(albedo_of({}), albedo_with(1.3f * Rgb(.419f, .697f, 1.37f)));
  expect_same(albedo_of({brown}), albedo_with(.5f * Rgb(.419f, .697f, 1.37f)));
  expect_same(albedo_of({ginger}), albedo_with(.9f * Rgb(.187f, .4f, 1.05f)));
  expect_same(albedo_of({brown, ginger}),
              albedo_with(.5f * Rgb(.419f, .697f, 1.37f) + .9f * Rgb(.187f, .4f, 1.05f)));
  expect_same(albedo_of({green}), albedo_with(hair_absorption(Rgb(.2f, .7f, .3f), .3f)));
  expect_same(albedo_of({green, red, ginger}),
              albedo_with(hair_absorption(Rgb(.8f, .3f, .2f), .3f)));
  expect_same(albedo_of({brown, green, red, sigma}), albedo_with(Rgb(.1f, .2f, .3f)));
}

// Chiang et al. 2016, eq. 9, by hand at beta_n = 0: (ln c / 5.969)^2.
TEST(Hair, AbsorptionFromAReflectance) {
  expect_same(hair_absorption(Rgb(.5f, .1f, 1.f), 0.f), Rgb(.0134849f, .1488081f, 0.f));
  EXPECT_TRUE(is_finite(hair_absorption(Rgb(0.f), 1.f)));
}

TEST(Hair, TexturesDecideAtEachPoint) {
  class ByV final : public Texture<float> {
    float evaluate(const Hit& hit) const override {
      return hit.uv.y > 1.f ? std::numeric_limits<float>::quiet_NaN() : hit.uv.y;
    }
  };
  for (const char* name : {"eumelanin", "eta", "beta_m", "beta_n", "alpha"}) {
    Resolver resolver;
    resolver.floats["by v"] = std::make_shared<ByV>();
    const auto value = [&](const ParameterSet& set, float v = .9f) {
      const auto material = make_material("hair", set, &resolver);
      Hit hit;
      hit.uv = {0.f, v};
      BsdfStorage storage;
      return material->bsdf(hit, {}, storage)
          ->eval(vec3(.2f, .3f, .9327379f), vec3(-.1f, .2f, .9746794f), Transport::radiance);
    };
    const float constant = std::string(name) == "eta" ? 1.f : .9f;  // not below 1
    expect_same(value({texture(name, "by v")}), value({number(name, constant)}));
    EXPECT_FALSE(is_valid(value({texture(name, "by v")}, 2.f))) << name;
  }
}

// Curves are told by it; a mix is of fibres if all its parts are.
TEST(Hair, IsOfFibres) {
  Resolver resolver;
  resolver.materials["dark"] = resolver.materials["fair"] = make_material("hair");
  resolver.materials["paint"] = make_material("diffuse");
  const auto mix = [&](const std::string& other) {
    return make_material("mix", {strings(ParameterType::String, "materials", {"dark", other})},
                         &resolver);
  };
  EXPECT_TRUE(is_of_fibres(*resolver.materials["dark"]));
  EXPECT_FALSE(is_of_fibres(*resolver.materials["paint"]));
  EXPECT_TRUE(is_of_fibres(*mix("fair")));
  EXPECT_FALSE(is_of_fibres(*mix("paint")));
}

// In a scene curves become sheets, unless it says otherwise.
TEST(Hair, MakesCurvesSheets) {
  const auto triangles = [](const std::string& material, const std::string& more) {
    const std::string scene = "WorldBegin\nMaterial \"" + material +
                              "\" Shape \"curve\" \"float width\" .5\n"
                              "\"point3 P\" [ 0 0 5  0 .3 5  0 .6 5  0 1 5 ] " +
                              more;
    BuildOptions options;
    options.defaults = default_plugins();
    return build_scene(parse_string(scene, "scene"), options).scene->features().triangles;
  };
  const size_t tube = triangles("diffuse", ""), sheet = triangles("hair", "");
  EXPECT_NE(tube, sheet);
  EXPECT_EQ(triangles("hair", "\"bool sheet\" false"), tube);
  EXPECT_EQ(triangles("diffuse", "\"bool sheet\" true"), sheet);
}

TEST(Hair, RefusesWhatItCannotDo) {
  EXPECT_NE(error_of([] { make_material("hair", {number("eta", .9f)}); }).find("test-scene:7:3"),
            std::string::npos);
  EXPECT_NE(error_of([] { make_material("hair", {number("beta", .9f)}); }), "");
}

}  // namespace
}  // namespace pssmlt
