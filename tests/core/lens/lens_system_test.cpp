// Lens systems against closed forms of optics, and lens files that are none.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/lens/exit_pupil.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using test::error_of;

std::string lens_file(const std::string& rows) {
  const std::string path = test::own_file("system.dat");
  std::ofstream(path) << rows;
  return path;
}

LensSystem make_system(const std::string& rows, const Aperture& aperture = {}) {
  LensFile file = read_lens_file(lens_file(rows));
  return {std::move(file.surfaces), file.film_distance, aperture};
}

constexpr const char* biconvex = "# a lens and a stop\n 100 8 1.5 40\n -80 1 1 40\n 0 90 0 10\n";

// The lensmaker's equation of a thick lens: 1 / f = (n - 1) (1 / a - 1 / b + (n - 1) t / (n a b)).
TEST(LensSystem, FocalLengthIsTheLensmakers) {
  const ThickLens lens = make_system(biconvex).thick_lens();
  const double a = .1, b = -.08, t = .008, n = 1.5;
  const double f = 1.0 / ((n - 1.0) * (1.0 / a - 1.0 / b + (n - 1.0) * t / (n * a * b)));
  EXPECT_NEAR(lens.focal_length, f, 1e-12);
  // Distances of the principal planes from the vertices.
  EXPECT_NEAR(.099 - lens.scene_plane, -f * (n - 1.0) * t / (n * b), 1e-12);
  EXPECT_NEAR(lens.film_plane - .091, f * (n - 1.0) * t / (n * a), 1e-12);
}

// Rays near the axis from a point in focus meet in the film: what the traced surfaces do is what
// the thick lens says.
TEST(LensSystem, RaysFromThePlaneInFocusMeetInTheFilm) {
  LensSystem lens = make_system(biconvex);
  ASSERT_TRUE(lens.focus(2.0));
  const ThickLens thick = lens.thick_lens();
  const double object = 2.0 - thick.scene_plane, image = thick.film_plane;
  EXPECT_NEAR(1.0 / object + 1.0 / image, 1.0 / thick.focal_length, 1e-9);
  constexpr double height = 1e-3;
  for (const double aim : {-2e-5, 0.0, 1e-5, 3e-5}) {
    LensRay ray;
    ray.origin = {height, 0.0, 2.0};
    ray.direction = glm::normalize(dvec3(aim, aim, lens.front().z) - ray.origin);
    ASSERT_EQ(lens.from_scene(ray), 1.0);
    const dvec3 film = ray.at_height(0.0);
    EXPECT_NEAR(film.x, -height * image / object, 1e-9);
    EXPECT_NEAR(film.y, 0.0, 1e-9);
  }
}

TEST(LensSystem, BothDirectionsAreOneAnother) {
  LensSystem lens = make_system(biconvex, *Aperture::built_in("pentagon"));
  ASSERT_TRUE(lens.focus(1.0));
  RandomStream random(4, RandomUse::test);
  int passed = 0;
  for (int i = 0; i < 2000; ++i) {
    const dvec2 film = .02 * (dvec2(test::draw2(random)) - 0.5);
    const dvec2 rear = .02 * (dvec2(test::draw2(random)) - 0.5);
    LensRay ray;
    ray.origin = {film, 0.0};
    ray.direction = glm::normalize(dvec3(rear, lens.rear().z) - ray.origin);
    const dvec3 first = ray.direction;
    const double through = lens.from_film(ray);
    if (through == 0.0) continue;
    ++passed;
    ray.origin = ray.at_height(lens.front_plane() + .01);
    ray.direction = -ray.direction;
    EXPECT_NEAR(lens.from_scene(ray), through, 1e-6);
    EXPECT_LT(glm::distance(ray.at_height(0.0), dvec3(film, 0.0)), 1e-12);
    EXPECT_LT(glm::distance(ray.direction, -first), 1e-12);
  }
  EXPECT_GT(passed, 100);
}

// Of dA cos(theta) d(omega) nothing is lost or gained: the determinant of the map of rays from the
// film to the front plane, in positions and sines, is 1.
TEST(LensSystem, KeepsEtendue) {
  LensSystem lens = make_system(biconvex);
  ASSERT_TRUE(lens.focus(.8));
  const auto map = [&](const dvec4& in) {
    LensRay ray;
    ray.origin = {in.x, in.y, 0.0};
    ray.direction = {in.z, in.w, std::sqrt(1.0 - in.z * in.z - in.w * in.w)};
    EXPECT_GT(lens.from_film(ray), 0.0);
    const dvec3 p = ray.at_height(lens.front_plane());
    return dvec4(p.x, p.y, ray.direction.x, ray.direction.y);
  };
  const dvec4 at(.006, -.004, -.05, .04);
  dmat4 jacobian(1.0);
  for (int i = 0; i < 4; ++i) {
    dvec4 step(0.0);
    step[i] = 1e-6;
    jacobian[i] = (map(at + step) - map(at - step)) / 2e-6;
  }
  EXPECT_NEAR(std::abs(glm::determinant(jacobian)), 1.0, 1e-6);
}

