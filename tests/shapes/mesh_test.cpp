// Meshes: sides, derivatives, degenerate input, bilinear patches, subdivision, glTF.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/warp.h"
#include "core/shapes/loop_subdivision.h"
#include "tests/support/all_hits.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/mesh_files.h"

namespace pssmlt {
namespace {

using namespace test;

constexpr const char* triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]";

Hit center(const std::string& text) {
  Hit hit;
  make_shape(text)->fill({0.25f, 0.25f}, hit);
  return hit;
}

std::string message(const std::string& text) {
  return error_of([&] { make_shape(text); });
}

TEST(Mesh, SidesFollowOrientationAndMirroring) {
  const std::string t = triangle;
  EXPECT_FLOAT_EQ(center(t).ng.z, 1.f);
  EXPECT_FLOAT_EQ(center("ReverseOrientation " + t).ng.z, -1.f);
  // A mirror in x keeps the outside where it was, at +z.
  EXPECT_FLOAT_EQ(center("Scale -1 1 1 " + t).ng.z, 1.f);
  EXPECT_FLOAT_EQ(center("ReverseOrientation Scale -1 1 1 " + t).ng.z, -1.f);
  // Vertex normals decide over the index order.
  const std::string down = t + " \"normal N\" [0 0 -1 0 0 -1 0 1 -1]";
  EXPECT_FLOAT_EQ(center(down).ng.z, -1.f);
  EXPECT_LT(center(down).ns.z, -0.9f);
  EXPECT_FLOAT_EQ(center("ReverseOrientation " + down).ng.z, 1.f);
  const SurfaceSample s = make_shape(down)->sample_area({0.3f, 0.4f});
  EXPECT_FLOAT_EQ(s.normal.z, -1.f);
}

TEST(Mesh, DerivativesFollowTextureCoordinates) {
  const Hit plain = center(triangle);
  EXPECT_NEAR(plain.uv.x, 0.5f, 1e-6f);
  EXPECT_NEAR(plain.uv.y, 0.25f, 1e-6f);
  const Hit given = center(std::string(triangle) + " \"point2 uv\" [0 0 2 0 0 4]");
  EXPECT_NEAR(given.dpdu.x, 0.5f, 1e-6f);
  EXPECT_NEAR(given.dpdv.y, 0.25f, 1e-6f);
  // Coordinates without area: any frame will do, but it must be one.
  const Hit flat = center(std::string(triangle) + " \"point2 uv\" [1 1 1 1 1 1]");
  EXPECT_NEAR(std::abs(glm::dot(glm::normalize(glm::cross(flat.dpdu, flat.dpdv)), flat.ng)), 1.f,
              1e-5f);
  const Hit bent = center(std::string(triangle) +
                          " \"normal N\" [0 0 1 1 0 1 0 0 1] \"point2 uv\" [0 0 1 0 0 1]");
  EXPECT_GT(bent.dndu.x, 0.5f);
  EXPECT_NEAR(bent.dndv.x, 0.f, 1e-6f);
  const Hit tangent = center(std::string(triangle) + " \"vector3 S\" [1 1 0 1 1 0 1 1 0]");
  EXPECT_NEAR(tangent.dpdu.x, tangent.dpdu.y, 1e-5f);
}

// The interpolated position is within its error bound of the exact one.
TEST(Mesh, ErrorBoundHolds) {
  RandomStream random(1, RandomUse::test);
  const auto shape = make_shape(
      "Shape \"trianglemesh\" \"point3 P\" [1000.1 -3.7 0.01 1003.3 5.9 2.2 998 7.1 -9]");
  const TriangleMesh& m = *shape->mesh();
  for (int i = 0; i < 2000; ++i) {
    vec2 b = draw2(random);
    if (b.x + b.y > 1.f) b = vec2(1.f) - b;
    Hit hit;
    shape->fill(b, hit);
    const double b0 = 1.0 - b.x - b.y;
    const dvec3 exact = b0 * dvec3(m.positions[0]) + double(b.x) * dvec3(m.positions[1]) +
                        double(b.y) * dvec3(m.positions[2]);
    for (int k = 0; k < 3; ++k) EXPECT_LE(std::abs(exact[k] - hit.position[k]), hit.error[k]);
  }
}

TEST(Mesh, TrianglesWithoutAreaAreLeftOut) {
  const auto shape = make_shape(
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 1 1 0 3 4 2 1 0]"
      "\"point3 P\" [0 0 0 1 0 0 0 1 0 2 2 2 4 4 4]");
  EXPECT_EQ(shape->mesh()->triangles.size(), 2u);
  EXPECT_FLOAT_EQ(shape->area(), 1.f);
  const auto empty = make_shape("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2]");
  EXPECT_EQ(empty->area(), 0.f);
  EXPECT_EQ(empty->sample_area({0.5f, 0.5f}).pdf, 0.f);
  EXPECT_FALSE(empty->sample_toward({1.f, 2.f, 5.f}, {0.5f, 0.5f}).has_value());
}

