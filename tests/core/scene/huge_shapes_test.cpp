// Hits on shapes far larger than what is seen of them.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

constexpr double height = 1.5;  // of the eye over the plane [m]

const std::string head = R"(
Camera "perspective"
Film "rgb" "integer xresolution" 1 "integer yresolution" 1
Option "string rendercoordsys" "world"
WorldBegin
)";
const std::string plane =
    "Shape \"trianglemesh\" \"point3 P\" [ -1e7 -1e7 0  1e7 -1e7 0  1e7 1e7 0  -1e7 1e7 0 ] "
    "\"point2 uv\" [ -1e7 -1e7  1e7 -1e7  1e7 1e7  -1e7 1e7 ] \"integer indices\" "
    "[ 0 1 2  0 2 3 ]\n";
const std::string square =
    "Shape \"bilinearmesh\" \"point3 P\" [ -1e7 -1e7 0  1e7 -1e7 0  -1e7 1e7 0  1e7 1e7 0 ] "
    "\"point2 uv\" [ -1e7 -1e7  1e7 -1e7  -1e7 1e7  1e7 1e7 ]\n";
// Not a parallelogram: a patch.
const std::string trapezoid =
    "Shape \"bilinearmesh\" \"point3 P\" [ -1e7 -1e7 0  1.3e7 -1e7 0  -1e7 1e7 0  1e7 1e7 0 ]\n";
const std::string disk = "Shape \"disk\" \"float radius\" 1e7\n";
const std::string instance = "ObjectBegin \"plane\"\nScale .5 .5 .5\n" + plane +
                             "ObjectEnd\nScale 2 2 2\n" + "ObjectInstance \"plane\"\n";

// Rays from over the plane's middle to what lies at most 1000 m away.
Ray ray_down(RandomStream& random) {
  const float x = random.next();
  const float y = random.next();
  vec3 d = uniform_sphere({x, y});
  d.z = -std::abs(d.z) - 1.5e-3f;
  return {vec3(0.f, 0.f, static_cast<float>(height)), glm::normalize(d), infinity};
}

void expect_exact(const std::string& shape, bool flat_coordinates = true) {
  const BuiltScene built = build_text({head + shape});
  RandomStream random(1, RandomUse::test);
  for (int i = 0; i < 10'000; ++i) {
    const Ray ray = ray_down(random);
    Hit hit;
    ASSERT_TRUE(built.scene->intersect(ray, 0.f, hit));
    const dvec3 d(ray.direction);
    const double t = -height / d.z;
    // Two roundings of a float each; the matrix of an instance makes one more.
    const double bound = 0x1p-22 * t;
    EXPECT_LT(glm::distance(dvec3(hit.position), dvec3(ray.origin) + t * d), bound);
    EXPECT_NEAR(static_cast<double>(hit.distance), t, bound);
    EXPECT_EQ(hit.position.z, 0.f);
    if (!flat_coordinates) continue;
    EXPECT_NEAR(static_cast<double>(hit.uv.x), t * d.x, bound);
    EXPECT_NEAR(static_cast<double>(hit.uv.y), t * d.y, bound);
  }
}

TEST(HugeShapes, AreMetWhereTheRayPasses) { expect_exact(plane); }

TEST(HugeShapes, PatchesAreMetWhereTheRayPasses) {
  expect_exact(square);
  expect_exact(trapezoid, false);
}

TEST(HugeShapes, DisksAreMetWhereTheRayPasses) { expect_exact(disk, false); }

// A planet under the eye: near its pole it is flat to 10^-3 of a metre.
TEST(HugeShapes, SpheresAreMetWhereTheRayPasses) {
  const double radius = 6.4e6;
  const BuiltScene built =
      build_text({head + "Translate 0 0 -6.4e6\nShape \"sphere\" \"float radius\" 6.4e6\n"});
  RandomStream random(3, RandomUse::test);
  for (int i = 0; i < 10'000; ++i) {
    const Ray ray = ray_down(random);
    Hit hit;
    ASSERT_TRUE(built.scene->intersect(ray, 0.f, hit));
    const dvec3 d(ray.direction), o = dvec3(ray.origin) + dvec3(0.0, 0.0, radius);
    const double b = glm::dot(o, d);
    const double t = (height * (2.0 * radius + height)) /
                     (-b + std::sqrt(b * b - height * (2.0 * radius + height)));
    EXPECT_LT(glm::distance(dvec3(hit.position), dvec3(ray.origin) + t * d), 0x1p-21 * t);
  }
}

TEST(HugeShapes, OfInstancesAreMetWhereTheRayPasses) { expect_exact(instance); }

// A plane that leans, so that no coordinate of its corners is exactly that of the hit.
TEST(HugeShapes, ThatLeanAreMetWhereTheRayPasses) {
  const BuiltScene built = build_text({head + "Rotate 33 1 .3 .2\n" + plane});
  const dvec3 eye(0.3, -0.2, 50.0);
  RandomStream random(2, RandomUse::test);
  for (int i = 0; i < 10'000; ++i) {
    Ray ray = ray_down(random);
    ray.origin = vec3(eye);
    Hit hit;
    if (!built.scene->intersect(ray, 0.f, hit)) continue;
    const dvec3 way = dvec3(hit.position) - dvec3(ray.origin);
    const double off = glm::length(glm::cross(way, dvec3(ray.direction)));
    // Further away its grain is less than what directions bear.
    EXPECT_LT(off, (glm::length(way) < 1e4 ? 0x1p-22 : 0x1p-13) * glm::length(way));
  }
}

}  // namespace
}  // namespace pssmlt::test
