// What each material is for: limits with closed forms, parameters, refusals.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/color/fresnel.h"
#include "core/color/fresnel_rgb.h"
#include "core/color/named_spectra.h"
#include "core/image/image.h"
#include "core/path/dispersion.h"
#include "tests/support/make_plugin.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/walk_source.h"

namespace pssmlt {
namespace {

using namespace test;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
const vec3 slanted = glm::normalize(vec3(0.6f, 0.2f, 0.5f));

struct Made {
  explicit Made(const std::string& type, const ParameterSet& set = {}, Resolver* resolver = nullptr)
      : material(make_material(type, set, resolver)) {}
  const Bsdf* at(MaterialNumbers u = {}) { return material->bsdf(Hit(), u, storage); }
  std::shared_ptr<const Material> material;
  BsdfStorage storage;
};

void expect_near(const Rgb& a, const Rgb& b, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(Diffuse, DefaultsClampsAndBlack) {
  Made grey("diffuse");
  expect_near(grey.at()->eval(slanted, slanted, Transport::radiance), Rgb(0.5f / pi), 1e-6f);
  EXPECT_TRUE(grey.material->traits().diffuse_lobes);
  EXPECT_FALSE(grey.material->traits().transmits);
  Made black("diffuse", {rgb("reflectance", 0, 0, 0)});
  EXPECT_EQ(black.at(), nullptr);
  Resolver resolver;
  resolver.colours["bright"] = constant_texture(Rgb(2.f, -1.f, 0.5f));
  Made clamped("diffuse", {texture("reflectance", "bright")}, &resolver);
  expect_near(clamped.at()->albedo(slanted), Rgb(1.f, 0.f, 0.5f), 0.f);
}

TEST(Diffuse, FailedTextureShowsInTheSample) {
  Resolver resolver;
  resolver.colours["broken"] = constant_texture(Rgb(nan));
  Made m("diffuse", {texture("reflectance", "broken")}, &resolver);
  const auto s = m.at()->sample(slanted, 0.5f, {0.3f, 0.4f}, Transport::radiance);
  ASSERT_TRUE(s);
  EXPECT_FALSE(is_valid(s->weight));
  EXPECT_TRUE(is_finite(s->wi));
}

TEST(Conductor, DefaultIsSmoothCopper) {
  Made copper("conductor");
  EXPECT_FALSE(copper.at()->connectible());
  EXPECT_TRUE(copper.material->traits().delta_lobes);
  EXPECT_FALSE(copper.material->traits().diffuse_lobes);
  const auto s = copper.at()->sample(slanted, 0.5f, {0.3f, 0.4f}, Transport::radiance);
  ASSERT_TRUE(s && s->delta);
  EXPECT_EQ(s->wi, vec3(-slanted.x, -slanted.y, slanted.z));
  const FresnelCurve curve =
      FresnelCurve::from_spectra(*named_spectrum("metal-Cu-eta"), *named_spectrum("metal-Cu-k"));
  expect_near(s->weight, curve(slanted.z), 1e-6f);
  EXPECT_GT(s->weight.x, s->weight.z);
}

TEST(Conductor, ReflectanceConstantOrTexturedIsTheSame) {
  Resolver resolver;
  resolver.colours["c"] = constant_texture(Rgb(0.9f, 0.5f, 0.1f));
  Made constant("conductor", {rgb("reflectance", 0.9f, 0.5f, 0.1f)});
  Made textured("conductor", {texture("reflectance", "c")}, &resolver);
  const vec3 up(0.f, 0.f, 1.f);
  for (const vec3& wo : {up, slanted}) {
    const auto a = constant.at()->sample(wo, 0.5f, {}, Transport::radiance);
    const auto b = textured.at()->sample(wo, 0.5f, {}, Transport::radiance);
    expect_near(a->weight, b->weight, 2e-3f);
  }
  expect_near(constant.at()->albedo(up), Rgb(0.9f, 0.5f, 0.1f), 1e-3f);
}

TEST(Conductor, EtaAndKAsColours) {
  Made m("conductor", {rgb("eta", 0.2f, 0.9f, 1.1f), rgb("k", 3.9f, 2.4f, 2.2f)});
  const Rgb expected = fresnel_conductor(slanted.z, Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.4f, 2.2f));
  expect_near(m.at()->albedo(slanted), expected, 2e-3f);
}

TEST(Conductor, NarrowLobeIsNearlyTheMirror) {
  const ParameterSet narrow = {number("roughness", 2e-3f), flag("remaproughness", false)};
  Made rough("conductor", narrow), smooth("conductor");
  ASSERT_TRUE(rough.at()->connectible());
  RandomStream random(5, RandomUse::test);
  const Rgb mirror = smooth.at()->albedo(slanted);
  for (int i = 0; i < 100; ++i) {
    const float x = random.next();
    const float y = random.next();
    const auto s = rough.at()->sample(slanted, 0.f, {x, 0.9f * y}, Transport::radiance);
    ASSERT_TRUE(s);
    EXPECT_GT(glm::dot(s->wi, vec3(-slanted.x, -slanted.y, slanted.z)), 0.999f);
    expect_near(s->weight, mirror, 0.01f);
  }
}

TEST(Roughness, RemapsByTheRootAndRefusesNegatives) {
  Made remapped("conductor", {number("roughness", 0.04f)});
  Made direct("conductor", {number("roughness", 0.2f), flag("remaproughness", false)});
  const vec3 wi = glm::normalize(vec3(-0.5f, -0.1f, 0.6f));
  expect_near(remapped.at()->eval(slanted, wi, Transport::radiance),
              direct.at()->eval(slanted, wi, Transport::radiance), 1e-5f);
  EXPECT_NE(error_of([] { make_material("conductor", {number("roughness", -0.1f)}); }), "");
}

TEST(Roughness, TexturesDecideAtEachPoint) {
  Resolver resolver;
  class ByU final : public Texture<float> {
    float evaluate(const Hit& hit) const override { return hit.uv.x; }
  };
  resolver.floats["by u"] = std::make_shared<ByU>();
  const auto m = make_material("dielectric", {texture("roughness", "by u")}, &resolver);
  EXPECT_TRUE(m->traits().delta_lobes);
  EXPECT_TRUE(m->traits().diffuse_lobes);
  BsdfStorage storage;
  Hit hit;
  EXPECT_FALSE(m->bsdf(hit, {}, storage)->connectible());
  hit.uv.x = 0.3f;
  EXPECT_TRUE(m->bsdf(hit, {}, storage)->connectible());
  hit.uv.x = nan;
  EXPECT_TRUE(std::isnan(m->bsdf(hit, {}, storage)->albedo(slanted).x));
}

TEST(Dielectric, SmoothSplitsByFresnelAndScalesRadiance) {
  Made glass("dielectric");
  const float r = fresnel_dielectric(slanted.z, 1.5f);
  const auto reflected = glass.at()->sample(slanted, 0.99f * r, {}, Transport::radiance);
  ASSERT_TRUE(reflected && reflected->delta && !reflected->transmitted);
  EXPECT_NEAR(reflected->pdf, r, 1e-6f);
  EXPECT_EQ(reflected->weight, Rgb(1.f));
  const auto refracted = glass.at()->sample(slanted, 1.01f * r, {}, Transport::radiance);
  ASSERT_TRUE(refracted && refracted->delta && refracted->transmitted);
  EXPECT_NEAR(refracted->pdf, 1.f - r, 1e-6f);
  EXPECT_NEAR(refracted->weight.x, 1.f / 2.25f, 1e-6f);
  EXPECT_FLOAT_EQ(refracted->eta, 1.5f);
  // Snell's law, and the way back.
  EXPECT_NEAR(refracted->wi.x, -slanted.x / 1.5f, 1e-6f);
  EXPECT_NEAR(refracted->wi.y, -slanted.y / 1.5f, 1e-6f);
  const auto back = glass.at()->sample(refracted->wi, 0.99f, {}, Transport::importance);
  ASSERT_TRUE(back && back->transmitted);
  EXPECT_NEAR(glm::dot(back->wi, slanted), 1.f, 1e-5f);
  EXPECT_NEAR(back->pdf, refracted->pdf_reverse, 1e-5f);
  EXPECT_EQ(back->weight, Rgb(1.f));
}

TEST(Dielectric, TotalInternalReflection) {
  const vec3 inside = glm::normalize(vec3(0.9f, 0.f, -0.3f));
  for (const float roughness : {0.f, 0.0005f}) {
    Made glass("dielectric", {number("roughness", roughness), flag("remaproughness", false)});
    const auto s = glass.at()->sample(inside, 0.999f, {0.2f, 0.3f}, Transport::radiance);
    ASSERT_TRUE(s);
    EXPECT_FALSE(s->transmitted);
    EXPECT_LT(s->wi.z, 0.f);
    EXPECT_EQ(s->pdf, 1.f);
  }
}

TEST(Dielectric, WithoutContrastNothingHappens) {
  Made air("dielectric", {number("eta", 1.f), number("roughness", 0.5f)});
  EXPECT_FALSE(air.at()->connectible());
  EXPECT_FALSE(air.material->traits().diffuse_lobes);
  for (const vec3& wo : {slanted, -slanted}) {
    const auto s = air.at()->sample(wo, 0.f, {0.2f, 0.3f}, Transport::radiance);
    ASSERT_TRUE(s && s->transmitted);
    EXPECT_NEAR(glm::dot(s->wi, -wo), 1.f, 1e-6f);
    EXPECT_EQ(s->weight, Rgb(1.f));
    EXPECT_EQ(s->pdf, 1.f);
  }
}

TEST(Dielectric, NamedGlassDispersesByThePathsWavelength) {
  Made named("dielectric", {strings(ParameterType::Spectrum, "eta", {"glass-BK7"})});
  EXPECT_TRUE(named.material->traits().disperses);
  EXPECT_FALSE(Made("dielectric").material->traits().disperses);
  // Without a path the d line; Schott's data sheet: n_d = 1.51680, n_C = 1.51432 (656.3 nm),
  // n_F = 1.52238 (486.1 nm).
  const auto s = named.at()->sample(slanted, 0.99f, {}, Transport::radiance);
  EXPECT_NEAR(s->eta, 1.5168f, 2e-3f);
  WalkSource source(3);
  for (int i = 0; i < 100; ++i) {
    const MaterialNumbers u = source.next();
    const float nanometres = path_wavelength(*u.sample).nanometres;
    const auto refracted = named.at(u)->sample(slanted, 0.99f, {}, Transport::radiance);
    const float t = (nanometres - 486.1f) / (656.3f - 486.1f);
    if (t > 0.f && t < 1.f) {
      EXPECT_GT(refracted->eta, 1.51432f - 2e-4f);
      EXPECT_LT(refracted->eta, 1.52238f + 2e-4f);
    } else {
      EXPECT_EQ(refracted->eta > 1.519f, t < 0.f);
    }
  }
  EXPECT_NE(error_of([] { make_material("dielectric", {number("eta", 0.f)}); }), "");
}

TEST(ThinDielectric, NamedGlassIsTakenAtTheDLine) {
  Made named("thindielectric", {strings(ParameterType::Spectrum, "eta", {"glass-BK7"})});
  EXPECT_FALSE(named.material->traits().disperses);
}

TEST(ThinDielectric, SeriesOfReflectionsAndStraightThrough) {
  Made sheet("thindielectric");
  const float r = fresnel_dielectric(slanted.z, 1.5f);
  float series = r, light = (1.f - r) * (1.f - r);
  for (int i = 0; i < 50; ++i, light *= r * r) series += light * r;
  const auto s = sheet.at()->sample(slanted, 0.99f, {}, Transport::radiance);
  ASSERT_TRUE(s && s->transmitted);
  EXPECT_EQ(s->wi, -slanted);
  EXPECT_NEAR(s->pdf, 1.f - series, 1e-5f);
  EXPECT_EQ(s->weight, Rgb(1.f));
  const auto mirrored = sheet.at()->sample(slanted, 0.f, {}, Transport::radiance);
  EXPECT_NEAR(mirrored->pdf, series, 1e-5f);
}

TEST(Mix, ChoosesByItsShareAndPassesUniformNumbersOn) {
  Resolver resolver;
  resolver.materials["white"] = make_material("diffuse", {rgb("reflectance", 1, 1, 1)});
  resolver.materials["grey"] = make_material("diffuse");
  const ParameterSet half = {strings(ParameterType::String, "materials", {"white", "grey"}),
                             number("amount", 0.25f)};
  resolver.materials["half"] = make_material("mix", half, &resolver);
  // Without this scenes do not read the numbers, and the choice is always the same.
  EXPECT_TRUE(resolver.materials["half"]->traits().draws_numbers);
  const ParameterSet nested = {strings(ParameterType::String, "materials", {"half", "grey"})};
  Made outer("mix", nested, &resolver);
  int white = 0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    const float u = (float(i) + 0.5f) / steps;
    white += outer.at({u, 0.5f})->albedo(slanted).x == 1.f ? 1 : 0;
  }
  EXPECT_NEAR(white, steps * 0.5 * 0.75, 2);
}

TEST(Mix, RefusesWhatItCannotDo) {
  Resolver resolver;
  resolver.materials["a"] = make_material("diffuse");
  resolver.materials["none"] = make_material("interface");
  resolver.materials["bumpy"] = make_material("diffuse", {number("displacement", 0.1f)});
  const auto error = [&](std::vector<std::string> names) {
    return error_of([&] {
      make_material("mix", {strings(ParameterType::String, "materials", std::move(names))},
                    &resolver);
    });
  };
  EXPECT_EQ(error({"a", "a"}), "");
  EXPECT_NE(error({"a"}).find("test-scene:7:3"), std::string::npos);
  EXPECT_NE(error({"a", "none"}).find("'none'"), std::string::npos);
  EXPECT_NE(error({"a", "bumpy"}).find("displacement"), std::string::npos);
}

TEST(Materials, DisplacementAndNormalMap) {
  const std::string map = test::own_file("normals.pfm");
  write_image(map, Image(2, 2, 3), {}, {});
  const auto fails = [](const char* type, const ParameterSet& set, const char* word) {
    const std::string error = error_of([&] { make_material(type, set); });
    EXPECT_NE(error.find(word), std::string::npos) << type << ": " << error;
    EXPECT_NE(error.find("test-scene:7:3"), std::string::npos) << type;
  };
  for (const char* type :
       {"diffuse", "diffusetransmission", "conductor", "dielectric", "thindielectric"}) {
    EXPECT_EQ(make_material(type)->shading_normals(), nullptr);
    EXPECT_NE(make_material(type, {number("displacement", 0.1f)})->shading_normals(), nullptr);
    EXPECT_NE(make_material(type, {text("normalmap", map)})->shading_normals(), nullptr);
    fails(type, {text("normalmap", "missing.png")}, "missing.png");
    fails(type, {number("displacement", 0.1f), text("normalmap", map)}, "together");
  }
  EXPECT_TRUE(make_material("interface")->traits().passes_through);
}

TEST(Materials, DescribeThemselves) {
  for (const std::string& name : Registry::instance().names("material"))
    EXPECT_NO_THROW(describe(*Registry::instance().find("material", name, {}).descriptor)) << name;
  for (const std::string& name : Registry::instance().names("texture"))
    EXPECT_NO_THROW(describe(*Registry::instance().find("texture", name, {}).descriptor)) << name;
}

}  // namespace
}  // namespace pssmlt
