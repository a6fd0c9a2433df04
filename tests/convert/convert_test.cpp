// pssmlt convert: what is written reads back as the same scene and renders to the same bits.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/convert/directive_text.h"
#include "app/convert/scene_text.h"
#include "tests/bad_input/run_program.h"
#include "tests/support/read_v3.h"
#include "tests/support/render_text.h"
#include "tests/support/scene_fingerprint.h"

namespace pssmlt {
namespace {

using namespace test;

SceneDescription read(const std::string& path) {
  return parse_file(path, nullptr, {.dialect = &pbrt_v3(), .keep_steps = true});
}

std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(fs::path(PSSMLT_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".txt" && entry.path().stem() != "suite")
      files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

std::vector<float> small_picture(const SceneDescription& scene) {
  BuildOptions options;
  options.defaults = default_plugins();
  options.sampler = "independent";
  options.size = ivec2(12, 8);
  RenderSettings settings;
  settings.spp = 2;
  settings.threads = 1;
  return render(build_scene(scene, options), settings).image.data;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream all;
  all << in.rdbuf();
  return all.str();
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

// In the folder of the scene, so that names of files stay; and from another one, where they change.
TEST_P(EveryScene, ReadsBackAndRendersAlike) {
  const SceneDescription scene = read(GetParam());
  const std::string text = scene_text(scene, fs::path(GetParam()).parent_path());
  const SceneDescription again = parse_string(text, "again", scene.directory);
  EXPECT_EQ(fingerprint(again, material_names(scene)), fingerprint(scene)) << text.substr(0, 3000);
  const TemporaryFolder folder;
  folder.write("sub/new.txt", scene_text(scene, folder.path() / "sub"));
  const SceneDescription moved = parse_file((folder.path() / "sub/new.txt").string(), nullptr);
  EXPECT_EQ(small_picture(moved), small_picture(scene));
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, ::testing::ValuesIn(scene_files()),
                         [](const auto& file) {
                           std::string name = fs::path(file.param).stem().string();
                           std::erase(name, '-');
                           return name;
                         });

// All of the graphics state: steps, motion, attributes, spaces, layers, objects, media.
constexpr const char* rich = R"(
Option "integer seed" 7
ColorSpace "rec2020"
Film "rgb" "string filename" "a \"b\".exr" "integer xresolution" 20
PixelFilter "mitchell" "float B" 0.1
Accelerator "kdtree"
TransformTimes 0.25 0.75
Translate 0.1 1e-7 -3.3333333333333335
ActiveTransform EndTime Rotate 12.5 0 1 0 ActiveTransform All
MediumInterface "" "fog"
Camera "perspective" "float fov" 33.3333
Sampler "stratified" "bool jitter" false
LayerBegin "one" Integrator "path" "integer maxdepth" 1 LayerEnd
LayerBegin "two" Sampler "sobol" Integrator "bdpt" LayerEnd
WorldBegin
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [.1 .2 .3]
MediumInterface "" ""
Attribute "shape" "float radius" .3
CoordinateSystem "here"
Texture "t" "float" "constant" "float value" 0.1
AttributeBegin
  Translate 1 2 3
  Texture "solid" "spectrum" "marble"
AttributeEnd
MakeNamedMaterial "shiny" "string type" "conductor" "spectrum eta" "metal-Au-eta"
Material "diffuse" "rgb reflectance" [.1 .2 .3]
ColorSpace "srgb"
AttributeBegin
  Scale 1 2 3
  CoordSysTransform "camera"
  LightSource "point" "blackbody I" 3000
  Identity
  Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  4 5 6 1 ]
  ConcatTransform [ 0 1 0 0  1 0 0 0  0 0 1 0  0 0 0 1 ]
  ReverseOrientation
  MediumInterface "fog" ""
  AreaLightSource "diffuse" "spectrum L" [400 1 700 .5]
  Shape "sphere"
  CoordSysTransform "here"
  NamedMaterial "shiny"
  Shape "disk" "texture alpha" "t"
AttributeEnd
Shape "sphere"
ObjectBegin "thing"
  Material "diffuse" "rgb reflectance" [.5 .5 .5]
  Shape "sphere"
  Translate 0 0 1
  Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1e-8 0 0 0 1 0]
    "normal N" [0 0 1 0 0 1 0 0 1]
ObjectEnd
AttributeBegin
  LookAt 1 2 3 0 0 0 0 1 0
  ObjectInstance "thing"
AttributeEnd
ObjectBegin "pair"
  Rotate 10 0 1 0
  ObjectInstance "thing"
  Scale 1 2 1
  ObjectInstance "thing"
ObjectEnd
ObjectInstance "pair"
)";

TEST(Convert, KeepsTheGraphicsState) {
  const SceneDescription scene =
      parse_string(rich, "rich", "", nullptr, {.dialect = nullptr, .keep_steps = true});
  const std::string text = scene_text(scene, "");
  const SceneDescription again = parse_string(text, "again");
  // "radius" by Attribute is left out where no plugin knows it.
  EXPECT_NE(text.find("Shape \"sphere\" \"float radius\" 0.3"), std::string::npos) << text;
  EXPECT_EQ(text.find("Shape \"trianglemesh\" \"float radius\""), std::string::npos) << text;
  SceneDescription expected = scene;
  std::erase_if(expected.objects.at(0).shapes.at(1).parameters,
                [](const Parameter& p) { return p.was_read; });
  EXPECT_EQ(fingerprint(again, material_names(scene)), fingerprint(expected)) << text;
}

TEST(Convert, OldScenesBecomeToday) {
  const std::string old = R"(
    Film "image" "integer xresolution" 16 "integer yresolution" 12 "float scale" 1.5
    LookAt 0 1 -5 0 0 0 0 1 0 Camera "perspective"
    WorldBegin
    LightSource "point" "rgb I" [9 9 9] "rgb scale" [2 2 2] "point from" [1 4 -3]
    Texture "w" "color" "checkerboard" "rgb tex1" [.1 .2 .3] "rgb tex2" [.7 .6 .5]
    Material "plastic" "texture Kd" "w" "rgb Ks" [.3 .3 .3]
    Shape "sphere"
    Material "uber" "rgb opacity" [.5 .5 .5]
    Translate 1.5 0 0 Shape "sphere"
    WorldEnd)";
  const SceneDescription scene =
      parse_string(old, "old", "", nullptr, {.dialect = &pbrt_v3(), .keep_steps = true});
  const std::string text = scene_text(scene, "");
  const SceneDescription again = parse_string(text, "again");  // no dialect
  EXPECT_EQ(fingerprint(again, material_names(scene)), fingerprint(scene)) << text;
  EXPECT_EQ(small_picture(again), small_picture(scene));
}

