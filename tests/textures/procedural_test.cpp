// Textures that are computed: values by hand or computed apart from the definition, places of the
// texture's space, and what a pixel's width does to them.
#include <gtest/gtest.h>

#include "core/noise.h"
#include "core/texture_mapping.h"
#include "tests/support/hits.h"
#include "tests/support/make_plugin.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {
using namespace test;

void expect_near(const Rgb& a, const Rgb& b) { EXPECT_LT(glm::distance(a, b), 3e-5f) << a.x; }

TEST(Bilerp, Corners) {
  const auto plain = make_texture<float>("bilerp");
  EXPECT_EQ(plain->evaluate(at_uv(0.3f, 0.f)), 0.f);
  EXPECT_EQ(plain->evaluate(at_uv(0.3f, 1.f)), 1.f);
  EXPECT_NEAR(plain->evaluate(at_uv(0.3f, 0.25f)), 0.25f, 1e-6f);
  const auto colours = make_texture<Rgb>(
      "bilerp", {rgb("v00", 1.f, 0.f, 0.f), rgb("v01", 0.f, 1.f, 0.f), rgb("v10", 0.f, 0.f, 4.f),
                 rgb("v11", 0.f, 0.f, 0.f), number("uscale", 2.f)});
  expect_near(colours->evaluate(at_uv(0.f, 0.f)), {1.f, 0.f, 0.f});
  expect_near(colours->evaluate(at_uv(0.f, 1.f)), {0.f, 1.f, 0.f});
  expect_near(colours->evaluate(at_uv(0.5f, 0.f)), {0.f, 0.f, 4.f});
  expect_near(colours->evaluate(at_uv(0.125f, 0.5f)), {0.375f, 0.375f, 0.5f});
}

// Squares around (-1, 1), (1, -1) and (0, 1) have a dot, those around (0, 0) and (-2, 0) have none.
TEST(Dots, PlacesAndValues) {
  Resolver resolver;
  resolver.colours["red"] = constant_texture(Rgb(1.f, 0.f, 0.f));
  resolver.colours["blue"] = constant_texture(Rgb(0.f, 0.f, 1.f));
  const auto dots =
      make_texture<Rgb>("dots", {texture("inside", "red"), texture("outside", "blue")}, &resolver);
  const Rgb red(1.f, 0.f, 0.f), blue(0.f, 0.f, 1.f);
  const vec2 center(1.f - 0.0325f, -1.f - 0.0234f);
  EXPECT_EQ(dots->evaluate(at_uv(center.x, center.y)), red);
  for (const vec2& d : {vec2(1.f, 0.f), vec2(0.f, 1.f), vec2(-0.6f, 0.8f)}) {
    const vec2 in = center + 0.349f * d, out = center + 0.351f * d;
    EXPECT_EQ(dots->evaluate(at_uv(in.x, in.y)), red);
    EXPECT_EQ(dots->evaluate(at_uv(out.x, out.y)), blue);
  }
  EXPECT_EQ(dots->evaluate(at_uv(0.0256f, 0.9342f)), red);
  EXPECT_EQ(dots->evaluate(at_uv(0.0854f, -0.0312f)), blue);
  EXPECT_EQ(dots->evaluate(at_uv(-1.9753f, -0.0141f)), blue);
  const auto plain = make_texture<float>("dots");
  EXPECT_EQ(plain->evaluate(at_uv(center.x, center.y)), 1.f);
  EXPECT_EQ(plain->evaluate(at_uv(0.f, 0.f)), 0.f);
}

TEST(Solid, KnownValues) {
  const vec3 p(1.25f, -2.5f, 3.75f);
  const auto value = [&](const char* type, const Transform& t = {}) {
    return make_texture<float>(type, {}, nullptr, t)->evaluate(at_point(t.point(p)));
  };
  EXPECT_NEAR(value("fbm"), 0.15548211f, 3e-5f);
  EXPECT_NEAR(value("wrinkled"), 0.16215201f, 3e-5f);
  EXPECT_NEAR(value("windy"), 0.09175715f, 3e-5f);
  expect_near(make_texture<Rgb>("marble")->evaluate(at_point(p)),
              {0.86471916f, 0.86468565f, 0.89324815f});
  // They turn and grow with their directive's transformation.
  const Transform moved = Transform::translate({1., 2., 3.}) *
                          Transform::rotate(30., {1., 2., 3.}) *
                          Transform::scale(dvec3(2., 3., 0.5));
  EXPECT_NEAR(value("fbm", moved), 0.15548211f, 1e-4f);
  const auto smooth =
      make_texture<float>("fbm", {integer("octaves", 1), number("roughness", 0.9f)});
  EXPECT_NEAR(smooth->evaluate(at_point(p)), noise(p), 1e-6f);
  const auto wide = make_texture<Rgb>("marble", {number("scale", 0.5f), number("variation", 0.f)});
  const auto flat = make_texture<Rgb>("marble", {number("variation", 0.f)});
  expect_near(wide->evaluate(at_point(2.f * p)), flat->evaluate(at_point(p)));
}

