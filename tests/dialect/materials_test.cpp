// What v3's materials become.
#include <gtest/gtest.h>

#include "core/coat.h"
#include "tests/support/read_v3.h"

namespace pssmlt {
namespace {

using namespace test;

// The material of a scene's first shape.
MaterialDescription only(const SceneDescription& s) {
  return s.materials.at(s.shapes.at(0).material);
}
MaterialDescription material(const std::string& directive,
                             std::vector<std::string>* log = nullptr) {
  return only(world_v3(directive + " Shape \"sphere\"", log));
}
const MaterialDescription& named(const SceneDescription& s, const std::string& name) {
  const auto found = std::ranges::find(s.materials, name, &MaterialDescription::name);
  if (found == s.materials.end()) throw std::out_of_range(name);
  return *found;
}
using Floats = std::vector<float>;

TEST(V3Materials, Matte) {
  std::vector<std::string> log;
  const auto m = material("Material \"matte\" \"color Kd\" [.1 .2 .3] \"float sigma\" 20", &log);
  EXPECT_EQ(m.type, "diffuse");
  EXPECT_EQ(numbers(m, "reflectance"), (Floats{.1f, .2f, .3f}));
  EXPECT_EQ(m.parameters.size(), 1u);
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0], "v3 dialect: 1 material (matte)");
  EXPECT_NE(log[1].find("sigma of matte"), std::string::npos);
  EXPECT_EQ(numbers(material("Material \"matte\""), "reflectance"), (Floats{.5f, .5f, .5f}));
  EXPECT_EQ(text(material("Texture \"t\" \"color\" \"uv\" Material \"matte\" \"texture Kd\" \"t\""),
                 "reflectance"),
            "t");
}

// v3's own curve from roughness to the width of the lobe, as a width.
TEST(V3Materials, RoughnessIsAWidth) {
  const auto rough = material("Material \"metal\"");
  EXPECT_EQ(rough.type, "conductor");
  EXPECT_NEAR(number(rough, "roughness"), 0.1389f, 2e-3f);  // of 0.01
  EXPECT_EQ(parameter(rough, "remaproughness")->bools.at(0), 0);
  const auto plain = material(
      "Material \"metal\" \"float uroughness\" .3 \"float roughness\" .2"
      " \"bool remaproughness\" \"false\"");
  EXPECT_EQ(number(plain, "uroughness"), .3f);
  EXPECT_EQ(number(plain, "vroughness"), .2f);
  EXPECT_EQ(parameter(plain, "roughness"), nullptr);
}

TEST(V3Materials, MirrorAndGlass) {
  const auto mirror = material("Material \"mirror\"");
  EXPECT_EQ(mirror.type, "conductor");
  EXPECT_EQ(numbers(mirror, "reflectance"), (Floats{.9f, .9f, .9f}));
  EXPECT_EQ(number(mirror, "roughness"), 0.f);
  const auto glass = material("Material \"glass\" \"float index\" 1.6 \"rgb Kr\" [1 1 1]");
  EXPECT_EQ(glass.type, "dielectric");
  EXPECT_EQ(number(glass, "eta"), 1.6f);
  EXPECT_EQ(number(glass, "roughness"), 0.f);  // not v3's curve at 0, which is rough
  EXPECT_EQ(parameter(glass, "Kr"), nullptr);
  const auto frosted =
      material("Material \"glass\" \"float uroughness\" .1 \"float vroughness\" .1");
  EXPECT_NEAR(number(frosted, "roughness"), 0.4617f, 2e-3f);
}

// Share Ks of the surface has a coat, over a base that shows Kd through it.
TEST(V3Materials, Plastic) {
  const SceneDescription s =
      world_v3("Material \"plastic\" \"rgb Kd\" [.2 .3 .4] \"rgb Ks\" [.5 .5 .5] Shape \"sphere\"");
  const auto m = only(s);
  ASSERT_EQ(m.type, "mix");
  EXPECT_EQ(number(m, "amount"), .5f);
  const auto& parts = parameter(m, "materials")->strings;
  const auto &bare = named(s, parts.at(0)), &coated = named(s, parts.at(1));
  EXPECT_EQ(bare.type, "diffuse");
  EXPECT_EQ(numbers(bare, "reflectance"), (Floats{.2f, .3f, .4f}));
  EXPECT_EQ(coated.type, "coateddiffuse");
  EXPECT_NEAR(number(coated, "roughness"), 0.4617f, 2e-3f);
  EXPECT_EQ(number(coated, "eta"), 1.5f);
  // What the base shows, by the formula of the coat itself.
  const Floats base = numbers(coated, "reflectance");
  const Coat coat(1.5f, .01f, number(coated, "roughness"));
  for (size_t c = 0; c < 3; ++c) {
    const float out = coat.mean_transmitted() * coat.mean_transmitted() * base[c] /
                      (1.5f * 1.5f * (1.f - base[c] * coat.sent_back()));
    EXPECT_NEAR(out, .2f + .1f * static_cast<float>(c), 1e-5f);
  }
  EXPECT_EQ(material("Material \"plastic\" \"rgb Ks\" [0 0 0]").type, "diffuse");
  EXPECT_EQ(material("Material \"plastic\" \"rgb Ks\" [1 1 1]").type, "coateddiffuse");
}

