// Well-formed scenes: what every directive leaves in the description.
#include "core/scene/parser.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace pssmlt {
namespace {

namespace fs = std::filesystem;

SceneDescription parse(const std::string& text) { return parse_string(text, "scene"); }
SceneDescription world(const std::string& text) { return parse("WorldBegin\n" + text); }

const Parameter& find(const ParameterSet& set, std::string_view name) {
  const auto found = std::ranges::find(set, name, &Parameter::name);
  if (found == set.end()) throw std::out_of_range(std::string(name));
  return *found;
}

void expect_point(const Transform& t, const dvec3& from, const dvec3& to) {
  const dvec3 p = t.point(from);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(p[i], to[i], 1e-12) << "component " << i;
}

// A folder of files for one test.
class Files {
 public:
  Files()
      : folder_(fs::temp_directory_path() /
                ("pssmlt_parser_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Files() { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::string pack(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    const gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path;
  }

 private:
  fs::path folder_;
};

TEST(Parser, NoAreaLightEndsEmission) {
  const SceneDescription s =
      world("AreaLightSource \"diffuse\" Shape \"sphere\" AreaLightSource \"\" Shape \"sphere\"");
  EXPECT_EQ(s.shapes.at(0).area_light, 0);
  EXPECT_EQ(s.shapes.at(1).area_light, -1);
}

TEST(Parser, OptionsBlock) {
  const SceneDescription s = parse(R"(
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective" "float fov" 37.5
    Film "rgb" "integer xresolution" [ 640 ] "string filename" "a.exr"
    PixelFilter "mitchell" "float B" [0.25]
    Accelerator "bvh"
    Sampler "pssmlt" "integer mutationsperpixel" 100
    Integrator "bdpt" "integer maxdepth" 7 "bool visible" true "bool other" "false"
    Option "seed" 7  Option "Render-Coord_Sys" "world" Option "float displacementedgescale" 2
    WorldBegin)");
  EXPECT_EQ(s.camera.type, "perspective");
  EXPECT_EQ(find(s.camera.parameters, "fov").floats, std::vector<float>{37.5f});
  expect_point(s.camera.transform.start, {0, 0, -5}, {0, 0, 0});
  EXPECT_FALSE(s.camera.transform.animated());
  expect_point(s.coordinate_systems.at("camera").start, {0, 0, 0}, {0, 0, -5});
  EXPECT_EQ(find(s.film.parameters, "filename").strings[0], "a.exr");
  EXPECT_EQ(s.filter.type, "mitchell");
  EXPECT_EQ(s.accelerator.type, "bvh");
  ASSERT_EQ(s.layers.size(), 1u);
  EXPECT_EQ(s.layers[0].name, "");
  EXPECT_EQ(s.layers[0].sampler.type, "pssmlt");
  EXPECT_EQ(s.layers[0].integrator.type, "bdpt");
  EXPECT_EQ(find(s.layers[0].integrator.parameters, "visible").bools[0], 1);
  EXPECT_EQ(find(s.layers[0].integrator.parameters, "other").bools[0], 0);
  EXPECT_EQ(find(s.options, "seed").ints[0], 7);
  EXPECT_EQ(find(s.options, "rendercoordsys").strings[0], "world");
  EXPECT_EQ(find(s.options, "displacementedgescale").floats[0], 2.f);
}

TEST(Parser, WhatIsNotGivenSaysSo) {
  const SceneDescription s = parse("WorldBegin");
  EXPECT_FALSE(s.film.given());
  EXPECT_FALSE(s.camera.given());
  ASSERT_EQ(s.layers.size(), 1u);
  EXPECT_FALSE(s.layers[0].sampler.given());
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_EQ(s.materials[0].type, "");
}

TEST(Parser, TheLastOfTwoIntegratorsWins) {
  EXPECT_EQ(parse("Integrator \"path\" Integrator \"bdpt\" WorldBegin").layers[0].integrator.type,
            "bdpt");
}

TEST(Parser, Layers) {
  const SceneDescription s = parse(R"(
    Integrator "path"
    LayerBegin "direct" "float weight" 1  Sampler "sobol" Integrator "direct" LayerEnd
    LayerBegin "rest" Sampler "pssmlt" LayerEnd
    WorldBegin)");
  ASSERT_EQ(s.layers.size(), 2u);
  EXPECT_EQ(s.layers[0].name, "direct");
  EXPECT_EQ(s.layers[0].parameters.size(), 1u);
  EXPECT_EQ(s.layers[0].sampler.type, "sobol");
  EXPECT_EQ(s.layers[0].integrator.type, "direct");
  EXPECT_EQ(s.layers[1].sampler.type, "pssmlt");
  EXPECT_EQ(s.layers[1].integrator.type, "path");
}

TEST(Parser, EveryParameterType) {
  const SceneDescription s = world(R"(Shape "x"
    "integer i" [1 -2 +3] "float f" 1 "point2 p2" [1 2] "vector2 v2" [1 2 3 4]
    "point3 p3" [1 2 3] "point p" [1 2 3] "vector3 v3" [1 2 3] "vector v" [1 2 3]
    "normal n" [0 0 1] "normal3 m" [0 0 1] "bool b" [true false] "string s" ["a" "b"]
    "texture t" "wood" "spectrum named" "metal-Au-eta" "spectrum inline" [400 1 700 2]
    "rgb c" [1 .5 0] "blackbody k" 5500 "float empty" [])");
  const ParameterSet& p = s.shapes.at(0).parameters;
  EXPECT_EQ(find(p, "i").ints, (std::vector<int>{1, -2, 3}));
  EXPECT_EQ(find(p, "p").type, ParameterType::Point3);
  EXPECT_EQ(find(p, "v").type, ParameterType::Vector3);
  EXPECT_EQ(find(p, "m").type, ParameterType::Normal);
  EXPECT_EQ(find(p, "v2").floats.size(), 4u);
  EXPECT_EQ(find(p, "b").bools, (std::vector<uint8_t>{1, 0}));
  EXPECT_EQ(find(p, "s").strings, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(find(p, "t").type, ParameterType::Texture);
  EXPECT_EQ(find(p, "named").strings[0], "metal-Au-eta");
  EXPECT_EQ(find(p, "inline").floats, (std::vector<float>{400, 1, 700, 2}));
  EXPECT_EQ(find(p, "c").floats, (std::vector<float>{1.f, .5f, 0.f}));
  EXPECT_TRUE(find(p, "empty").floats.empty());
  EXPECT_EQ(to_string(find(p, "f").where), "scene:3:27");
}

TEST(Parser, TransformsComposeFromTheRight) {
  const SceneDescription s = world(R"(
    Translate 1 2 3  Scale 2 2 2  Shape "a"
    Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  7 8 9 1 ]  Shape "b"
    ConcatTransform [ 0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1 ]  Shape "c"
    Identity  Rotate 90 0 0 1  Shape "d"
    CoordSysTransform "world" Shape "e")");
  expect_point(s.shapes[0].transform.start, {1, 1, 1}, {3, 4, 5});
  expect_point(s.shapes[1].transform.start, {0, 0, 0}, {7, 8, 9});  // file order is by columns
  expect_point(s.shapes[2].transform.start, {1, 0, 0}, {7, 9, 9});
  expect_point(s.shapes[3].transform.start, {1, 0, 0}, {0, 1, 0});
  expect_point(s.shapes[4].transform.start, {1, 2, 3}, {1, 2, 3});
}

TEST(Parser, WorldBeginResetsTheTransformation) {
  const SceneDescription s = parse(
      "Translate 1 0 0 ActiveTransform StartTime WorldBegin "
      "Translate 0 1 0 Shape \"a\"");
  expect_point(s.shapes[0].transform.start, {0, 0, 0}, {0, 1, 0});
  EXPECT_FALSE(s.shapes[0].transform.animated());
}

TEST(Parser, ActiveTransformMakesMotion) {
  const SceneDescription s = parse(R"(TransformTimes 0.25 0.75 Camera "perspective" WorldBegin
    AttributeBegin
      ActiveTransform EndTime Translate 0 0 5 ActiveTransform All Translate 1 0 0 Shape "a"
    AttributeEnd
    Shape "b")");
  EXPECT_EQ(s.camera.start_time, 0.25f);
  EXPECT_EQ(s.camera.end_time, 0.75f);
  ASSERT_TRUE(s.shapes[0].transform.animated());
  expect_point(s.shapes[0].transform.start, {0, 0, 0}, {1, 0, 0});
  expect_point(*s.shapes[0].transform.end, {0, 0, 0}, {1, 0, 5});
  EXPECT_FALSE(s.shapes[1].transform.animated());
}

TEST(Parser, SingularTransformsOverNothingAreLetPass) {
  const SceneDescription s = world(R"(
    AttributeBegin Scale 0 1 1 Translate 1 0 0 Material "diffuse" AttributeEnd
    Translate 2 0 0 Shape "a")");
  expect_point(s.shapes[0].transform.start, {0, 0, 0}, {2, 0, 0});
}

TEST(Parser, AttributesNest) {
  const SceneDescription s = world(R"(
    MakeNamedMedium "fog" "string type" "homogeneous"
    Material "conductor"
    AttributeBegin
      Material "dielectric" ReverseOrientation MediumInterface "fog" ""
      AreaLightSource "diffuse" "rgb L" [1 1 1]
      Shape "a"
    AttributeEnd
    Shape "b")");
  const ShapeDescription& a = s.shapes[0];
  const ShapeDescription& b = s.shapes[1];
  EXPECT_EQ(s.materials[a.material].type, "dielectric");
  EXPECT_TRUE(a.reverse_orientation);
  EXPECT_EQ(a.inside_medium, "fog");
  EXPECT_EQ(a.outside_medium, "");
  EXPECT_EQ(a.area_light, 0);
  EXPECT_EQ(s.materials[b.material].type, "conductor");
  EXPECT_FALSE(b.reverse_orientation);
  EXPECT_EQ(b.inside_medium, "");
  EXPECT_EQ(b.area_light, -1);
}

TEST(Parser, TransformBeginSavesTransformationsAlone) {
  std::vector<std::string> log;
  const SceneDescription s = parse_string(R"(WorldBegin TransformBegin Translate 1 0 0
    Material "conductor" TransformEnd Shape "a")",
                                          "scene", "", &log);
  EXPECT_EQ(s.materials[s.shapes[0].material].type, "conductor");
  expect_point(s.shapes[0].transform.start, {0, 0, 0}, {0, 0, 0});
  ASSERT_EQ(log.size(), 1u);
  EXPECT_NE(log[0].find("scene:1:12: TransformBegin"), std::string::npos);
}

TEST(Parser, AttributeGivesDefaults) {
  const SceneDescription s = world(R"(
    Attribute "shape" "float alpha" 0.5 "float radius" 3
    AttributeBegin Attribute "shape" "float radius" 4 Shape "a" AttributeEnd
    Shape "b" "float radius" 9
    Attribute "light" "float scale" 2  LightSource "point"
    Attribute "material" "float roughness" 0.25  Material "conductor"
    Attribute "texture" "float uscale" 3  Texture "t" "float" "scale"
    Attribute "medium" "string type" "uniformgrid"  MakeNamedMedium "m")");
  EXPECT_EQ(find(s.shapes[0].parameters, "radius").floats[0], 4.f);
  EXPECT_EQ(find(s.shapes[1].parameters, "radius").floats[0], 9.f);
  EXPECT_EQ(s.shapes[1].parameters.size(), 2u);
  EXPECT_TRUE(find(s.shapes[1].parameters, "alpha").was_read);  // need not suit every shape
  EXPECT_FALSE(find(s.shapes[1].parameters, "radius").was_read);
  EXPECT_EQ(find(s.lights[0].parameters, "scale").floats[0], 2.f);
  EXPECT_EQ(find(s.materials[1].parameters, "roughness").floats[0], 0.25f);
  EXPECT_EQ(find(s.textures[0].parameters, "uscale").floats[0], 3.f);
  EXPECT_EQ(s.media[0].type, "uniformgrid");
}

TEST(Parser, NamedMaterialsMayFollowTheirUse) {
  const SceneDescription s = world(R"(
    NamedMaterial "late" Shape "a"
    ObjectBegin "o" Shape "b" ObjectEnd
    MakeNamedMaterial "early" "string type" "conductor" "float k" 1
    NamedMaterial "early" Shape "c"
    MakeNamedMaterial "late" "string type" "dielectric")");
  EXPECT_EQ(s.materials[s.shapes[0].material].name, "late");
  EXPECT_EQ(s.materials[s.objects[0].shapes[0].material].type, "dielectric");
  EXPECT_EQ(s.materials[s.shapes[1].material].name, "early");
  EXPECT_EQ(find(s.materials[1].parameters, "k").floats[0], 1.f);
  EXPECT_EQ(s.materials[1].parameters.size(), 1u);  // "type" has become the directive's type
}

TEST(Parser, ObjectsAndInstances) {
  const SceneDescription s = world(R"(
    Translate 1 0 0
    ObjectBegin "o" Translate 0 1 0 Shape "a" ObjectEnd
    Translate 0 0 1 ObjectInstance "o"
    ObjectInstance "p"
    ObjectBegin "p" Translate 0 2 0 ObjectInstance "o" ObjectEnd)");
  ASSERT_EQ(s.objects.size(), 2u);
  EXPECT_TRUE(s.shapes.empty());
  expect_point(s.objects[0].shapes[0].transform.start, {0, 0, 0}, {1, 1, 0});
  ASSERT_EQ(s.instances.size(), 2u);
  EXPECT_EQ(s.instances[0].object, 0u);
  EXPECT_EQ(s.instances[1].object, 1u);
  ASSERT_EQ(s.objects[1].instances.size(), 1u);
  EXPECT_EQ(s.objects[1].instances[0].object, 0u);
  expect_point(s.objects[1].instances[0].transform.start, {0, 0, 0}, {1, 2, 1});
  expect_point(s.instances[0].transform.start, {0, 0, 0}, {1, 0, 1});
}

TEST(Parser, TexturesKeepTheirOrder) {
  const SceneDescription s = world(R"(
    Texture "t" "float" "constant" "float value" 2
    Translate 1 0 0
    Texture "t" "spectrum" "scale" "texture tex" "t")");
  ASSERT_EQ(s.textures.size(), 2u);
  EXPECT_EQ(s.textures[0].value, TextureValue::Float);
  EXPECT_EQ(s.textures[1].value, TextureValue::Spectrum);
  EXPECT_EQ(s.textures[1].type, "scale");
  expect_point(s.textures[1].transform.start, {0, 0, 0}, {1, 0, 0});
}

TEST(Parser, MediaOfCameraAndLights) {
  const SceneDescription s = parse(R"(
    MakeNamedMedium "fog" "string type" "homogeneous"
    MediumInterface "" "fog" Camera "perspective"
    WorldBegin LightSource "point" MediumInterface "fog" LightSource "spot" Shape "a")");
  EXPECT_EQ(s.camera.medium, "fog");
  EXPECT_EQ(s.lights[0].medium, "fog");
  EXPECT_EQ(s.shapes[0].inside_medium, "fog");
  EXPECT_EQ(s.shapes[0].outside_medium, "fog");
}

TEST(Parser, ColorSpaceBelongsToTheParametersBelowIt) {
  const SceneDescription s = parse(R"(ColorSpace "rec2020" Film "rgb" WorldBegin
    LightSource "point" "rgb I" [1 1 1]
    AttributeBegin ColorSpace "ACES2065-1" LightSource "point" "rgb I" [1 1 1] AttributeEnd
    LightSource "point" "rgb I" [1 1 1])");
  EXPECT_EQ(s.color_space, "rec2020");
  EXPECT_EQ(*s.lights[0].parameters[0].color_space, "rec2020");
  EXPECT_EQ(*s.lights[1].parameters[0].color_space, "aces2065-1");
  EXPECT_EQ(*s.lights[2].parameters[0].color_space, "rec2020");
}

TEST(Parser, NamedCoordinateSystems) {
  const SceneDescription s = world(R"(
    Translate 1 0 0 CoordinateSystem "here" Identity Shape "a"
    CoordSysTransform "here" Shape "b")");
  expect_point(s.shapes[1].transform.start, {0, 0, 0}, {1, 0, 0});
}

TEST(Parser, IncludeIsTextualAndRelativeToTheFirstFile) {
  const Files files;
  files.write("sub/b.pbrt", "Translate 1 0 0 Include \"sub/c.pbrt\"\n");
  files.write("sub/c.pbrt", "Shape \"c\"");
  const auto path = files.write("a.pbrt", "WorldBegin Include \"sub/b.pbrt\" Shape \"d\"\n");
  const SceneDescription s = parse_file(path, nullptr);
  ASSERT_EQ(s.shapes.size(), 2u);
  expect_point(s.shapes[1].transform.start, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(fs::path(*s.shapes[0].where.file).filename(), "c.pbrt");
  EXPECT_EQ(s.files_read.size(), 3u);
}

TEST(Parser, ImportLeavesDeclarationsButNoState) {
  const Files files;
  files.write("b.pbrt",
              "Translate 1 0 0 Material \"conductor\" Shape \"b\" "
              "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"");
  const auto path = files.write("a.pbrt",
                                "WorldBegin Translate 0 1 0 Import \"b.pbrt\" "
                                "Shape \"a\" NamedMaterial \"m\" Shape \"c\"");
  const SceneDescription s = parse_file(path, nullptr);
  expect_point(s.shapes[0].transform.start, {0, 0, 0}, {1, 1, 0});
  expect_point(s.shapes[1].transform.start, {0, 0, 0}, {0, 1, 0});
  EXPECT_EQ(s.shapes[1].material, 0u);
  EXPECT_EQ(s.materials[s.shapes[2].material].name, "m");
}

TEST(Parser, GzipWhateverTheName) {
  const Files files;
  const std::string text = "WorldBegin Shape \"a\"";
  const SceneDescription plain = parse_file(files.write("a.pbrt", text), nullptr);
  const SceneDescription packed = parse_file(files.pack("b.pbrt.gz", text), nullptr);
  EXPECT_EQ(packed.shapes.size(), 1u);
  EXPECT_EQ(plain.hash, packed.hash);
  EXPECT_EQ(parse_file(files.pack("c.pbrt", text), nullptr).shapes.size(), 1u);
  const auto bad = files.pack("bad.pbrt", "WorldBegin\nShap \"a\"");
  try {
    parse_file(bad, nullptr);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.what(), bad +
                            ":2:1: unknown directive 'Shap' (did you mean 'Shape'?)\n"
                            "  Shap \"a\"\n  ^");
  }
  const auto cut = files.write("cut.gz", "\x1f\x8b\x08");
  EXPECT_THROW(parse_file(cut, nullptr), Error);
}

TEST(Parser, HashTellsScenesApart) {
  const auto hash = [](const std::string& text) { return world(text).hash; };
  EXPECT_EQ(hash("Shape \"a\""), hash("Shape \"a\""));
  EXPECT_NE(hash("Shape \"a\""), hash("Shape \"b\""));
  EXPECT_NE(hash(""), hash(" "));
}

TEST(Parser, ArraysLongerThanAnyBuffer) {
  std::string text = "Shape \"a\" \"point3 P\" [";
  for (int i = 0; i < 30000; ++i) text += (i % 7 == 0 ? "\n" : " ") + std::to_string(i) + ".5";
  const SceneDescription s = world(text + "] # end");
  const auto& values = s.shapes[0].parameters[0].floats;
  ASSERT_EQ(values.size(), 30000u);
  EXPECT_EQ(values[29999], 29999.5f);
}

}  // namespace
}  // namespace pssmlt