TEST(Mesh, WrongMeshesAreLocatedErrors) {
  const std::string p = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] ";
  EXPECT_NE(message(p + "\"integer indices\" [0 1 4]").find("test:2:"), std::string::npos);
  EXPECT_NE(message(p + "\"integer indices\" [0 1 4]").find("out of range"), std::string::npos);
  EXPECT_NE(message(p + "\"integer indices\" [0 1 -1]").find("negative"), std::string::npos);
  EXPECT_NE(message(p + "\"integer indices\" [0 1]").find("multiple of three"), std::string::npos);
  EXPECT_NE(message(p).find("indices"), std::string::npos);
  EXPECT_NE(message(p + "\"integer indices\" [0 1 2] \"normal N\" [0 0 1]").find("normals"),
            std::string::npos);
  EXPECT_NE(message(p + "\"integer indices\" [0 1 2] \"point2 uv\" [0 0]").find("texture"),
            std::string::npos);
  EXPECT_NE(message("Shape \"trianglemesh\"").find("\"P\""), std::string::npos);
}

TEST(Patch, ParallelogramsBecomeTriangles) {
  const auto flat =
      make_shape("Shape \"bilinearmesh\" \"point3 P\" [.1 .2 .3 1.4 .2 .3 .1 1.7 .3 1.4 1.7 .3]");
  ASSERT_NE(flat->mesh(), nullptr);
  EXPECT_NEAR(flat->area(), 1.95f, 1e-5f);
  EXPECT_EQ(make_shape("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 .1]")->mesh(),
            nullptr);
  // Both agree on side and coordinates.
  const Ray ray{{0.7f, 0.9f, 2.f}, {0.f, 0.f, -1.f}, infinity};
  const Hit a = all_hits(*flat, ray).at(0);
  const auto patch = make_shape(
      "Shape \"bilinearmesh\" \"point3 P\" [.1 .2 .3 1.4 .2 .3 .1 1.7 .3 1.4 1.7 .3]"
      "\"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1]");
  ASSERT_EQ(patch->mesh(), nullptr);
  const Hit b = all_hits(*patch, ray).at(0);
  EXPECT_LT(glm::distance(a.position, b.position), 1e-6f);
  EXPECT_LT(glm::distance(a.uv, b.uv), 1e-6f);
  EXPECT_GT(glm::dot(a.ng, b.ng), 0.9999f);
  EXPECT_LT(glm::distance(a.dpdu, b.dpdu), 1e-5f);
  EXPECT_LT(glm::distance(a.dpdv, b.dpdv), 1e-5f);
}

// A saddle z = x y over the unit square, against the closed form of its intersection with rays.
TEST(Patch, SaddleIsExact) {
  const auto saddle = make_shape("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1]");
  RandomStream random(8, RandomUse::test);
  for (int i = 0; i < 3000; ++i) {
    const vec2 xy = draw2(random);
    const dvec3 exact(xy.x, xy.y, double(xy.x) * double(xy.y));
    const vec3 origin = vec3(exact) + 3.f * uniform_sphere(draw2(random));
    const vec3 d = glm::normalize(vec3(exact) - origin);
    // A ray along the surface is moved by the rounding of its direction, in a position by the root.
    const vec3 n = glm::normalize(vec3(-xy.y, -xy.x, 1.f));
    bool found = std::abs(glm::dot(n, d)) < 1e-3f;
    for (const Hit& hit : all_hits(*saddle, {origin, d, infinity})) {
      EXPECT_NEAR(hit.position.z, hit.position.x * hit.position.y, 1e-6f);
      found = found || glm::distance(dvec3(hit.position), exact) < 1e-4;
    }
    EXPECT_TRUE(found || std::min({xy.x, xy.y, 1.f - xy.x, 1.f - xy.y}) < 1e-4f);
  }
}

// A strip of many patches is searched by boxes: as many hits as without them.
TEST(Patch, ManyPatchesAreAllFound) {
  std::string points, indices;
  constexpr int n = 50;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2; ++j)
      points += std::to_string(i) + " " + std::to_string(j) + " " +
                std::to_string((i * 7 + j * 3) % 5 * 0.1) + " ";
  for (int i = 0; i < n; ++i)
    indices += std::to_string(2 * i) + " " + std::to_string(2 * i + 2) + " " +
               std::to_string(2 * i + 1) + " " + std::to_string(2 * i + 3) + " ";
  const auto strip = make_shape("Shape \"bilinearmesh\" \"point3 P\" [" + points +
                                "] \"integer indices\" [" + indices + "]");
  for (int i = 0; i < n; ++i) {
    const auto found = all_hits(*strip, {{i + 0.37f, 0.41f, 5.f}, {0.f, 0.f, -1.f}, infinity});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].element, static_cast<uint32_t>(i));
  }
}