// Every ray that gets through comes from the box of its film point.
TEST(ExitPupil, HoldsAllRays) {
  for (const char* stop : {"circular", "square", "star"}) {
    LensSystem lens = make_system(biconvex, *Aperture::built_in(stop));
    ASSERT_TRUE(lens.focus(1.0));
    const ExitPupil pupil(lens, .02);
    ASSERT_FALSE(pupil.empty());
    RandomStream random(6, RandomUse::test);
    int passed = 0, outside = 0;
    for (int i = 0; i < 100'000; ++i) {
      const dvec2 film = .028 * (dvec2(test::draw2(random)) - 0.5);
      const dvec2 rear = .012 * (dvec2(test::draw2(random)) - 0.5);
      LensRay ray;
      ray.origin = {film, 0.0};
      ray.direction = glm::normalize(dvec3(rear, lens.rear().z) - ray.origin);
      if (lens.from_film(ray) == 0.0) continue;
      ++passed;
      outside += !pupil.contains(film, rear);
      EXPECT_LE(glm::length(dvec2(ray.at_height(lens.front_plane()))), pupil.front_radius());
    }
    EXPECT_GT(passed, 10'000);
    EXPECT_EQ(outside, 0) << stop;
    EXPECT_LT(pupil.area({0.0, 0.0}), 1.5 * sqr(2.0 * .005)) << "the box is not close";
  }
}

// A pinhole of a stop is found, and followed to the film's corner.
TEST(ExitPupil, FindsTinyStops) {
  LensSystem lens = make_system("100 8 1.5 40\n -80 1 1 40\n 0 90 0 .02\n");
  ASSERT_TRUE(lens.focus(1.0));
  const ExitPupil pupil(lens, .02);
  EXPECT_GT(pupil.area({0.0, 0.0}), 0.0);
  EXPECT_GT(pupil.area({.0199, 0.0}), 0.0);
}

TEST(Aperture, PassesAsMuchAsTheCircle) {
  for (const char* name : {"circular", "gaussian", "square", "pentagon", "star"}) {
    const auto aperture = Aperture::built_in(name);
    ASSERT_TRUE(aperture) << name;
    constexpr int n = 1000;
    double sum = 0.0;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        sum += aperture->value(dvec2(x + .5, y + .5) * (4.0 / n) - 2.0) * 16.0 / n / n;
    EXPECT_NEAR(sum, std::numbers::pi, .01) << name;
    EXPECT_EQ(aperture->value({1.5, 0.0}), 0.0);
  }
  EXPECT_FALSE(Aperture::built_in("hexagon"));
}

TEST(LensFile, SaysWhereItIsWrong) {
  const auto message = [](const std::string& rows) {
    return error_of([&] { read_lens_file(lens_file(rows)); });
  };
  EXPECT_EQ(message(biconvex), "");
  EXPECT_NE(message("").find("no surfaces"), std::string::npos);
  EXPECT_NE(message("# nothing\n").find("no surfaces"), std::string::npos);
  EXPECT_NE(message("1 2 3\n").find("four numbers"), std::string::npos);
  EXPECT_NE(message("10 2 1.5 10\n 10 two 1 10\n").find("dat:2:5: "), std::string::npos);
  EXPECT_NE(message("10 2 nan 10\n").find("only numbers"), std::string::npos);
  EXPECT_NE(message("10 2 1e999 10\n").find("only numbers"), std::string::npos);
  EXPECT_NE(message("10 -2 1.5 10\n").find("thickness"), std::string::npos);
  EXPECT_NE(message("10 2 0.5 10\n").find("index"), std::string::npos);
  EXPECT_NE(message("10 2 1.5 0\n").find("diameter"), std::string::npos);
  EXPECT_NE(message("0 2 1 10\n").find("no curved surface"), std::string::npos);
  EXPECT_NE(message("10 2 1.5 10\n").find("film must lie in air"), std::string::npos);
  std::string long_file;
  for (int i = 0; i < 1001; ++i) long_file += "10 2 1 10\n";
  EXPECT_NE(message(long_file).find("more than 1000"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
