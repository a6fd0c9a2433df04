// Cameras: rays and raster positions are inverse to each other, importance measures the picture.
#include <gtest/gtest.h>

#include "tests/support/make_endpoint.h"

namespace pssmlt {
namespace {

using namespace test;

const RasterFrame frame{{80, 60}, {10, 20}, {70, 50}, {2.f, 1.5f}};
constexpr const char* placed = "Rotate 10 0 0 1 LookAt 1 2 3 -1 0 0.5 0 1 0.1 ";

const std::vector<std::string>& cameras() {
  static const std::vector<std::string> all{
      "Camera \"perspective\"",
      "Camera \"perspective\" \"float fov\" 30 \"float lensradius\" 0.2 \"float focaldistance\" 3",
      "Camera \"perspective\" \"float screenwindow\" [-0.5 1 -0.2 0.9] \"float lensradius\" 0.1",
      "Camera \"orthographic\"", "Camera \"orthographic\" \"float screenwindow\" [-2 1 -1 3]"};
  return all;
}

TEST(Camera, RasterInvertsEmit) {
  for (const std::string& text : cameras()) {
    for (const char* scaled : {"", "Scale -1 1 1 ", "Scale 0.5 2 1 "}) {
      const auto camera = make_camera(scaled + (placed + text), frame);
      RandomStream random(1, RandomUse::test);
      for (int i = 0; i < 1000; ++i) {
        const dvec2 raster =
            dvec2(frame.crop_min) + dvec2(draw2(random)) * dvec2(frame.crop_size());
        const auto e = camera->emit(draw2(random), raster);
        ASSERT_TRUE(e.has_value());
        const auto back = camera->raster(e->from.position, e->direction);
        ASSERT_TRUE(back.has_value()) << text;
        EXPECT_LT(glm::distance(*back, raster), 2e-3) << text;
        // A point along the ray is seen there as well.
        const auto seen = camera->toward(e->from.position + 3.f * e->direction, vec2(0.5f));
        if (camera->traits().delta_position || camera->traits().delta_direction) {
          ASSERT_TRUE(seen.has_value());
          EXPECT_LT(glm::distance(seen->raster, raster), 2e-3) << text;
        }
      }
    }
  }
}

// A pixel's solid angle from the rays through its sides, times pixels times density, is 1.
TEST(Camera, DensityIsPixelsPerSolidAngle) {
  const vec2 lens(0.3f, 0.8f);
  for (const std::string& text : cameras()) {
    const auto camera = make_camera("Scale 0.7 1 1.3 " + (placed + text), frame);
    if (camera->traits().delta_direction) continue;
    for (const dvec2& raster : {dvec2(12.0, 22.0), dvec2(40.0, 30.0), dvec2(69.0, 49.0)}) {
      const auto direction = [&](double dx, double dy) {
        return dvec3(camera->emit(lens, raster + dvec2(dx, dy))->direction);
      };
      const dvec3 x = direction(0.5, 0.0) - direction(-0.5, 0.0);
      const dvec3 y = direction(0.0, 0.5) - direction(0.0, -0.5);
      const double solid_angle = glm::length(glm::cross(x, y));
      const auto e = camera->emit(lens, raster);
      EXPECT_NEAR(e->pdf_direction * solid_angle * frame.pixels(), 1.0, 1e-3) << text;
      EXPECT_NEAR(e->weight().x, 1.f, 1e-5f);
    }
  }
}

TEST(Camera, OrthographicDensityIsPixelsPerArea) {
  const auto camera =
      make_camera("Scale 0.7 1 1.3 LookAt 1 2 3 0 0 0 0 1 0 " + cameras()[4], frame);
  const auto position = [&](double x, double y) {
    return dvec3(camera->emit(vec2(0.f), {x, y})->from.position);
  };
  const double pixel = glm::length(
      glm::cross(position(41, 30) - position(40, 30), position(40, 31) - position(40, 30)));
  const auto e = camera->emit(vec2(0.f), {40.0, 30.0});
  EXPECT_NEAR(e->pdf_position * pixel * frame.pixels(), 1.0, 1e-4);
  EXPECT_NEAR(e->weight().x, 1.f, 1e-5f);
  EXPECT_NEAR(camera->pixel_spread(), std::sqrt(pixel), 1e-5);
  EXPECT_TRUE(camera->parallel());
}

TEST(Camera, FieldOfViewSpansTheShorterAxis) {
  const auto camera = make_camera("Camera \"perspective\" \"float fov\" 40", frame);
  const auto up = camera->emit(vec2(0.5f), {40.0, 0.0})->direction;
  EXPECT_NEAR(std::atan2(up.y, up.z), 20.f * pi / 180.f, 1e-5f);
  EXPECT_GT(up.y, 0.f);  // raster rows go down
  const auto right = camera->emit(vec2(0.5f), {80.0, 30.0})->direction;
  EXPECT_NEAR(right.x / right.z, std::tan(20.f * pi / 180.f) * 80.f / 60.f, 1e-5f);
  const RasterFrame tall{{60, 80}, {0, 0}, {60, 80}, {0.5f, 0.5f}};
  const auto side = make_camera("Camera \"perspective\" \"float fov\" 40", tall)
                        ->emit(vec2(0.5f), {60.0, 40.0})
                        ->direction;
  EXPECT_NEAR(std::atan2(side.x, side.z), 20.f * pi / 180.f, 1e-5f);
}

// All rays through one raster position meet in the plane of focus.
TEST(Camera, LensFocuses) {
  const auto camera = make_camera(cameras()[1], frame);
  const auto at_focus = [&](const vec2& lens) {
    const auto e = camera->emit(lens, {23.0, 41.0});
    return e->from.position + e->direction * (3.f / e->direction.z);
  };
  const vec3 first = at_focus({0.1f, 0.9f});
  for (const vec2& lens : {vec2(0.f, 0.f), vec2(0.99f, 0.5f), vec2(0.5f, 0.5f)})
    EXPECT_LT(glm::distance(at_focus(lens), first), 1e-5f);
}

TEST(Camera, NothingBehindOrOutsideIsSeen) {
  for (const std::string& text : cameras()) {
    const auto camera = make_camera(text, frame);
    EXPECT_FALSE(camera->toward({0.f, 0.f, -5.f}, vec2(0.5f)).has_value()) << text;
    EXPECT_FALSE(camera->toward({100.f, 0.f, 1.f}, vec2(0.5f)).has_value()) << text;
    // The window ends a filter's radius further out.
    const auto edge = [&](double x) {
      const auto e = camera->emit(vec2(0.5f), {x, 30.0});
      return camera->raster(e->from.position, e->direction).has_value();
    };
    EXPECT_TRUE(edge(8.1)) << text;
    EXPECT_FALSE(edge(7.9)) << text;
    EXPECT_TRUE(edge(71.9)) << text;
    EXPECT_FALSE(edge(72.1)) << text;
  }
}

TEST(Camera, WrongParametersAreErrors) {
  const auto message = [](const char* text) { return error_of([&] { make_camera(text, frame); }); };
  EXPECT_NE(message("Camera \"perspective\" \"float fov\" 180").find("fov"), std::string::npos);
  EXPECT_NE(message("Camera \"perspective\" \"float lensradius\" -1").find("lensradius"),
            std::string::npos);
  EXPECT_NE(message("Camera \"orthographic\" \"float lensradius\" 1").find("not supported yet"),
            std::string::npos);
  EXPECT_NE(message("Camera \"orthographic\" \"float screenwindow\" [1 2 3]").find("four"),
            std::string::npos);
  EXPECT_NE(message("Camera \"orthographic\" \"float fov\" 3").find("unknown parameter"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