// What a pixel covers is measured in the texture's space.
TEST(Solid, FootprintsLeaveOctavesOut) {
  Parameters p({}, {}, "texture", nullptr);
  p.set_transform(Transform::scale(dvec3(4.)));
  Hit hit = at_point({1.3f, 0.4f, 0.7f});
  EXPECT_EQ(TextureMapping3D(p).footprint(hit), 0.f);
  hit.footprint = 0.4f;
  EXPECT_NEAR(TextureMapping3D(p).footprint(hit), 0.1f, 1e-6f);
  // Along the surface only: what is stretched across it does not count.
  p.set_transform(Transform::scale(dvec3(4., 2., 0.01)));
  EXPECT_NEAR(TextureMapping3D(p).footprint(hit), 0.2f, 1e-6f);
  hit.footprint = 1.f;
  EXPECT_EQ(make_texture<float>("fbm")->evaluate(hit), 0.f);
  EXPECT_EQ(make_texture<float>("windy")->evaluate(hit), 0.f);
}

TEST(DirectionMix, FollowsTheNormal) {
  const auto mix = make_texture<float>("directionmix", {}, nullptr,
                                       Transform::rotate(90., {1., 0., 0.}));  // dir is +z
  Hit hit = at_uv(0.f, 0.f);
  EXPECT_NEAR(mix->evaluate(hit), 0.f, 1e-6f);
  hit.ng = {1.f, 0.f, 0.f};
  EXPECT_NEAR(mix->evaluate(hit), 1.f, 1e-6f);
  hit.ng = {0.8f, 0.f, -0.6f};
  EXPECT_NEAR(mix->evaluate(hit), 0.4f, 1e-6f);
  const auto colours =
      make_texture<Rgb>("directionmix", {rgb("tex1", 1.f, 0.f, 0.f), rgb("tex2", 0.f, 0.f, 1.f),
                                         floats(ParameterType::Vector3, "dir", {-3.f, 0.f, 0.f})});
  expect_near(colours->evaluate(hit), {0.8f, 0.f, 0.2f});
}

TEST(Procedural, RefusalsHaveAPlace) {
  const auto error = [](const char* type, ParameterSet set) {
    return error_of([&] { make_texture<float>(type, set); });
  };
  for (const std::string& message :
       {error("fbm", {integer("octaves", -1)}), error("wrinkled", {integer("octaves", 65)}),
        error("dots", {number("insde", 1.f)}), error("windy", {integer("octaves", 3)}),
        error("directionmix", {floats(ParameterType::Vector3, "dir", {0.f, 0.f, 0.f})}),
        error("bilerp", {texture("v00", "t")})})
    EXPECT_NE(message.find("test-scene:7:3"), std::string::npos) << message;
}

// A texture that has one form only says so where a scene asks for the other.
TEST(Procedural, MissingFormsAreErrors) {
  const auto error = [](const std::string& texture, const std::string& use) {
    return error_of([&] {
      build_text({.scene = "WorldBegin\n" + texture + "\nMaterial " + use + " Shape \"sphere\""});
    });
  };
  const std::string marble =
      error("Texture \"t\" \"float\" \"marble\"", "\"conductor\" \"texture roughness\" \"t\"");
  EXPECT_NE(marble.find("test-scene:2:1"), std::string::npos) << marble;
  EXPECT_NE(marble.find("spectrum texture only"), std::string::npos) << marble;
  const std::string cloud =
      error("Texture \"t\" \"spectrum\" \"fbm\"", "\"diffuse\" \"texture reflectance\" \"t\"");
  EXPECT_NE(cloud.find("float texture only"), std::string::npos) << cloud;
}

}  // namespace
}  // namespace pssmlt