TEST(V3Materials, TexturedPlasticIsSeenThroughItsCoat) {
  const SceneDescription s = world_v3(
      "Texture \"wood\" \"color\" \"uv\" Material \"plastic\" \"texture Kd\" \"wood\""
      " \"rgb Ks\" [1 1 1] Shape \"sphere\"");
  const std::string name = text(only(s), "reflectance");
  const auto base = std::ranges::find(s.textures, name, &TextureDescription::name);
  ASSERT_NE(base, s.textures.end());
  EXPECT_EQ(base->type, "undercoat");
  EXPECT_EQ(text(*base, "tex"), "wood");
}

// Ks is the reflectance at normal incidence: 4 % is an index of 1.5.
TEST(V3Materials, Substrate) {
  const auto m = material("Material \"substrate\" \"rgb Ks\" [.04 .04 .04]");
  EXPECT_EQ(m.type, "coateddiffuse");
  EXPECT_NEAR(number(m, "eta"), 1.5f, 1e-4f);
}

TEST(V3Materials, Uber) {
  const SceneDescription glass = world_v3(
      "Material \"uber\" \"rgb Kd\" [0 0 0] \"rgb Ks\" [0 0 0] \"rgb Kt\" [1 1 1] \"float eta\" 1.3"
      " Shape \"sphere\"");
  EXPECT_EQ(only(glass).type, "dielectric");
  EXPECT_EQ(number(only(glass), "eta"), 1.3f);
  const SceneDescription veil = world_v3(
      "Material \"uber\" \"rgb Ks\" [0 0 0] \"rgb opacity\" [.25 .25 .25] Shape \"sphere\"");
  EXPECT_EQ(only(veil).type, "diffuse");
  EXPECT_EQ(number(veil.shapes.at(0), "alpha"), .25f);
  // A texture of colours is read again as one of numbers.
  const SceneDescription leaf = world_v3(
      "Texture \"cut\" \"color\" \"checkerboard\" \"rgb tex1\" [1 1 1] \"rgb tex2\" [0 0 0]"
      " Material \"uber\" \"texture opacity\" \"cut\" Shape \"sphere\"");
  EXPECT_EQ(text(leaf.shapes.at(0), "alpha"), "cut");
  ASSERT_EQ(leaf.textures.size(), 2u);
  EXPECT_EQ(leaf.textures[1].value, TextureValue::Float);
  EXPECT_EQ(leaf.textures[1].name, "cut");
  EXPECT_EQ(number(leaf.textures[1], "tex1"), 1.f);
  const SceneDescription half =
      world_v3("Material \"uber\" \"rgb Kt\" [.5 .5 .5] \"rgb Ks\" [0 0 0] Shape \"sphere\"");
  EXPECT_EQ(only(half).type, "mix");
  EXPECT_EQ(number(only(half), "amount"), .5f);
}

// v3's amount is the first material's share, today it is the second's.
TEST(V3Materials, MixTurnsAround) {
  const auto m = material(
      "MakeNamedMaterial \"a\" \"string type\" \"matte\" MakeNamedMaterial \"b\" \"string type\""
      " \"mirror\" Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\""
      " \"rgb amount\" [.25 .25 .25]");
  EXPECT_EQ(parameter(m, "materials")->strings, (std::vector<std::string>{"b", "a"}));
  EXPECT_EQ(number(m, "amount"), .25f);
}

TEST(V3Materials, TranslucentDisneyAndTheRest) {
  const auto leaf = material("Material \"translucent\" \"rgb Kd\" [.8 .4 .2] \"rgb Ks\" [0 0 0]");
  EXPECT_EQ(leaf.type, "diffusetransmission");
  EXPECT_EQ(numbers(leaf, "reflectance"), (Floats{.4f, .2f, .1f}));
  EXPECT_EQ(numbers(leaf, "transmittance"), (Floats{.4f, .2f, .1f}));
  std::vector<std::string> log;
  const auto metal = material(
      "Material \"disney\" \"color color\" [.9 .6 .2] \"float metallic\" 1 \"float roughness\" .4"
      " \"float sheen\" .5",
      &log);
  EXPECT_EQ(metal.type, "conductor");
  EXPECT_NEAR(number(metal, "roughness"), .16f, 1e-6f);
  EXPECT_NE(log.at(1).find("sheen of disney"), std::string::npos);
  EXPECT_EQ(material("Material \"disney\"").type, "coateddiffuse");
  EXPECT_EQ(material("Material \"none\"").type, "interface");
  EXPECT_EQ(material("Material \"\"").type, "interface");
  const auto skin = material("Material \"kdsubsurface\" \"rgb Kd\" [.5 .4 .3]");
  EXPECT_EQ(skin.type, "subsurface");
  EXPECT_EQ(numbers(skin, "reflectance"), (Floats{.5f, .4f, .3f}));
  EXPECT_NE(parameter(material("Material \"matte\" \"texture bumpmap\" \"b\""), "displacement"),
            nullptr);
}

TEST(V3Materials, WhatCannotBeTranslatedIsNamed) {
  const std::string fourier = complaint("Material \"fourier\" \"string bsdffile\" \"x.bsdf\"");
  EXPECT_NE(fourier.find("old:2:1: material \"fourier\""), std::string::npos) << fourier;
  EXPECT_NE(complaint("Material \"mix\" \"string namedmaterial1\" \"a\"").find("namedmaterial2"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
