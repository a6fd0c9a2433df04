// The spherical camera: where its axes are, and that a direction near the picture's edge is seen
// from both sides of it.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {

using namespace test;

const RasterFrame frame{{40, 20}, {0, 0}, {40, 20}, {2.f, 1.5f}};
const std::vector<std::string> mappings = {"equalarea", "equirectangular"};

std::shared_ptr<Camera> spherical(const std::string& mapping) {
  return make_camera("Camera \"spherical\" \"string mapping\" \"" + mapping + "\"", frame);
}

void expect_axis(const Camera& camera, const dvec2& raster, const vec3& axis) {
  const auto e = camera.emit(vec2(0.5f), raster);
  ASSERT_TRUE(e.has_value());
  EXPECT_LT(glm::distance(e->direction, axis), 1e-4f) << raster.x << " " << raster.y;
}

// y is up; seen from the map's middle, +x is to the right in an equal-area map, and longitudes
// begin at +x and turn toward +z.
TEST(Spherical, Axes) {
  const auto map = spherical("equalarea");
  expect_axis(*map, {20.0, 10.0}, {0.f, 1.f, 0.f});
  expect_axis(*map, {40.0, 10.0}, {1.f, 0.f, 0.f});
  expect_axis(*map, {20.0, 20.0}, {0.f, 0.f, 1.f});
  expect_axis(*map, {0.0, 0.0}, {0.f, -1.f, 0.f});
  const auto globe = spherical("equirectangular");
  expect_axis(*globe, {0.0, 10.0}, {1.f, 0.f, 0.f});
  expect_axis(*globe, {10.0, 10.0}, {0.f, 0.f, 1.f});
  expect_axis(*globe, {17.0, 1e-4}, {0.f, 1.f, 0.f});
  expect_axis(*globe, {20.0, 10.0}, {-1.f, 0.f, 0.f});
}

// Where a ray beyond the edge looks is also found inside; light chooses among all such places.
TEST(Spherical, BordersAreSeenTwice) {
  for (const std::string& mapping : mappings) {
    const auto camera = spherical(mapping);
    RandomStream random(4, RandomUse::test);
    for (int i = 0; i < 500; ++i) {
      const dvec2 raster = dvec2(-2.0, -1.5) + dvec2(draw2(random)) * dvec2(44.0, 23.0);
      const auto e = camera->emit(vec2(0.5f), raster);
      ASSERT_TRUE(e.has_value());
      EXPECT_NEAR(e->weight().x, 1.f, 1e-4f);
      bool found = false, inside = false;
      for (int k = 0; k < 32; ++k) {
        const vec2 u((static_cast<float>(k) + 0.5f) / 32.f, 0.f);
        const auto t = camera->toward(2.f * e->direction, u);
        ASSERT_TRUE(t.has_value());
        ASSERT_TRUE(frame.shows(t->raster));
        found = found || glm::distance(t->raster, raster) < 1e-2;
        inside = inside || (t->raster.x >= 0.0 && t->raster.x <= 40.0 && t->raster.y >= 0.0 &&
                            t->raster.y <= 20.0);
        EXPECT_NEAR(t->pdf_direction / e->pdf_direction, 1.f, 2e-3f);
      }
      EXPECT_TRUE(found) << mapping << " " << raster.x << " " << raster.y;
      EXPECT_TRUE(inside) << mapping << " " << raster.x << " " << raster.y;
    }
  }
}

// A pixel's solid angle from the rays through its sides; all pixels together see the sphere.
TEST(Spherical, DensityIsPixelsPerSolidAngle) {
  for (const std::string& mapping : mappings) {
    const auto camera = spherical(mapping);
    double sum = 0.0;
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 40; ++x) {
        const dvec2 raster(x + 0.31, y + 0.43);
        const auto direction = [&](double dx, double dy) {
          return dvec3(camera->emit(vec2(0.f), raster + dvec2(dx, dy))->direction);
        };
        const dvec3 dx = direction(0.01, 0.0) - direction(-0.01, 0.0);
        const dvec3 dy = direction(0.0, 0.01) - direction(0.0, -0.01);
        const double solid_angle = glm::length(glm::cross(dx, dy)) / 4e-4;
        const auto e = camera->emit(vec2(0.f), raster);
        EXPECT_NEAR(e->pdf_direction * solid_angle * frame.pixels(), 1.0, 5e-3) << mapping;
        sum += 1.0 / (static_cast<double>(e->pdf_direction) * frame.pixels());
      }
    EXPECT_NEAR(sum, 4.0 * std::numbers::pi, 0.02) << mapping;
  }
}

// Inside a glowing sphere the picture is constant up to its edges, whether rays leave the camera or
// the light, with a filter that reaches beyond them.
TEST(Spherical, PictureIsConstantToItsEdges) {
  for (const std::string& mapping : mappings) {
    const std::string scene =
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 6\n"
        "PixelFilter \"triangle\" \"float xradius\" 1.7 \"float yradius\" 1.3\n"
        "Camera \"spherical\" \"string mapping\" \"" +
        mapping +
        "\"\nIntegrator \"path\" \"integer maxdepth\" 0\nWorldBegin\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]\nReverseOrientation\n"
        "Shape \"sphere\" \"float radius\" 2";
    for (const char* integrator : {"path", "light", "bdpt"}) {
      constexpr int renders = 16;
      const Job job{.scene = scene, .integrator = integrator, .sampler = "independent", .spp = 512};
      const BlockValues pixels = render_blocks(job, renders, 1);
      // About three hundred comparisons at 1e-9.
      const double limit = student_limit(1e-9, renders - 1);
      for (const auto& pixel : pixels) {
        const Estimate e = estimate(pixel);
        EXPECT_NEAR(e.mean, 1.0, limit * e.error() + 1e-4) << mapping << " " << integrator;
        // Pixels at the poles of longitudes are small: light finds them rarely.
        EXPECT_LT(e.error(), mapping == mappings[0] ? .06 : .25) << mapping << " " << integrator;
      }
    }
  }
}

TEST(Spherical, WrongParametersAreErrors) {
  const auto message = [](const char* text) { return error_of([&] { make_camera(text, frame); }); };
  EXPECT_NE(message("Camera \"spherical\" \"string mapping\" \"equirect\"").find("equirectangular"),
            std::string::npos);
  EXPECT_NE(message("Camera \"spherical\" \"float fov\" 60").find("unknown parameter"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