SubdivisionMesh tetrahedron() {
  return {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TEST(Loop, OneStepOfATetrahedron) {
  const SubdivisionMesh fine = subdivide(tetrahedron());
  ASSERT_EQ(fine.positions.size(), 10u);
  ASSERT_EQ(fine.triangles.size(), 16u);
  // Valence 3: 7/16 of the vertex and 3/16 of each of the others, whose sum is minus the vertex.
  for (size_t i = 0; i < 4; ++i)
    EXPECT_LT(glm::distance(fine.positions[i], 0.25 * tetrahedron().positions[i]), 1e-12);
  // An edge: 3/8 (a + b) + 1/8 (c + d) = 1/4 (a + b), since a + b + c + d = 0.
  for (size_t i = 4; i < 10; ++i) EXPECT_NEAR(glm::length(fine.positions[i]), 0.5, 1e-12);
}

TEST(Loop, RegularPlaneStaysPlanarAndBoundaryIsASpline) {
  const SubdivisionMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                               {{0, 1, 2}, {0, 2, 3}}};
  const SubdivisionMesh fine = subdivide(square);
  ASSERT_EQ(fine.positions.size(), 9u);
  // Boundary vertices: 3/4 of themselves and 1/8 of both neighbours; edges: midpoints.
  EXPECT_LT(glm::distance(fine.positions[0], dvec3(0.125, 0.125, 0.0)), 1e-12);
  const LimitSurface limit = limit_surface(subdivide(fine));
  for (size_t i = 0; i < limit.positions.size(); ++i) {
    EXPECT_EQ(limit.positions[i].z, 0.0);
    EXPECT_NEAR(limit.normals[i].z, 1.f, 1e-6f);
  }
}

// Limit positions do not depend on how often the mesh was divided before.
TEST(Loop, LimitIsALimit) {
  SubdivisionMesh mesh = tetrahedron();
  const LimitSurface coarse = limit_surface(mesh);
  for (int i = 0; i < 4; ++i) mesh = subdivide(mesh);
  const LimitSurface fine = limit_surface(mesh);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_LT(glm::distance(coarse.positions[i], fine.positions[i]), 1e-9);
    EXPECT_GT(glm::dot(glm::normalize(vec3(fine.positions[i])), fine.normals[i]), 0.999f);
  }
}

TEST(Loop, ShapeIsClosedAndOutward) {
  const auto shape = make_shape(
      "Shape \"loopsubdiv\" \"integer levels\" 4 \"integer indices\" [0 2 1 0 1 3 0 3 2 1 2 3]"
      "\"point3 P\" [1 1 1 -1 -1 1 -1 1 -1 1 -1 -1]");
  EXPECT_EQ(shape->mesh()->triangles.size(), 4u * 256u);
  RandomStream random(4, RandomUse::test);
  for (int i = 0; i < 300; ++i) {
    const auto found = all_hits(*shape, {vec3(0.f), uniform_sphere(draw2(random)), infinity});
    ASSERT_GE(found.size(), 1u);
    EXPECT_GT(glm::dot(found[0].ng, found[0].position), 0.f);
    EXPECT_GT(glm::dot(found[0].ns, found[0].ng), 0.7f);
  }
}

TEST(Loop, WhatIsNoSurfaceIsAnError) {
  const auto loop = [](const std::string& indices) {
    return message(
        "Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1 1 1 1] \"integer indices\" [" +
        indices + "]");
  };
  EXPECT_EQ(loop("0 1 2 0 2 3"), "");
  EXPECT_NE(loop("0 1 2 0 1 3").find("test:2"), std::string::npos);         // orientation
  EXPECT_NE(loop("0 1 2 1 0 3 0 1 4").find("surface"), std::string::npos);  // three at an edge
  EXPECT_NE(loop("0 1 2 0 3 4").find("fan"), std::string::npos);            // two fans touch
  EXPECT_NE(loop("0 1 7").find("range"), std::string::npos);
  EXPECT_NE(loop("0 1 1").find("twice"), std::string::npos);
}

TEST(Gltf, NodesAreApplied) {
  const auto shape = make_shape("Shape \"gltf\" \"string filename\" \"" +
                                write_file("pssmlt-test.gltf", gltf("44")) + "\"");
  ASSERT_EQ(shape->mesh()->triangles.size(), 1u);
  EXPECT_FLOAT_EQ(shape->area(), 1.f);
  const auto found = all_hits(*shape, {{9.f, 0.2f, 3.f}, {0.f, 0.f, -1.f}, infinity});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FLOAT_EQ(found[0].ng.z, 1.f);
}

TEST(Gltf, BrokenFilesAreLocatedErrors) {
  const auto load = [](const std::string& name, const std::string& content) {
    return message("Shape \"gltf\" \"string filename\" \"" + write_file(name, content) + "\"");
  };
  for (const std::string& bad :
       {std::string("{"), std::string("nonsense"), gltf("44").substr(0, 300), gltf("44", "7"),
        std::string("{\"asset\":{\"version\":\"2.0\"}}")})
    EXPECT_NE(load("pssmlt-bad.gltf", bad).find("test:2:"), std::string::npos) << bad;
  EXPECT_NE(load("pssmlt-bad.glb", "glTF").find("test:2:"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
