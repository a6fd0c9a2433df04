// pbrt-v3's format: how it is recognised, and everything but its materials.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/color/color_space.h"
#include "core/image/image.h"
#include "tests/support/read_v3.h"
#include "tests/support/render_text.h"
#include "tests/support/scene_fingerprint.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Floats = std::vector<float>;

// The dialect may look at everything and change nothing.
TEST(Dialect, LeavesTodaysScenesAlone) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(PSSMLT_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".txt" || entry.path().stem() == "suite") continue;
    std::vector<std::string> plain_log, log;
    const std::string path = entry.path().string();
    const SceneDescription plain = parse_file(path, &plain_log);
    const SceneDescription read = parse_file(path, &log, {.dialect = &pbrt_v3()});
    EXPECT_EQ(fingerprint(plain), fingerprint(read)) << path;
    EXPECT_EQ(plain_log, log) << path;
    EXPECT_EQ(plain.hash, read.hash);
    ++scenes;
  }
  EXPECT_GT(scenes, 5);
}

// Words that both formats have, with today's meaning.
TEST(Dialect, LeavesSharedWordsAlone) {
  const std::string scene = R"(
    Film "rgb" "float iso" 200 PixelFilter "gaussian" "float sigma" .4
    Sampler "halton" Integrator "path" "string lightsampler" "bvh"
    Camera "spherical" "string mapping" "equirectangular"
    WorldBegin
    TransformBegin TransformEnd
    MakeNamedMaterial "a" "string type" "conductor" "float roughness" .1
    Material "mix" "string materials" ["a" "a"] "float amount" .3
    Material "subsurface" "float eta" 1.3
    Texture "t" "spectrum" "scale" "texture tex" "u" "float scale" 2
    Texture "i" "float" "imagemap" "string filename" "x.png"
    LightSource "infinite" "string filename" "sky.exr" "float scale" 2
    LightSource "projection" "string filename" "slide.exr"
    AreaLightSource "diffuse" "blackbody L" 3000
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "point2 uv" [0 0 1 0 0 1]
    Shape "loopsubdiv" "integer levels" 2)";
  std::vector<std::string> log, plain_log;
  const SceneDescription plain = parse_string(scene, "old", "", &plain_log);
  EXPECT_EQ(fingerprint(plain), fingerprint(read_v3(scene, &log)));
  EXPECT_EQ(log, plain_log);
}

// What only v3 has stays an unknown parameter where nothing else is v3's.
TEST(Dialect, DropsNothingOfTodaysScenes) {
  const std::string scene =
      "Film \"rgb\" \"float scale\" 2 Sampler \"sobol\" \"integer dimensions\" 4"
      " Integrator \"sppm\" \"integer imagewritefrequency\" 4"
      " Camera \"realistic\" \"bool simpleweighting\" true"
      " WorldBegin LightSource \"point\" \"integer nsamples\" 2"
      " Texture \"t\" \"float\" \"checkerboard\" \"string aamode\" \"none\"";
  std::vector<std::string> log;
  EXPECT_EQ(fingerprint(parse_string(scene, "old")), fingerprint(read_v3(scene, &log)));
  EXPECT_TRUE(log.empty());
}

TEST(Dialect, OldSyntaxIsAnErrorWithoutIt) {
  for (const char* text :
       {"WorldBegin WorldEnd", "SurfaceIntegrator \"path\" WorldBegin",
        "Renderer \"sampler\" WorldBegin", "WorldBegin Material \"x\" \"color Kd\" [1 1 1]",
        "WorldBegin Texture \"t\" \"color\" \"uv\""}) {
    EXPECT_THROW(parse_string(text, "now"), Error) << text;
    EXPECT_NO_THROW(read_v3(text)) << text;
  }
  EXPECT_NE(complaint("WorldEnd Shape \"sphere\"").find("after the WorldEnd at old:2:1"),
            std::string::npos);
}

// What is declared again is meant by the uses that follow; today that is an error.
TEST(Dialect, NamesMayBeDeclaredAgain) {
  const std::string twice =
      "Texture \"t\" \"float\" \"constant\" \"float value\" 1"
      " Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 1 1]"
      " MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"texture reflectance\" \"t\""
      " NamedMaterial \"m\" Shape \"sphere\""
      " Texture \"t\" \"float\" \"constant\" \"float value\" 2"
      " MakeNamedMaterial \"m\" \"string type\" \"conductor\" \"texture roughness\" \"t\""
      " NamedMaterial \"m\" Shape \"sphere\" Shape \"sphere\" \"texture alpha\" \"t\"";
  const SceneDescription s = world_v3(twice);
  const auto& first = s.materials.at(s.shapes.at(0).material);
  const auto& second = s.materials.at(s.shapes.at(1).material);
  EXPECT_EQ(text(first, "reflectance"), "t");
  EXPECT_EQ(second.type, "conductor");
  const std::string name = text(second, "roughness");
  EXPECT_NE(name, "t");
  EXPECT_EQ(text(s.shapes.at(2), "alpha"), name);
  int forms = 0;
  for (const TextureDescription& t : s.textures) {
    forms += t.name == name;
    if (t.name == name && t.value == TextureValue::Float) {
      EXPECT_EQ(number(t, "value"), 2.f);
    }
  }
  EXPECT_EQ(forms, 2);  // the other form goes by the new name as well
  try {
    read_v3("WorldBegin " + twice);
    ADD_FAILURE() << "today's scenes declare names once";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("already defined at old:1:"), std::string::npos);
  }
}

