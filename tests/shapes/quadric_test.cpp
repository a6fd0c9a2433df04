// Spheres, disks and cylinders against closed forms: near, from far away, from inside, mirrored and
// stretched.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "tests/support/all_hits.h"
#include "tests/support/make_endpoint.h"

namespace pssmlt {
namespace {

using namespace test;

std::vector<Hit> hits(const std::string& text, const vec3& origin, const vec3& direction) {
  return all_hits(*make_shape(text), {origin, glm::normalize(direction), infinity});
}

TEST(Quadric, SphereIsMetTwiceFromOutsideOnceFromInside) {
  const auto outside =
      hits("Shape \"sphere\" \"float radius\" 2", {5.f, 0.f, 0.f}, {-1.f, 0.f, 0.f});
  ASSERT_EQ(outside.size(), 2u);
  EXPECT_FLOAT_EQ(outside[0].distance, 3.f);
  EXPECT_FLOAT_EQ(outside[1].distance, 7.f);
  EXPECT_NEAR(outside[0].ng.x, 1.f, 1e-6f);
  EXPECT_NEAR(outside[0].uv.x, 0.f, 1e-6f);
  EXPECT_NEAR(outside[0].uv.y, 0.5f, 1e-6f);
  EXPECT_EQ(hits("Shape \"sphere\"", {0.5f, 0.f, 0.f}, {0.f, 1.f, 0.f}).size(), 1u);
  EXPECT_EQ(hits("Shape \"sphere\"", {3.f, 1.01f, 0.f}, {-1.f, 0.f, 0.f}).size(), 0u);
}

// Hits from far away lie on the sphere to the rounding of their coordinates.
TEST(Quadric, DistantSphereIsExact) {
  const auto sphere = make_shape("Translate 3 4 5 Shape \"sphere\" \"float radius\" 0.5");
  const dvec3 center(3.0, 4.0, 5.0);
  RandomStream random(1, RandomUse::test);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    const vec3 origin = 1e5f * uniform_sphere(draw2(random));
    const vec3 target = vec3(center) + 0.3f * uniform_sphere(draw2(random));
    for (const Hit& hit : all_hits(*sphere, {origin, glm::normalize(target - origin), infinity})) {
      ++found;
      EXPECT_NEAR(glm::distance(dvec3(hit.position), center), 0.5, 1e-6);
      const dvec3 exact = center + 0.5 * glm::normalize(dvec3(hit.position) - center);
      for (int k = 0; k < 3; ++k) EXPECT_LE(std::abs(exact[k] - hit.position[k]), hit.error[k]);
      // The ray itself, at a distance where a float's step is 0.008, passes through the hit.
      const dvec3 d = dvec3(hit.position) - dvec3(origin);
      EXPECT_LT(glm::length(glm::cross(d, dvec3(glm::normalize(target - origin)))), 0.02);
    }
  }
  EXPECT_GT(found, 900);  // the far side is nearer than a step of the search
}

// No leaving ray meets the point that it leaves, and no entering ray misses the other side.
TEST(Quadric, LeavingRaysDoNotMeetTheirOwnSurface) {
  for (const char* placed : {"", "Translate 1000 -2000 500 ", "Scale 1e-3 1e-3 1e-3 ",
                             "Rotate 30 1 1 0 Scale 100 1 0.01 "}) {
    const auto sphere = make_shape(std::string(placed) + "Shape \"sphere\"");
    RandomStream random(2, RandomUse::test);
    for (int i = 0; i < 5000; ++i) {
      const SurfaceSample s = sphere->sample_area(draw2(random));
      const vec3 d = uniform_sphere(draw2(random));
      const vec3 origin = offset_origin(s.position, s.error, s.normal, d);
      const size_t met = all_hits(*sphere, {origin, d, infinity}).size();
      EXPECT_EQ(met, glm::dot(d, s.normal) < 0.f ? 1u : 0u) << placed;
    }
  }
}

TEST(Quadric, PartsOfSpheresAreCutWhereTheySay) {
  const std::string part =
      "Shape \"sphere\" \"float zmin\" -0.5 \"float zmax\" 0.25 \"float phimax\" 90";
  EXPECT_EQ(hits(part, {3.f, 3.f, 0.f}, {-1.f, -1.f, 0.f}).size(), 1u);
  EXPECT_EQ(hits(part, {3.f, 3.f, 0.4f}, {-1.f, -1.f, 0.f}).size(), 0u);
  EXPECT_EQ(hits(part, {3.f, 3.f, -0.6f}, {-1.f, -1.f, 0.f}).size(), 0u);
  EXPECT_EQ(hits(part, {-3.f, 3.f, 0.f}, {1.f, -1.f, 0.f}).size(), 0u);
  const auto whole = hits(part, {3.f, 3.f, 0.f}, {-1.f, -1.f, 0.f});
  EXPECT_NEAR(whole[0].uv.x, 0.5f, 1e-6f);
}

TEST(Quadric, EllipsoidFollowsItsEquation) {
  const auto shape = make_shape("Translate 1 2 3 Scale 3 -1 0.5 Shape \"sphere\"");
  RandomStream random(5, RandomUse::test);
  for (int i = 0; i < 1000; ++i) {
    const vec3 origin = 9.f * uniform_sphere(draw2(random));
    const vec3 d = glm::normalize(vec3(1.f, 2.f, 3.f) - origin);
    const auto found = all_hits(*shape, {origin, d, infinity});
    ASSERT_EQ(found.size(), 2u);
    for (const Hit& h : found) {
      const dvec3 q = (dvec3(h.position) - dvec3(1.0, 2.0, 3.0)) / dvec3(3.0, 1.0, 0.5);
      EXPECT_NEAR(glm::length(q), 1.0, 1e-5);
      const vec3 gradient(glm::normalize(q / dvec3(3.0, 1.0, 0.5)));
      EXPECT_GT(glm::dot(gradient, h.ng), 0.9999f);  // outward, although the transform mirrors
    }
  }
}

// dndu and dndv against finite differences of the normals.
TEST(Quadric, NormalDerivatives) {
  for (const char* text : {"Shape \"sphere\"", "Rotate 20 1 2 0 Scale 3 -1 0.5 Shape \"sphere\"",
                           "ReverseOrientation Scale 1 2 3 Shape \"cylinder\""}) {
    const auto shape = make_shape(text);
    for (const vec2& uv : {vec2(0.2f, 0.3f), vec2(0.7f, 0.6f), vec2(0.45f, 0.8f)}) {
      constexpr float step = 2e-3f;
      const auto at = [&](float du, float dv) {
        Hit hit;
        shape->fill(uv + step * vec2(du, dv), hit);
        return hit;
      };
      const Hit hit = at(0, 0), u0 = at(-1, 0), u1 = at(1, 0), v0 = at(0, -1), v1 = at(0, 1);
      const float two = 2.f * step;
      EXPECT_LT(glm::length((u1.ns - u0.ns) / two - hit.dndu), 0.01f) << text;
      EXPECT_LT(glm::length((v1.ns - v0.ns) / two - hit.dndv), 0.01f) << text;
      EXPECT_LT(glm::length((u1.position - u0.position) / two - hit.dpdu), 0.01f) << text;
      EXPECT_LT(glm::length((v1.position - v0.position) / two - hit.dpdv), 0.01f) << text;
    }
  }
}

TEST(Quadric, DiskAndCylinder) {
  const auto disk = hits("Shape \"disk\" \"float height\" 1 \"float innerradius\" 0.25",
                         {0.5f, 0.f, 4.f}, {0.f, 0.f, -1.f});
  ASSERT_EQ(disk.size(), 1u);
  EXPECT_FLOAT_EQ(disk[0].distance, 3.f);
  EXPECT_FLOAT_EQ(disk[0].ng.z, 1.f);
  EXPECT_NEAR(disk[0].uv.y, 2.f / 3.f, 1e-6f);
  EXPECT_EQ(
      hits("Shape \"disk\" \"float innerradius\" 0.25", {0.1f, 0.f, 4.f}, {0.f, 0.f, -1.f}).size(),
      0u);
  const auto cylinder =
      hits("Shape \"cylinder\" \"float zmax\" 3", {4.f, 0.f, 0.f}, {-1.f, 0.f, 0.5f});
  ASSERT_EQ(cylinder.size(), 2u);
  EXPECT_NEAR(cylinder[0].position.x, 1.f, 1e-6f);
  EXPECT_NEAR(cylinder[0].position.z, 1.5f, 1e-6f);
  EXPECT_NEAR(cylinder[0].ng.x, 1.f, 1e-6f);
  EXPECT_NEAR(cylinder[1].position.z, 2.5f, 1e-6f);
}

TEST(Quadric, ReverseOrientationTurnsNormals) {
  const auto reversed =
      hits("ReverseOrientation Shape \"sphere\"", {5.f, 0.f, 0.f}, {-1.f, 0.f, 0.f});
  EXPECT_NEAR(reversed[0].ng.x, -1.f, 1e-6f);
}

TEST(Quadric, BoundsHoldTheSurface) {
  for (const char* text :
       {"Rotate 20 1 2 0 Scale 3 -1 0.5 Shape \"sphere\"", "Translate 1e4 3 3 Shape \"cylinder\"",
        "Rotate 45 1 0 0 Shape \"disk\""}) {
    const auto shape = make_shape(text);
    const Bounds b = shape->bounds();
    RandomStream random(6, RandomUse::test);
    for (int i = 0; i < 2000; ++i) {
      const vec3 p = shape->sample_area(draw2(random)).position;
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(p[k] >= b.min[k] && p[k] <= b.max[k]) << text;
    }
  }
}

TEST(Quadric, WrongParametersAreErrors) {
  const auto message = [](const char* text) { return error_of([text] { make_shape(text); }); };
  EXPECT_NE(message("Shape \"sphere\" \"float radius\" -1").find("test:2"), std::string::npos);
  EXPECT_NE(message("Shape \"sphere\" \"float radius\" 0").find("positive"), std::string::npos);
  EXPECT_NE(message("Shape \"disk\" \"float innerradius\" 2").find("innerradius"),
            std::string::npos);
  EXPECT_NE(message("Shape \"cylinder\" \"float zmin\" 1").find("zmax"), std::string::npos);
  EXPECT_NE(message("Shape \"sphere\" \"float zmin\" 2").find("zmin"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
