// The principled material: laws that every lobe and every mixture keeps, limits with closed forms,
// and the tables that it leans on.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "core/cauchy_index.h"
#include "core/color/fresnel.h"
#include "core/ggx_albedo.h"
#include "core/path/dispersion.h"
#include "core/sheen.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_plugin.h"
#include "tests/support/walk_source.h"

namespace pssmlt::test {
namespace {

struct Case {
  const char* name;
  ParameterSet set;
};

std::vector<Case> rough_cases() {
  return {{"Plastic", {rgb("basecolor", .9f, .4f, .1f), number("roughness", .5f)}},
          {"White", {rgb("basecolor", 1, 1, 1), number("roughness", .4f)}},
          {"Metal",
           {rgb("basecolor", 1.f, .8f, .5f), number("metallic", 1.f), number("roughness", .6f)}},
          {"Brushed",
           {number("metallic", 1.f), number("roughness", .5f), number("anisotropy", .8f),
            number("anisotropyrotation", 30.f)}},
          {"Sheet", {number("transmission", 1.f), number("roughness", .5f)}},
          {"Glass",
           {rgb("basecolor", 1, 1, 1), number("transmission", 1.f), number("roughness", .6f),
            number("thickness", 1.f)}},
          {"Dispersing",
           {rgb("basecolor", 1, 1, 1), number("transmission", .9f), number("roughness", .6f),
            number("thickness", 1.f), number("dispersion", 5.f)}},
          {"Varnished",
           {rgb("basecolor", 1, 1, 1), number("clearcoat", 1.f), number("clearcoatroughness", .4f),
            number("roughness", .7f)}},
          {"Cloth", {rgb("sheencolor", .9f, .7f, .8f), number("sheenroughness", .4f)}},
          {"Everything",
           {rgb("basecolor", .9f, .5f, .7f), number("metallic", .3f), number("transmission", .5f),
            number("thickness", .1f), number("ior", 1.4f), number("specular", .8f),
            rgb("specularcolor", 1.f, .6f, .3f), number("clearcoat", .7f),
            number("clearcoatroughness", .5f), rgb("sheencolor", .3f, .2f, .5f),
            number("sheenroughness", .6f), number("roughness", .6f), number("anisotropy", .5f)}}};
}

class AnyPrincipled : public testing::TestWithParam<Case> {
 protected:
  AnyPrincipled() : material_(make_material("principled", GetParam().set)) {
    bsdf_ = material_->bsdf(Hit(), numbers_.next(), storage_);
  }
  std::optional<BsdfSample> draw(RandomStream& random, const vec3& wo, Transport mode) const {
    const float lobe = random.next();
    const float x = random.next();
    const float y = random.next();
    return bsdf_->sample(wo, lobe, {x, y}, mode);
  }
  static std::vector<vec3> views() {
    return {{0.f, 0.f, 1.f}, {.6f, 0.f, .8f}, {0.f, -.96f, .28f}, {.48f, .6f, -.64f}};
  }
  std::shared_ptr<const Material> material_;
  WalkSource numbers_{1};  // of one wavelength
  BsdfStorage storage_;
  const Bsdf* bsdf_ = nullptr;
};

TEST_P(AnyPrincipled, DirectionsFollowTheirDensity) {
  for (const vec3& wo : views()) {
    const auto result = chi_square_sphere(
        [&](RandomStream& random) -> std::optional<vec3> {
          const auto s = draw(random, wo, Transport::radiance);
          return s && !s->delta ? std::optional(s->wi) : std::nullopt;
        },
        [&](const vec3& wi) { return static_cast<double>(bsdf_->pdf(wo, wi)); },
        {.bins_x = 32, .bins_y = 32, .samples = 60'000, .fine = 48});
    EXPECT_GT(result.p, false_alarm) << wo.z;
    EXPECT_NEAR(result.integral + result.failures, 1.0, 8e-3) << wo.z;
  }
}

// eval, pdf and sample say the same of every direction drawn.
TEST_P(AnyPrincipled, SampleAgreesWithEvalAndPdf) {
  RandomStream random(3, RandomUse::test);
  for (const Transport mode : {Transport::radiance, Transport::importance}) {
    for (const vec3& wo : views()) {
      for (int i = 0; i < 1000; ++i) {
        const auto s = draw(random, wo, mode);
        if (!s) continue;
        ASSERT_FALSE(s->delta);
        ASSERT_NEAR(glm::length(s->wi), 1.f, 1e-5f);
        ASSERT_EQ(s->transmitted, wo.z * s->wi.z < 0.f);
        if (std::abs(s->wi.z) < 0.02f) continue;
        const float pdf = bsdf_->pdf(wo, s->wi);
        ASSERT_NEAR(s->pdf, pdf, 5e-3f * pdf);
        const float reverse = bsdf_->pdf(s->wi, wo);
        ASSERT_NEAR(s->pdf_reverse, reverse, 5e-3f * reverse + 1e-6f);
        const Rgb expected = bsdf_->eval(wo, s->wi, mode) * (std::abs(s->wi.z) / pdf);
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(s->weight[c], expected[c], 5e-3f * expected[c] + 1e-6f);
      }
    }
  }
}

TEST_P(AnyPrincipled, IsReciprocal) {
  RandomStream random(5, RandomUse::test);
  for (int i = 0; i < 5000; ++i) {
    const float a = random.next();
    const float b = random.next();
    const float c = random.next();
    const float d = random.next();
    const vec3 wo = uniform_sphere({a, b}), wi = uniform_sphere({c, d});
    const Rgb forward = bsdf_->eval(wo, wi, Transport::radiance);
    const Rgb back = bsdf_->eval(wi, wo, Transport::importance);
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(forward[k], 0.f);
      ASSERT_NEAR(forward[k], back[k], 2e-3f * forward[k] + 1e-6f);
    }
    ASSERT_TRUE(material_->traits().transmits || wo.z * wi.z > 0.f || is_black(forward));
  }
}

double albedo_of(const Bsdf& bsdf, const vec3& wo, int samples, double& error) {
  RandomStream random(6, RandomUse::test);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < samples; ++i) {
    const float lobe = random.next();
    const float x = random.next();
    const float y = random.next();
    const auto s = bsdf.sample(wo, lobe, {x, y}, Transport::importance);
    const double w = s ? static_cast<double>(max_component(s->weight)) : 0.0;
    sum += w;
    squares += w * w;
  }
  const double mean = sum / samples;
  error = std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples);
  return mean;
}

TEST_P(AnyPrincipled, GainsNoEnergy) {
  for (const vec3& wo : views()) {
    double error = 0.0;
    const double mean = albedo_of(*bsdf_, wo, 20'000, error);
    EXPECT_LE(mean, 1.0 + z_limit * error + 2e-3) << wo.z;
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyPrincipled, testing::ValuesIn(rough_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

struct Made {
  explicit Made(const ParameterSet& set = {}, Resolver* resolver = nullptr)
      : material(make_material("principled", set, resolver)),
        bsdf(material->bsdf(Hit(), {}, storage)) {}
  std::shared_ptr<const Material> material;
  BsdfStorage storage;
  const Bsdf* bsdf;
};

// A white base loses nothing, whatever lies on top of it and however rough it is. The tables'
// interpolation and five standard errors.
TEST(Principled, WhiteFurnace) {
  std::vector<ParameterSet> sets;
  for (const float roughness : {0.f, .2f, .5f, 1.f})
    for (const float ior : {1.f, 1.5f, 2.5f})
      sets.push_back(
          {rgb("basecolor", 1, 1, 1), number("roughness", roughness), number("ior", ior)});
  const size_t bare = sets.size();
  sets.push_back({rgb("basecolor", 1, 1, 1), number("clearcoat", 1.f)});
  sets.push_back(
      {rgb("basecolor", 1, 1, 1), rgb("sheencolor", 1, 1, 1), number("sheenroughness", .5f)});
  for (size_t i = 0; i < sets.size(); ++i) {
    const Made white(sets[i]);
    for (const float z : {1.f, .7f, .3f, .1f, -.5f}) {
      double error = 0.0;
      const vec3 wo(safe_sqrt(1.f - z * z), 0.f, z);
      const double albedo = albedo_of(*white.bsdf, wo, 40'000, error);
      // Under layers the surface's own reflection may lose a little by the smaller of both ways.
      EXPECT_NEAR(albedo, 1.0, 5.0 * error + (i < bare ? 5e-3 : 2e-2)) << i << " " << z;
    }
  }
}

TEST(Principled, SmoothMetalIsAMirrorOfSchlick) {
  const Made mirror(
      {rgb("basecolor", .9f, .5f, .1f), number("metallic", 1.f), number("roughness", 0.f)});
  EXPECT_FALSE(mirror.bsdf->connectible());
  EXPECT_FALSE(mirror.material->traits().diffuse_lobes);
  EXPECT_TRUE(mirror.material->traits().delta_lobes);
  const vec3 wo = glm::normalize(vec3(.6f, .2f, .5f));
  const auto s = mirror.bsdf->sample(wo, .5f, {.3f, .4f}, Transport::radiance);
  ASSERT_TRUE(s && s->delta);
  EXPECT_EQ(s->pdf, 1.f);
  EXPECT_NEAR(glm::distance(s->wi, vec3(-wo.x, -wo.y, wo.z)), 0.f, 1e-6f);
  const float grazing = std::pow(1.f - wo.z, 5.f);
  const Rgb base(.9f, .5f, .1f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(s->weight[c], base[c] + (1.f - base[c]) * grazing, 1e-5f);
}

// Solid and smooth: the same events as those of the material "dielectric".
TEST(Principled, SmoothBodyIsGlass) {
  const Made body({rgb("basecolor", 1, 1, 1), number("transmission", 1.f), number("roughness", 0.f),
                   number("thickness", 1.f), number("ior", 1.33f)});
  const auto glass = make_material("dielectric", {number("eta", 1.33f)});
  BsdfStorage storage;
  const Bsdf* const expected = glass->bsdf(Hit(), {}, storage);
  EXPECT_TRUE(body.material->traits().transmits);
  for (const vec3& wo : {glm::normalize(vec3(.6f, .2f, .5f)), glm::normalize(vec3(.3f, .2f, -.9f)),
                         glm::normalize(vec3(.9f, 0.f, -.2f))}) {
    for (const float u : {0.f, .5f, .99f}) {
      const auto a = body.bsdf->sample(wo, u, {}, Transport::radiance);
      const auto b = expected->sample(wo, u, {}, Transport::radiance);
      ASSERT_TRUE(a && b && a->delta);
      EXPECT_NEAR(glm::distance(a->wi, b->wi), 0.f, 1e-5f);
      EXPECT_NEAR(a->pdf, b->pdf, 1e-5f);
      EXPECT_NEAR(a->weight.x, b->weight.x, 1e-5f);
      EXPECT_NEAR(a->eta, b->eta, 1e-5f);
    }
  }
}

ParameterSet dispersing_body() {
  return {rgb("basecolor", 1, 1, 1), number("transmission", 1.f), number("roughness", 0.f),
          number("thickness", 1.f), number("dispersion", 1.f)};
}

// By Snell's and Fresnel's laws with Cauchy's index of the path's wavelength; without a path with
// that of the d line.
TEST(Principled, SmoothBodyRefractsByWavelength) {
  const Made body(dispersing_body());
  EXPECT_TRUE(body.material->traits().disperses);
  const vec3 wo = glm::normalize(vec3(.6f, .2f, .5f));
  EXPECT_EQ(body.bsdf->sample(wo, .99f, {}, Transport::radiance)->eta, 1.5f);
  const CauchyIndex index(1.5f, 1.f);
  WalkSource source(3);
  for (int i = 0; i < 100; ++i) {
    const MaterialNumbers u = source.next();
    BsdfStorage storage;
    const auto s =
        body.material->bsdf(Hit(), u, storage)->sample(wo, .99f, {}, Transport::radiance);
    ASSERT_TRUE(s && s->transmitted);
    const float n = index.at(path_wavelength(*u.sample).nanometres);
    EXPECT_NEAR(s->eta, n, 1e-6f);
    EXPECT_NEAR(glm::distance(vec2(s->wi.x, s->wi.y), vec2(-wo.x, -wo.y) / n), 0.f, 1e-6f);
    EXPECT_NEAR(s->pdf, 1.f - fresnel_dielectric(wo.z, n), 1e-5f);
  }
}

// What does not refract by wavelength reads no number of the path's, so that the path needs none.
TEST(Principled, DispersesOnlyWhereLightRefracts) {
  const auto reads = [](const Parameter& last) {
    ParameterSet set = dispersing_body();
    std::erase_if(set, [&](const Parameter& p) { return p.name == last.name; });
    set.push_back(last);
    const Made body(set);
    WalkSource source(4);
    const MaterialNumbers u = source.next();
    BsdfStorage storage;
    body.material->bsdf(Hit(), u, storage);
    const bool read = u.sample->held(Stream::shared).end() > 0;
    EXPECT_EQ(read, body.material->traits().disperses) << last.name;
    return read;
  };
  EXPECT_TRUE(reads(number("transmission", .1f)));
  EXPECT_FALSE(reads(number("dispersion", 0.f)));
  EXPECT_FALSE(reads(number("thickness", 0.f)));
  EXPECT_FALSE(reads(number("transmission", 0.f)));
  EXPECT_FALSE(reads(number("metallic", 1.f)));
  EXPECT_FALSE(reads(number("ior", 0.f)));
  EXPECT_FALSE(reads(number("ior", 1.f)));
}

TEST(Principled, ThinSheetPassesStraightAndTinted) {
  const Made sheet(
      {rgb("basecolor", .5f, 1.f, 1.f), number("transmission", 1.f), number("roughness", 0.f)});
  const vec3 wo(0.f, 0.f, 1.f);
  const auto s = sheet.bsdf->sample(wo, .99f, {}, Transport::radiance);
  ASSERT_TRUE(s && s->delta && s->transmitted);
  EXPECT_EQ(s->wi, -wo);
  EXPECT_NEAR(s->pdf * s->weight.y, .96f, 1e-5f);
  EXPECT_NEAR(s->pdf * s->weight.x, .48f, 1e-5f);
}

// The lobe's longer axis lies across the direction that scatters widely.
TEST(Principled, AnisotropyTurnsWithItsRotation) {
  const ParameterSet set = {number("metallic", 1.f), number("roughness", .3f),
                            number("anisotropy", 1.f)};
  ParameterSet turned = set;
  turned.push_back(number("anisotropyrotation", 90.f));
  const Made along(set), across(turned);
  const vec3 wo(0.f, 0.f, 1.f), x(.6f, 0.f, .8f), y(0.f, .6f, .8f);
  const auto f = [&](const Made& m, const vec3& wi) {
    return m.bsdf->eval(wo, wi, Transport::radiance).x;
  };
  EXPECT_GT(f(along, x), 5.f * f(along, y));
  EXPECT_NEAR(f(along, x), f(across, y), 1e-4f * f(along, x));
  EXPECT_NEAR(f(along, y), f(across, x), 1e-4f * f(along, x));
}

TEST(Principled, RefusesAndFails) {
  const auto error = [](const Parameter& p) {
    return error_of([&] { make_material("principled", {p}); });
  };
  EXPECT_NE(error(number("ior", .5f)), "");
  EXPECT_NE(error(number("thickness", -1.f)), "");
  for (const float wrong :
       {-1.f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    EXPECT_NE(error(number("dispersion", wrong)).find("test-scene:7:3"), std::string::npos);
  Resolver resolver;
  resolver.floats["broken"] = constant_texture(std::numeric_limits<float>::quiet_NaN());
  const Made broken({texture("roughness", "broken")}, &resolver);
  EXPECT_TRUE(std::isnan(broken.bsdf->albedo({0.f, 0.f, 1.f}).x));
}

// The definition beside the table: a sum over the hemisphere at a roughness between its rows.
TEST(Sheen, AlbedoIsTheIntegralAndAtMostOne) {
  const Sheen& sheen = Sheen::table();
  for (const float roughness : {.1f, .3f, .55f, 1.f}) {
    for (const float mu : {.05f, .3f, .8f}) {
      const vec3 wo(safe_sqrt(1.f - mu * mu), 0.f, mu);
      constexpr int n = 128;
      double sum = 0.0;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const vec3 wi = direction_at_height((float(j) + .5f) / n, (float(i) + .5f) / n);
          sum += static_cast<double>(wi.z * sheen.value(wo, wi, roughness));
        }
      sum *= 2.0 * std::numbers::pi / (n * n);
      EXPECT_NEAR(sheen.albedo(mu, roughness), sum, .02 + .03 * sum) << roughness << " " << mu;
      EXPECT_LE(sheen.albedo(mu, roughness), 1.f);
    }
  }
}

TEST(GgxAlbedo, MirrorAndRoughLimits) {
  const GgxAlbedo& table = GgxAlbedo::table();
  EXPECT_NEAR(table.at(1.f, 0.f)(.04f, 1.f), .04f, 1e-4f);
  // Without Fresnel a narrow lobe reflects all, a wide one loses what it shadows.
  EXPECT_NEAR(table.at(.5f, .01f)(1.f, 1.f), 1.f, 2e-3f);
  EXPECT_LT(table.at(.5f, 1.f)(1.f, 1.f), .8f);
  // The mean of Schlick's (1 - mu)^5 over a diffuse illumination is 1 / 21.
  EXPECT_NEAR(table.mean(0.f).high, 1.f / 21.f, 2e-3f);
}

}  // namespace
}  // namespace pssmlt::test
