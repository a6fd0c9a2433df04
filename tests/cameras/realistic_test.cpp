// The camera with lenses: a thin biconvex lens sees what the thin-lens camera sees.
#include <gtest/gtest.h>

#include "core/lens/lens_system.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/render_text.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;

const RasterFrame frame{{80, 60}, {10, 20}, {70, 50}, {2.f, 1.5f}, 20.f};

// A lens that is 2 mm thick, with its stop behind it.
std::string thin_lens() {
  const std::string path = own_file("thin.dat");
  std::ofstream(path) << "100 2 1.5 24\n-100 1 1 24\n0 100 0 24\n";
  return path;
}
std::string realistic(const std::string& more) {
  return "Camera \"realistic\" \"string lensfile\" \"" + thin_lens() + "\" " + more;
}

// Distances from its principal planes: 2 m from the film is in focus.
struct Conjugate {
  explicit Conjugate(double distance = 2.0) {
    LensFile file = read_lens_file(thin_lens());
    LensSystem lens(file.surfaces, file.film_distance, {});
    lens.focus(distance);
    const ThickLens thick = lens.thick_lens();
    image = thick.film_plane;
    plane = thick.scene_plane;
    focal = thick.focal_length;
    stop = lens.rear().z;
  }
  double image = 0.0, plane = 0.0, focal = 0.0, stop = 0.0;
  double object() const { return 2.0 - plane; }
};

std::shared_ptr<Camera> thin_perspective(double lens_radius) {
  const Conjugate c;
  const double half_short = 0.5 * 20e-3 * 60.0 / 100.0;
  const double fov = 2.0 * std::atan(half_short / c.image) * 180.0 / std::numbers::pi;
  return make_camera("Camera \"perspective\" \"float fov\" " + std::to_string(fov) +
                         " \"float lensradius\" " + std::to_string(lens_radius) +
                         " \"float focaldistance\" " + std::to_string(c.object()),
                     frame);
}

// Where a ray meets the plane at this distance from the film.
vec2 at_plane(const Emission& e, float z) {
  const vec3 p = e.from.position + e.direction * ((z - e.from.position.z) / e.direction.z);
  return {p.x, p.y};
}

// With small angles and a small stop: the picture is the thin lens's, in and out of focus. What a
// single lens does off its axis is bounded by third-order theory: the tangential image lies
// (3 + 1 / n) h^2 / (2 f) before the film at a height h (Petzval's sum and astigmatism).
TEST(Realistic, ThinLensIsTheThinLensCamera) {
  constexpr double radius = 2e-3;
  const auto lenses =
      make_camera(realistic("\"float aperturediameter\" 4 \"float focusdistance\" 2"), frame);
  const auto thin = thin_perspective(radius);
  const Conjugate c;
  RandomStream random(3, RandomUse::test);
  for (const dvec2& raster : {dvec2(40.0, 30.0), dvec2(37.0, 33.0), dvec2(15.0, 42.0)}) {
    const auto reference = thin->emit(vec2(.5f), raster);
    ASSERT_TRUE(reference);
    const double h = 2e-4 * glm::distance(raster, dvec2(40.0, 30.0));  // [m]; pixels of 0.2 mm
    for (const double z : {1.0, 2.0, 4.0}) {
      const vec2 truth = at_plane(*reference, static_cast<float>(z - c.plane));
      const double blur = radius * std::abs(z - 2.0) / c.object();
      const double aberration = radius / c.image * 1.84 * h * h / c.focal * z / c.image;
      double widest = 0.0;
      int passed = 0;
      for (int i = 0; i < 2000; ++i) {
        const auto e = lenses->emit(draw2(random), raster);
        if (!e) continue;
        ++passed;
        const vec2 at = at_plane(*e, static_cast<float>(z));
        widest = std::max(widest, static_cast<double>(glm::distance(at, truth)));
      }
      EXPECT_GT(passed, 1000);
      // The stop lies behind the principal plane, which turns the chief ray a little.
      const double turned = h / c.image * (c.plane - c.stop) * std::abs(z - 2.0) / c.object();
      const double pixel = 2e-4 * z / c.image;
      EXPECT_NEAR(widest, blur, .03 * (blur + pixel) + aberration + turned) << raster.x << " " << z;
    }
  }
}