// XYZ of the white is white.
TEST(Dialect, XyzBecomesRgb) {
  const dvec3 white = glm::inverse(rec709_from_xyz()) * dvec3(0.5);
  const SceneDescription s = world_v3(fmt::format(
      "Material \"matte\" \"xyz Kd\" [{} {} {}] Shape \"sphere\"", white.x, white.y, white.z));
  for (const float v : numbers(s.materials.at(s.shapes.at(0).material), "reflectance"))
    EXPECT_NEAR(v, .5f, 1e-6f);
}

TEST(Dialect, FilmFilterAndDefaults) {
  std::vector<std::string> log;
  const SceneDescription s = read_v3(
      "Film \"image\" \"integer xresolution\" 8 \"float scale\" 2 Camera \"environment\""
      " \"float shutteropen\" 0 \"float shutterclose\" .5 Sampler \"lowdiscrepancy\""
      " \"integer pixelsamples\" 9 \"integer dimensions\" 4"
      " Integrator \"directlighting\" \"string strategy\" \"one\" WorldBegin WorldEnd",
      &log);
  EXPECT_EQ(s.film.type, "rgb");
  EXPECT_EQ(number(s.film, "iso"), 400.f);  // twice as bright, in half the time
  EXPECT_EQ(s.filter.type, "box");          // v3's default
  EXPECT_EQ(s.camera.type, "spherical");
  EXPECT_EQ(s.layers.at(0).sampler.type, "sobol");
  EXPECT_EQ(s.layers.at(0).sampler.parameters.size(), 1u);
  EXPECT_EQ(s.layers.at(0).integrator.type, "whitted");
  ASSERT_EQ(log.size(), 1u);
  EXPECT_EQ(log[0],
            "v3 dialect: 1 camera (environment); 1 film (image); 1 integrator (directlighting); "
            "1 sampler (lowdiscrepancy)");
  EXPECT_EQ(
      text(read_v3("Film \"image\" \"string filename\" \"a.tga\" WorldBegin").film, "filename"),
      "a.png");
  const SceneDescription g =
      read_v3("PixelFilter \"gaussian\" \"float xwidth\" 3 \"float alpha\" .5 WorldBegin WorldEnd");
  EXPECT_EQ(number(g.filter, "xradius"), 3.f);
  EXPECT_EQ(number(g.filter, "yradius"), 2.f);
  EXPECT_EQ(number(g.filter, "sigma"), 1.f);
  const SceneDescription p =
      read_v3("Integrator \"sppm\" \"integer numiterations\" 64 WorldBegin WorldEnd");
  EXPECT_EQ(parameter(p.layers.at(0).sampler, "pixelsamples")->ints.at(0), 64);
}

TEST(Dialect, LightsFoldTheirScales) {
  const SceneDescription s = world_v3(
      "LightSource \"point\" \"rgb I\" [1 2 3] \"rgb scale\" [2 2 2]"
      " LightSource \"distant\" \"rgb scale\" [1 .5 0] \"integer nsamples\" 4"
      " LightSource \"infinite\" \"string mapname\" \"sky.exr\" \"rgb L\" [3 3 3]"
      " AreaLightSource \"area\" \"blackbody L\" [5000 4] \"integer nsamples\" 2 Shape \"sphere\"");
  EXPECT_EQ(number(s.lights.at(0), "scale"), 2.f);
  EXPECT_EQ(numbers(s.lights.at(1), "L"), (Floats{1.f, .5f, 0.f}));
  EXPECT_EQ(text(s.lights.at(2), "filename"), "sky.exr");
  EXPECT_EQ(text(s.lights.at(2), "mapping"), "equirectangular");
  EXPECT_EQ(number(s.lights.at(2), "scale"), 3.f);
  EXPECT_EQ(s.area_lights.at(0).type, "diffuse");
  EXPECT_EQ(numbers(s.area_lights.at(0), "L"), (Floats{5000.f}));
  // The Planck curve's peak is 1: its mean under the eye's curve is a little less.
  EXPECT_NEAR(number(s.area_lights.at(0), "scale"), 4.f * .985f, .1f);
  EXPECT_EQ(parameter(s.area_lights.at(0), "nsamples"), nullptr);
  EXPECT_NE(complaint("LightSource \"infinite\" \"string mapname\" \"x\" \"rgb L\" [1 0 0]")
                .find("old:2:45: \"L\" of light \"infinite\" has a hue"),
            std::string::npos);
}

