#include "core/render/output.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/render/auxiliary.h"
#include "tests/core/render/session_support.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

Image filled(int channels, float first) {
  Image image(3, 2, channels);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = first + static_cast<float>(i);
  return image;
}

TEST(Output, JoinsLayers) {
  const Image picture = filled(3, 0.f), empty;
  Image depth = filled(1, 100.f);
  depth.channel_names = {"Z"};
  const Image joined = join_layers({{"", &picture}, {"half0", &empty}, {"depth", &depth}});
  EXPECT_EQ(joined.channels, 4);
  EXPECT_EQ(joined.channel_names, (std::vector<std::string>{"R", "G", "B", "depth.Z"}));
  EXPECT_EQ(joined.pixel(2, 1)[2], picture.pixel(2, 1)[2]);
  EXPECT_EQ(joined.pixel(2, 1)[3], depth.pixel(2, 1)[0]);
}

TEST(Output, SuffixesGoBeforeTheEnding) {
  EXPECT_EQ(with_suffix("folder/out.exr", "length2"), "folder/out.length2.exr");
  EXPECT_TRUE(holds_layers("a.EXR"));
  EXPECT_FALSE(holds_layers("a.png"));
}

TEST(Output, WhatCannotBeWrittenIsRescued) {
  const std::string stem = "rescued" + std::to_string(getpid());
  EXPECT_FALSE(write_or_rescue("/nonexistent/" + stem + ".pfm", filled(3, 0.f), {}, {}));
  bool found = false;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::temp_directory_path())) {
    if (entry.path().filename().string().find(stem) == std::string::npos) continue;
    EXPECT_EQ(read_image(entry.path().string(), "").data, filled(3, 0.f).data);
    fs::remove(entry.path());
    found = true;
  }
  EXPECT_TRUE(found);
}

TEST(Auxiliary, ShowsTheFirstSurface) {
  const BuiltScene scene = test::build_small("path", "sobol");
  const AuxiliaryImages one = render_auxiliary(scene, 1, 1);
  const AuxiliaryImages two = render_auxiliary(scene, 1, 2);
  EXPECT_EQ(one.albedo.data, two.albedo.data);
  EXPECT_EQ(one.depth.data, two.depth.data);
  // The lowest row sees the floor: its reflectance, its normal, a few metres away.
  const int x = 2, y = one.albedo.height - 1;
  EXPECT_NEAR(one.albedo.pixel(x, y)[0], 0.7f, 0.02f);
  EXPECT_NEAR(one.albedo.pixel(x, y)[2], 0.3f, 0.02f);
  EXPECT_NEAR(one.normal.pixel(x, y)[2], 1.f, 1e-3f);
  EXPECT_GT(*one.depth.pixel(x, y), 1.5f);
  EXPECT_LT(*one.depth.pixel(x, y), 6.f);
}

// A wall across the view along -x; the camera's own view is along +z.
TEST(Auxiliary, NormalsHaveTheAxesThatTheFilmSays) {
  const auto normal = [](const std::string& film, const std::string& space) {
    const BuiltScene scene = test::build_text(
        {.scene = "Option \"string rendercoordsys\" \"" + space + "\" Film " + film +
                  " \"integer xresolution\" 2 \"integer yresolution\" 2 LookAt 3 0 0  0 0 0  0 0 1 "
                  "Camera \"perspective\" \"float fov\" 20 WorldBegin Rotate 90 0 1 0 "
                  "Shape \"disk\" \"float radius\" 9"});
    const AuxiliaryImages images = render_auxiliary(scene, 1, 1);
    const float* const n = images.normal.pixel(1, 1);
    return vec3(n[0], n[1], n[2]);
  };
  for (const char* space : {"cameraworld", "camera", "world"}) {
    const vec3 of_camera = normal("\"gbuffer\"", space);
    EXPECT_NEAR(glm::distance(of_camera, vec3(0.f, 0.f, -1.f)), 0.f, 1e-5f) << space;
    for (const char* film : {"\"rgb\"", "\"gbuffer\" \"string coordinatesystem\" \"world\""}) {
      const vec3 of_world = normal(film, space);
      EXPECT_NEAR(glm::distance(of_world, vec3(1.f, 0.f, 0.f)), 0.f, 1e-5f) << space;
    }
  }
}

TEST(Auxiliary, ErrorIsTheRootOfTheMeanVariance) {
  Image variance(4, 4, 3);
  std::fill(variance.data.begin(), variance.data.end(), 0.25f);
  const Image error = error_image(variance);
  EXPECT_EQ(error.channels, 1);
  for (const float e : error.data) EXPECT_NEAR(e, 0.5f, 1e-5f);
}

}  // namespace
}  // namespace pssmlt
