// pbrt's Option directives: what they change, and what they leave alone.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/make_plugin.h"
#include "tests/support/render_text.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt::test {
namespace {

constexpr const char* frame = R"(
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
)";
constexpr const char* world = R"(
LookAt 1 2 -5  0 .5 0  0 1 0
Camera "perspective" "float fov" 40
Integrator "path" "integer maxdepth" 3
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ .1 .1 .1 ] "rgb sigma_s" [ .2 .2 .2 ]
Texture "checks" "spectrum" "checkerboard" "integer dimension" 3 "rgb tex1" [ .9 .9 .9 ]
  "rgb tex2" [ .1 .1 .1 ]
Material "diffuse" "texture reflectance" "checks"
Shape "sphere"
MediumInterface "fog" ""
Material "interface"
Shape "sphere" "float radius" 2
)";

// Positions round elsewhere, all else is the same: few of the samples take another way.
TEST(SceneOptions, RenderSpaceDoesNotShow) {
  const auto picture = [](const std::string& space) {
    const std::string option =
        space.empty() ? "" : "Option \"string rendercoordsys\" \"" + space + "\"\n";
    return render_text({.scene = option + frame + world, .sampler = "independent", .spp = 64}, 1);
  };
  const Image usual = picture("").image;
  for (const char* space : {"cameraworld", "camera", "world"}) {
    const Image image = picture(space).image;
    for (size_t i = 0; i < image.data.size(); ++i)
      EXPECT_NEAR(image.data[i], usual.data[i], .02f) << space;
  }
}

// The lamp's edge goes through the pixels, a third of the way from left to right.
TEST(SceneOptions, WithoutJitterPixelsAreTheirCentres) {
  const std::string scene = std::string(R"(Option "bool disablepixeljitter" true)") + frame + R"(
Camera "orthographic"
PixelFilter "gaussian"
Integrator "path" "integer maxdepth" 0
WorldBegin
AreaLightSource "diffuse" "bool twosided" true
Shape "bilinearmesh" "point3 P" [ -.08 -9 1  9 -9 1  -.08 9 1  9 9 1 ]
)";
  const Image image = render_text({.scene = scene, .sampler = "independent", .spp = 16}, 1).image;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(image.pixel(x, y)[0], x < 4 ? 0.f : 1.f) << x;
}

TEST(SceneOptions, EdgesOfDisplacedMeshesScale) {
  const std::string file = own_file("options.ply");
  std::ofstream(file) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                         "property float y\nproperty float z\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n"
                         "0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n";
  const auto triangles = [&](const std::string& option, const std::string& edge) {
    return build_text({.scene = option + frame +
                                "WorldBegin Texture \"h\" \"float\" \"constant\"\n" +
                                "Shape \"plymesh\" \"string filename\" \"" + file +
                                "\" \"texture displacement\" \"h\" " + edge})
        .scene->features()
        .triangles;
  };
  const std::string half = "Option \"float displacementedgescale\" .5\n";
  EXPECT_EQ(triangles(half, ""), triangles("", "\"float displacement.edgelength\" .5"));
  EXPECT_EQ(triangles(half, "\"float displacement.edgelength\" 2"), triangles("", ""));
  EXPECT_LT(triangles("", ""), triangles(half, ""));
}

TEST(SceneOptions, WrongValuesAreErrors) {
  const auto message = [](const std::string& option, const std::string& camera = "") {
    return error_of([&] { build_text({.scene = "Option " + option + "\n" + camera + world}); });
  };
  EXPECT_NE(message("\"string rendercoordsys\" \"film\"").find("cameraworld"), std::string::npos);
  EXPECT_NE(message("\"float displacementedgescale\" 0").find("positive"), std::string::npos);
  EXPECT_NE(message("\"integer disablepixeljitter\" 1").find("one bool"), std::string::npos);
  EXPECT_NE(message("\"string rendercoordsys\" \"camera\"", "Scale 2 2 2\n").find("scaled"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt::test