// v3's spectra are absolute: the constant spectrum 2 is a light of 2.
TEST(Dialect, EmissionSpectraAreAbsolute) {
  const SceneDescription s = world_v3("LightSource \"point\" \"spectrum I\" [300 2 900 2]");
  EXPECT_NEAR(number(s.lights.at(0), "scale"), 2.f, 1e-5f);
}

TEST(Dialect, TexturesShapesMedia) {
  const SceneDescription s = world_v3(
      "Texture \"i\" \"color\" \"imagemap\" \"bool gamma\" \"true\" \"string filename\" \"x.png\""
      " Texture \"s\" \"color\" \"scale\" \"texture tex1\" \"i\" \"rgb tex2\" [.5 .5 .5]"
      " MakeNamedMedium \"m\" \"string type\" \"heterogeneous\""
      " Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"float st\" [0 0 1 0 0 1]"
      " Shape \"loopsubdiv\" \"integer nlevels\" 2"
      " Shape \"heightfield\" \"integer nu\" 2 \"integer nv\" 3 \"float Pz\" [0 1 2 3 4 5]");
  EXPECT_EQ(text(s.textures.at(0), "filter"), "ewa");
  EXPECT_EQ(text(s.textures.at(0), "encoding"), "sRGB");
  EXPECT_EQ(text(s.textures.at(1), "tex"), "i");
  EXPECT_EQ(number(s.textures.at(1), "scale"), .5f);
  EXPECT_EQ(s.media.at(0).type, "uniformgrid");
  EXPECT_EQ(parameter(s.shapes.at(0), "uv")->type, ParameterType::Point2);
  EXPECT_EQ(parameter(s.shapes.at(1), "levels")->ints.at(0), 2);
  EXPECT_EQ(s.shapes.at(2).type, "trianglemesh");
  EXPECT_EQ(numbers(s.shapes.at(2), "P").size(), 18u);
  EXPECT_EQ(numbers(s.shapes.at(2), "P")[8], 2.f);
  EXPECT_NE(complaint("Shape \"nurbs\"").find("old:2:1: shape \"nurbs\""), std::string::npos);
  EXPECT_NE(complaint("Texture \"s\" \"color\" \"scale\" \"texture tex1\" \"i\""
                      " \"rgb tex2\" [1 0 0]")
                .find("a texture times a colour"),
            std::string::npos);
}

// A picture of the whole path: the same scene in both formats gives the same bits.
TEST(Dialect, RendersAsItsTranslation) {
  const TemporaryFolder folder;
  Image sky(8, 4, 3);
  for (size_t i = 0; i < sky.data.size(); ++i)
    sky.data[i] = 0.1f + 0.05f * static_cast<float>(i % 7);
  write_image((folder.path() / "sky.pfm").string(), sky, {}, {});
  const std::string camera =
      "\"integer xresolution\" 16 \"integer yresolution\" 12"
      " Sampler \"random\" Integrator \"path\" LookAt 1 2 -4 0 0 0 0 1 0 Camera \"perspective\"";
  const std::string old = "Film \"image\" " + camera +
                          " WorldBegin AttributeBegin Rotate -90 1 0 0 LightSource \"infinite\""
                          " \"string mapname\" \"sky.pfm\" AttributeEnd"
                          " Material \"matte\" \"color Kd\" [.2 .5 .7] Shape \"sphere\""
                          " Translate 2 0 0 Material \"glass\" Shape \"sphere\" WorldEnd";
  const std::string now = "Film \"rgb\" " + camera +
                          " PixelFilter \"box\" WorldBegin AttributeBegin Rotate -90 1 0 0"
                          " LightSource \"infinite\" \"string filename\" \"sky.pfm\""
                          " \"string mapping\" \"equirectangular\" AttributeEnd"
                          " Material \"diffuse\" \"rgb reflectance\" [.2 .5 .7] Shape \"sphere\""
                          " Translate 2 0 0 Material \"dielectric\" Shape \"sphere\"";
  BuildOptions options;
  options.defaults = default_plugins();
  RenderSettings settings;
  settings.spp = 4;
  settings.threads = 1;
  const std::string directory = folder.path().string();
  const auto picture = [&](const SceneDescription& scene) {
    return render(build_scene(scene, options), settings).image.data;
  };
  EXPECT_EQ(picture(read_v3(old, nullptr, directory)),
            picture(parse_string(now, "now", directory)));
}

}  // namespace
}  // namespace pssmlt
