// The irradiance camera against closed forms, under every integrator that finds the light.
#include <gtest/gtest.h>

#include "tests/support/make_endpoint.h"
#include "tests/support/reduced.h"
#include "tests/support/render_text.h"

namespace pssmlt {
namespace {

using namespace test;

const RasterFrame frame{{40, 20}, {0, 0}, {40, 20}, {2.f, 1.5f}};

struct Lit {
  const char* name;
  std::string camera, world;
  double truth;  // [W/m^2]
  std::vector<const char*> integrators;
};

constexpr double exact_pi = std::numbers::pi;

std::vector<Lit> lit() {
  const std::string point = "Camera \"irradiance\"";
  const std::string lamp = "AreaLightSource \"diffuse\" \"rgb L\" [ 2 2 2 ]\n";
  const std::string tilted = "Camera \"irradiance\" \"vector3 normal\" [ 0 .6 .8 ]";
  return {
      {"Sky",
       point,
       "LightSource \"infinite\" \"rgb L\" [ 2 2 2 ]",
       2.0 * exact_pi,
       {"path", "bdpt", "whitted"}},
      {"Point",
       tilted,
       "LightSource \"point\" \"rgb I\" [ 3 3 3 ] \"point3 from\" [ 0 0 2 ]",
       3.0 * .8 / 4.0,
       {"path", "light", "bdpt"}},
      {"Distant",
       tilted,
       "LightSource \"distant\" \"rgb L\" [ 3 3 3 ] \"point3 from\" [ 0 1 0 ] \"point3 to\" [ 0 0 "
       "0 ]",
       3.0 * .6,
       {"path", "light", "bdpt"}},
      // pi L (R / d)^2
      {"Sphere",
       tilted,
       lamp + "Translate 0 0 2 Shape \"sphere\" \"float radius\" .5",
       2.0 * exact_pi * .0625 * .8,
       {"path", "light", "bdpt"}},
      // pi L R^2 / (R^2 + d^2)
      {"Disk",
       point,
       lamp + "ReverseOrientation Translate 0 0 1.5 Shape \"disk\" \"float radius\" .5",
       2.0 * exact_pi * .25 / 2.5,
       {"path", "light", "bdpt", "whitted"}},
      // A floor in a plane through the camera's origin, where positions are exactly 0: what it
      // reflects must not be stopped by itself.
      {"Floor",
       "Camera \"irradiance\" \"point3 position\" [ 0 1 0 ] \"vector3 normal\" [ 0 -1 0 ]",
       "LightSource \"distant\" \"rgb L\" [ 3 3 3 ] \"point3 from\" [ 0 1 0 ] \"point3 to\" [ 0 0 "
       "0 ]\n"
       "Shape \"bilinearmesh\" \"point3 P\" [ -1e3 0 1e3  1e3 0 1e3  -1e3 0 -1e3  1e3 0 -1e3 ]",
       .5 * 3.0,
       {"path", "bdpt", "whitted"}},
      // Beside it nothing arrives.
      {"Behind",
       point,
       "LightSource \"point\" \"point3 from\" [ 1 0 -1e-3 ]",
       0.0,
       {"path", "light", "bdpt"}},
      // A patch of the size of the world's unit, moved and stretched: the same light everywhere.
      {"Stretched",
       "Scale 1 1 .5 Translate 0 0 3 Camera \"irradiance\" \"string surface\" \"rectangle\"",
       "LightSource \"distant\" \"rgb L\" [ 3 3 3 ] \"point3 from\" [ 0 .6 .8 ] \"point3 to\" [ 0 "
       "0 0 ]",
       3.0 * .8,
       {"path", "light", "bdpt"}},
  };
}

std::string scene_of(const Lit& l) {
  return "Film \"rgb\" \"integer xresolution\" 3 \"integer yresolution\" 2\n"
         "PixelFilter \"triangle\" \"float xradius\" 1.3 \"float yradius\" 1.7\n" +
         l.camera + "\nIntegrator \"path\" \"integer maxdepth\" 2\nWorldBegin\n" + l.world;
}

TEST(Irradiance, IsTheClosedForm) {
  if (reduced()) GTEST_SKIP() << "a picture by statistics";
  constexpr int renders = 12;
  // About four hundred comparisons at 1e-9.
  const double limit = student_limit(1e-9, renders - 1);
  for (const Lit& l : lit()) {
    for (const char* integrator : l.integrators) {
      const Job job{
          .scene = scene_of(l), .integrator = integrator, .sampler = "independent", .spp = 1024};
      for (const auto& pixel : render_blocks(job, renders, 1)) {
        const Estimate e = estimate(pixel);
        EXPECT_NEAR(e.mean, l.truth, limit * e.error() + 1e-4 * l.truth + 1e-7)
            << l.name << " " << integrator;
        EXPECT_LE(e.error(), .04 * l.truth) << l.name << " " << integrator;
      }
    }
  }
}

TEST(Irradiance, UnderMetropolis) {
  if (reduced()) GTEST_SKIP() << "a picture by statistics";
  constexpr int renders = 12;
  const double limit = student_limit(1e-9, renders - 1);
  for (const Lit& l : lit()) {
    if (l.truth == 0.0) continue;
    for (const char* integrator : {"path", "bdpt"}) {
      const Job job{.scene = scene_of(l),
                    .integrator = integrator,
                    .sampler = "pssmlt",
                    .set = {"sampler.chains=32"},
                    .spp = 2048};
      const Estimate e = estimate(render_blocks(job, renders, 0)[0]);
      EXPECT_NEAR(e.mean, l.truth, limit * e.error() + 1e-4 * l.truth) << l.name << integrator;
      EXPECT_LE(e.error(), .04 * l.truth) << l.name << " " << integrator;
    }
  }
}

// A point light above a ball: E = I cos / d^2 over its upper half, nothing over the lower.
TEST(Irradiance, OverASphere) {
  Lit l{"",
        "Camera \"irradiance\" \"string surface\" \"sphere\" \"float radius\" .5",
        "LightSource \"point\" \"rgb I\" [ 1 1 1 ] \"point3 from\" [ 0 0 10 ]",
        0.0,
        {}};
  std::string scene = scene_of(l);
  scene.replace(scene.find("\"triangle\""), scene.find("Camera") - scene.find("\"triangle\""),
                "\"box\"\n");
  for (const char* integrator : {"path", "light", "bdpt"}) {
    const Job job{.scene = scene, .integrator = integrator, .sampler = "independent", .spp = 4096};
    const RenderResult r = render_text(job, 1);
    // The upper half of the heights sees the lamp: mean over z in (0, 1) of what arrives there.
    double truth = 0.0;
    constexpr int n = 10'000;
    for (int i = 0; i < n; ++i) {
      const double z = (i + .5) / n, d2 = 100.25 - 10.0 * z;
      truth += std::max(0.0, (10.0 * z - .5) / std::sqrt(d2)) / d2 / n;
    }
    for (int x = 0; x < 3; ++x) {
      // Six sigma of 4096 samples.
      EXPECT_NEAR(static_cast<double>(r.image.pixel(x, 0)[1]), truth, .06 * truth) << integrator;
      EXPECT_EQ(r.image.pixel(x, 1)[1], 0.f) << integrator;
    }
  }
}

TEST(Irradiance, RasterInvertsEmit) {
  for (const char* surface : {"rectangle", "disk", "sphere"}) {
    const auto camera = make_camera(
        "Rotate 10 1 2 3 Scale -1 .5 2 Translate 1 2 3 Camera \"irradiance\" \"string "
        "surface\" \"" +
            std::string(surface) + "\" \"vector3 normal\" [ 1 -2 .3 ]",
        frame);
    RandomStream random(2, RandomUse::test);
    for (int i = 0; i < 1000; ++i) {
      const dvec2 raster = dvec2(draw2(random)) * dvec2(frame.resolution);
      const auto e = camera->emit(draw2(random), raster);
      ASSERT_TRUE(e);
      EXPECT_NEAR(e->weight().x, pi, 1e-4f);
      const auto back = camera->raster(e->from.position, e->direction);
      ASSERT_TRUE(back) << surface;
      EXPECT_LT(glm::distance(*back, raster), 2e-3) << surface;
    }
  }
}

TEST(Irradiance, WrongParametersAreErrors) {
  const auto message = [](const std::string& text) {
    return error_of([&] { make_camera("Camera \"irradiance\" " + text, frame); });
  };
  EXPECT_NE(message("\"vector3 normal\" [ 0 0 0 ]").find("normal"), std::string::npos);
  EXPECT_NE(message("\"string surface\" \"disc\"").find("disk"), std::string::npos);
  EXPECT_NE(message("\"string surface\" \"disk\" \"float radius\" 0").find("positive"),
            std::string::npos);
  EXPECT_NE(message("\"float radius\" 2").find("measures"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