TEST(Convert, NamesFilesFromTheNewPlace) {
  const TemporaryFolder folder;
  folder.write("old/mesh/a.ply", "ply\n");
  folder.write("old/metal.spd", "400 1\n");
  folder.write("old/part.txt", "Shape \"plymesh\" \"string filename\" \"mesh/a.ply\"\n");
  folder.write("old/scene.txt",
               "WorldBegin Material \"conductor\" \"spectrum eta\" \"metal.spd\""
               " \"spectrum k\" \"metal-Cu-k\" Include \"part.txt\"\n");
  const ProgramResult result = run_program({"convert", "old/scene.txt", "new.txt"}, folder);
  EXPECT_EQ(result.exit_code, 0) << result.text;
  const std::string text = text_of(folder.path() / "new.txt");
  EXPECT_NE(text.find("\"old/mesh/a.ply\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"old/metal.spd\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"metal-Cu-k\""), std::string::npos) << text;
}

TEST(Convert, OverwritesOnlyIfTold) {
  const TemporaryFolder folder;
  folder.write("a.txt", "WorldBegin Shape \"sphere\"\n");
  folder.write("b.txt", "keep\n");
  ProgramResult result = run_program({"convert", "a.txt", "b.txt"}, folder);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("--force"), std::string::npos) << result.text;
  EXPECT_EQ(text_of(folder.path() / "b.txt"), "keep\n");
  EXPECT_EQ(run_program({"convert", "a.txt", "b.txt", "--force"}, folder).exit_code, 0);
  EXPECT_NE(text_of(folder.path() / "b.txt").find("Shape \"sphere\""), std::string::npos);
  result = run_program({"convert", "a.txt", "a.txt", "--force"}, folder);
  EXPECT_EQ(result.exit_code, 2) << result.text;
  EXPECT_EQ(text_of(folder.path() / "a.txt"), "WorldBegin Shape \"sphere\"\n");
  folder.write("bad.txt", "WorldBegin Shape \"nurbs\"\n");
  result = run_program({"convert", "bad.txt", "c.txt"}, folder);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.text.find("bad.txt:1:12: shape \"nurbs\""), std::string::npos) << result.text;
  EXPECT_FALSE(fs::exists(folder.path() / "c.txt"));
}

// Chains of many steps end without recursion.
TEST(Convert, ManyStepsEnd) {
  std::string text = "WorldBegin ";
  for (int i = 0; i < 300'000; ++i) text += "Translate 0 0 0\n";
  const SceneDescription scene =
      parse_string(text + "Shape \"sphere\"", "deep", "", nullptr, {.keep_steps = true});
  EXPECT_NE(scene.shapes.at(0).transform.steps, nullptr);
}

TEST(Convert, QuotesStrings) { EXPECT_EQ(in_quotes("a\"b\\\n"), "\"a\\\"b\\\\\\n\""); }

}  // namespace
}  // namespace pssmlt
