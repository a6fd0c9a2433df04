#include "core/shading_normals.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.h"
#include "core/image/image.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

// A plane with the tangents of x and y, the normal of z.
Hit plane(const vec2& uv) {
  Hit hit;
  hit.ng = hit.ns = vec3(0.f, 0.f, 1.f);
  hit.dpdu = vec3(2.f, 0.f, 0.f);
  hit.dpdv = vec3(0.f, 2.f, 0.f);
  hit.uv = uv;
  return hit;
}

void expect_near(const vec3& a, const vec3& b, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

// Two rows of one pixel: the upper one is the upper half of the picture, v > 1/2.
std::shared_ptr<const ShadingNormals> map_of(const vec3& upper, const vec3& lower) {
  Image image(1, 2, 3);
  for (int c = 0; c < 3; ++c) {
    image.pixel(0, 0)[c] = 0.5f * (upper[c] + 1.f);
    image.pixel(0, 1)[c] = 0.5f * (lower[c] + 1.f);
  }
  const std::string file = test::own_file("normals.pfm");
  write_image(file, image, {}, {});
  return bend_by_map(file);
}

TEST(NormalMap, GivesNormalsInTheTangentsFrame) {
  const vec3 tilted(0.6f, 0.f, 0.8f), other(0.f, -0.6f, 0.8f);
  const auto map = map_of(tilted, other);
  expect_near(map->frame(plane({0.5f, 0.75f})).n, tilted, 1e-6f);
  expect_near(map->frame(plane({0.5f, 0.25f})).n, other, 1e-6f);
  expect_near(map->frame(plane({0.5f, 0.75f})).s, {0.8f, 0.f, -0.6f}, 1e-6f);
  // Turned with the surface: x along dpdu, z the shading normal.
  Hit turned = plane({0.5f, 0.75f});
  turned.dpdu = vec3(0.f, 3.f, 0.f);
  expect_near(map->frame(turned).n, {0.f, 0.6f, 0.8f}, 1e-6f);
}

TEST(NormalMap, StaysOnTheGeometricSide) {
  const auto map = map_of({0.6f, 0.f, -0.8f}, {0.f, 0.f, 1.f});
  expect_near(map->frame(plane({0.5f, 0.75f})).n, {-0.6f, 0.f, 0.8f}, 1e-6f);
}

TEST(NormalMap, SaysNothingWithoutALength) {
  const auto map = map_of(vec3(0.f), vec3(0.f, 0.f, 1.f));
  expect_near(map->frame(plane({0.5f, 0.75f})).n, {0.f, 0.f, 1.f}, 0.f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_near(map->frame(plane({nan, 0.25f})).n, {0.f, 0.f, 1.f}, 0.f);
}

TEST(NormalMap, NeedsThreeChannels) {
  const std::string file = test::own_file("grey.pfm");
  write_image(file, Image(2, 2, 1), {}, {});
  EXPECT_THROW((void)bend_by_map(file), Error);
  EXPECT_THROW((void)bend_by_map(test::own_file("none.pfm")), Error);
}

class Slope final : public Texture<float> {
 public:
  float evaluate(const Hit& hit) const override { return 0.5f * hit.uv.x; }
};

// The height grows by 0.5 over dpdu's length 2: by 0.25 a metre.
TEST(HeightField, BendsAgainstTheSlope) {
  const auto bend = bend_by_height(std::make_shared<Slope>());
  expect_near(bend->frame(plane({0.3f, 0.3f})).n, glm::normalize(vec3(-0.25f, 0.f, 1.f)), 1e-4f);
}

}  // namespace
}  // namespace pssmlt