// Irradiance at the film's centre under a sky of radiance 1: pi sin^2 of the pupil's half angle.
TEST(Realistic, FilmGetsTheIrradianceOfThePupil) {
  for (const float diameter : {4.f, 10.f}) {
    const auto camera =
        make_camera(realistic("\"float focusdistance\" 2 \"float aperturediameter\" " +
                              std::to_string(diameter)),
                    frame);
    RandomStream random(5, RandomUse::test);
    double sum = 0.0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i)
      if (const auto e = camera->emit(draw2(random), {40.0, 30.0}))
        sum += static_cast<double>(e->weight().x);
    const double a = 0.5e-3 * static_cast<double>(diameter), d = Conjugate().stop;
    // Half a per cent: the error of the mean is 0.2 %.
    EXPECT_NEAR(sum / n / (std::numbers::pi * a * a / (a * a + d * d)), 1.0, .008) << diameter;
  }
}

TEST(Realistic, ApertureChangesShapeNotBrightness) {
  RandomStream random(7, RandomUse::test);
  for (const char* shape : {"gaussian", "square", "pentagon", "star"}) {
    const auto camera =
        make_camera(realistic("\"float aperturediameter\" 8 \"string aperture\" \"" +
                              std::string(shape) + "\""),
                    frame);
    double sum = 0.0, sum2 = 0.0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
      const auto e = camera->emit(draw2(random), {40.0, 30.0});
      const double w = e ? static_cast<double>(e->weight().x) : 0.0;
      sum += w;
      sum2 += w * w;
    }
    const double mean = sum / n, sigma = std::sqrt((sum2 / n - mean * mean) / n);
    const double a = 4e-3, d = Conjugate(10.0).stop;
    // Five sigma; the shapes differ a little in the cosines of their rays.
    EXPECT_NEAR(mean, std::numbers::pi * a * a / (a * a + d * d), 5.0 * sigma + .005 * mean)
        << shape;
  }
}

TEST(Realistic, WrongParametersAreErrors) {
  const auto message = [](const std::string& text) {
    return error_of([&] { make_camera(text, frame); });
  };
  EXPECT_NE(message("Camera \"realistic\"").find("needs a \"lensfile\""), std::string::npos);
  EXPECT_NE(message("Camera \"realistic\" \"string lensfile\" \"/none.dat\"").find("not exist"),
            std::string::npos);
  for (const char* name : {"aperturediameter", "focusdistance"})
    EXPECT_NE(message(realistic("\"float " + std::string(name) + "\" 0")).find("positive"),
              std::string::npos);
  EXPECT_NE(message(realistic("\"float focusdistance\" .3")).find("cannot be focused"),
            std::string::npos);
  EXPECT_NE(message(realistic("\"string aperture\" \"hexagon\"")).find("not exist"),
            std::string::npos);
  const std::string diverging = own_file("diverging.dat");
  std::ofstream(diverging) << "-100 1 1.5 30\n100 100 1 30\n";
  const std::string other = "Camera \"realistic\" \"string lensfile\" \"" + diverging + "\"";
  EXPECT_NE(message(other).find("cannot be focused"), std::string::npos);
  EXPECT_NE(message(other + "\"float aperturediameter\" 3").find("no stop"), std::string::npos);
  // A stop that nothing gets to.
  const std::string closed = own_file("closed.dat");
  std::ofstream(closed) << "0 1 1 30\n100 2 1.5 24\n-100 100 1 24\n";
  EXPECT_NE(message("Camera \"realistic\" \"string lensfile\" \"" + closed +
                    "\" \"float aperturediameter\" 1e-6")
                .find("no light gets through"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
