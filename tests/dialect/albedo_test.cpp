// Translated materials reflect what v3's do: a sphere under a sky of radiance 1, seen in parallel,
// shows the mean albedo of its material over all directions of view.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/read_v3.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {

using namespace test;

// Reflectance of glass of index 1.5 to diffuse light.
constexpr double mean_fresnel = 0.0918;

double albedo(const std::string& material) {
  const SceneDescription scene = read_v3(
      "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32 Sampler \"stratified\""
      " Integrator \"path\" \"integer maxdepth\" 1 LookAt 0 0 -3 0 0 0 0 1 0"
      " Camera \"orthographic\" WorldBegin LightSource \"infinite\" " +
      material + " Shape \"sphere\" WorldEnd");
  BuildOptions options;
  options.defaults = default_plugins();
  RenderSettings settings;
  settings.spp = 64;
  settings.threads = 2;
  const Image image = render(build_scene(scene, options), settings).image;
  double sum = 0.0;
  for (const float v : image.data) sum += static_cast<double>(v);
  const double disk = std::numbers::pi / 4.0;  // of the picture; the rest is sky
  return (sum / static_cast<double>(image.data.size()) - (1.0 - disk)) / disk;
}

TEST(V3Albedo, OfPlasticIsTheSumOfItsLobes) {
  const std::string smooth = " \"float roughness\" 0 \"bool remaproughness\" \"false\"";
  EXPECT_NEAR(albedo("Material \"matte\" \"rgb Kd\" [.3 .3 .3]"), 0.3, 4e-3);
  EXPECT_NEAR(albedo("Material \"plastic\" \"rgb Kd\" [.3 .3 .3] \"rgb Ks\" [.6 .6 .6]" + smooth),
              0.3 + 0.6 * mean_fresnel, 6e-3);
  EXPECT_NEAR(albedo("Material \"uber\" \"rgb Kd\" [.3 .3 .3] \"rgb Ks\" [1 1 1]" + smooth),
              0.3 + mean_fresnel, 6e-3);
  // A rough coat loses what it shadows of its own lobe; the base is seen in full.
  const double rough = albedo("Material \"plastic\" \"rgb Kd\" [.3 .3 .3] \"rgb Ks\" [1 1 1]");
  EXPECT_GT(rough, 0.3);
  EXPECT_LT(rough, 0.3 + mean_fresnel + 6e-3);
}

// By the texture "undercoat" as by the constant.
TEST(V3Albedo, OfTexturesIsThatOfConstants) {
  const std::string rest = " \"rgb Ks\" [1 1 1] \"float roughness\" .05";
  const double constant = albedo("Material \"plastic\" \"rgb Kd\" [.4 .4 .4]" + rest);
  const double textured = albedo(
      "Texture \"t\" \"color\" \"constant\" \"rgb value\" [.4 .4 .4]"
      " Material \"plastic\" \"texture Kd\" \"t\"" +
      rest);
  EXPECT_NEAR(textured, constant, 1e-5);
}

TEST(V3Albedo, OfSubstrateAndMirror) {
  EXPECT_NEAR(albedo("Material \"substrate\" \"rgb Kd\" [.5 .5 .5] \"rgb Ks\" [.04 .04 .04]"
                     " \"float uroughness\" 0 \"float vroughness\" 0"
                     " \"bool remaproughness\" \"false\""),
              0.5 * 0.96 + mean_fresnel, 6e-3);
  EXPECT_NEAR(albedo("Material \"mirror\" \"rgb Kr\" [1 1 1]"), 1.0, 6e-3);
}

}  // namespace
}  // namespace pssmlt
