// Instances, nested and shining ones, against the same scene written out.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "tests/support/agreement.h"
#include "tests/support/reduced.h"

namespace pssmlt::test {
namespace {

const std::string head = R"(
LookAt 0 1 -6  0 .6 0  0 1 0
Camera "perspective" "float fov" 40
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
Integrator "path" "integer maxdepth" 3
WorldBegin
Material "diffuse" "rgb reflectance" [ .6 .6 .6 ]
Shape "bilinearmesh" "point3 P" [ -4 0 4  4 0 4  -4 0 -4  4 0 -4 ]
)";
// What objects are made of; the lamp is dark behind.
const std::string ball =
    "AttributeBegin Translate .2 .3 0 Scale .2 .3 .2 Shape \"sphere\" AttributeEnd\n";
const std::string wedge =
    "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  .5 0 .1  0 .6 .3 ] \"normal N\" [ 0 0 -1  0 .6 "
    "-.8  .6 0 -.8 ]\n";
const std::string lamp =
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 5 4 3 ] Translate 0 .9 -.2\n"
    "Rotate 60 1 0 0 Shape \"disk\" \"float radius\" .15 AttributeEnd\n";
const std::vector<std::string> inner = {"Translate -.3 0 .1 Rotate 20 0 1 0",
                                        "Translate .4 .1 0 Scale -1 .8 1 Rotate 30 0 0 1"};
const std::vector<std::string> outer = {"Translate -1.2 0 0", "Translate 1 0 .3 Rotate -40 0 1 0",
                                        "Translate 0 0 1.5 Scale 1.5 1.2 -1"};

std::string placed(const std::string& transform, const std::string& content) {
  return "AttributeBegin " + transform + "\n" + content + "AttributeEnd\n";
}

std::string nested(const std::string& content) {
  std::string text = head + "ObjectBegin \"branch\"\n" + wedge;
  for (const std::string& t : inner) text += placed(t, "ObjectInstance \"leaf\"\n");
  text += "ObjectEnd\nObjectBegin \"leaf\"\n" + content + "ObjectEnd\n";
  for (const std::string& t : outer) text += placed(t, "ObjectInstance \"branch\"\n");
  return text;
}

std::string written_out(const std::string& content) {
  std::string text = head;
  for (const std::string& t : outer) {
    text += placed(t, wedge);
    for (const std::string& u : inner) text += placed(t + " " + u, content);
  }
  return text;
}

TEST(Instances, NestedOnesStandWhereTheyWouldBeWritten) {
  const BuiltScene a = build_text({nested(ball + lamp)}),
                   b = build_text({written_out(ball + lamp)});
  EXPECT_EQ(a.scene->features().instance_count, 9u);
  EXPECT_EQ(b.scene->features().instance_count, 0u);
  EXPECT_EQ(a.scene->features().lights, 6);
  EXPECT_EQ(b.scene->features().lights, 6);
  RandomStream random(3, RandomUse::test);
  int shapes = 0, lit = 0, differ = 0;
  constexpr int rays = 20'000;
  for (int i = 0; i < rays; ++i) {
    const float x = random.next();
    const float y = random.next();
    const float s = random.next();
    const float t = random.next();
    const vec3 from = 4.f * uniform_sphere({x, y}) + vec3(0.f, 0.f, 6.f);
    const vec3 to = vec3(3.f * s - 1.5f, -.3f, 6.f + 2.f * t - .7f);
    const Ray ray{from, glm::normalize(to - from), infinity};
    Hit p, q;
    const bool found = a.scene->intersect(ray, 0.f, p);
    // Rays that graze an edge may pass in one scene and hit in the other.
    if (found != b.scene->intersect(ray, 0.f, q) || std::abs(p.distance - q.distance) > 1e-4f) {
      ++differ;
      continue;
    }
    if (!found) continue;
    shapes += std::abs(p.ng.y) < .99f ? 1 : 0;
    EXPECT_GT(glm::dot(p.ng, q.ng), .9999f);
    EXPECT_GT(glm::dot(p.ns, q.ns), .9999f);
    ASSERT_EQ(p.primitive->light != nullptr, q.primitive->light != nullptr);
    const Rgb e = a.scene->emitted(p, -ray.direction), f = b.scene->emitted(q, -ray.direction);
    EXPECT_EQ(e, f);
    lit += is_black(e) ? 0 : 1;
  }
  EXPECT_GT(shapes, rays / 20);
  EXPECT_GT(lit, rays / 500);
  EXPECT_LE(differ, rays / 200);
}

// False alarms below 10^-6. Errors of 15 % in a block and of 3 % of the whole are found with power
// 0.99, which is asserted.
TEST(Instances, LampsInObjectsShineInEveryInstance) {
  if (reduced()) GTEST_SKIP() << "a picture by statistics";
  const auto blocks = [](const std::string& scene, uint64_t first_seed) {
    return summarise(render_blocks({.scene = scene, .spp = 160}, 32, 16, first_seed));
  };
  expect_agreement(blocks(nested(ball + lamp), 1), blocks(written_out(ball + lamp), 101),
                   {1e-6, .15, .03}, "lamps in instances");
}

// Parts of an object that moves keep together: each is at every time where the motion takes it.
TEST(Instances, WhatMovesTakesItsInstancesAlong) {
  const std::string move =
      "ActiveTransform EndTime Translate .5 0 0 Rotate 90 0 1 0 ActiveTransform All";
  const std::string whole = head + "ObjectBegin \"o\"\n" + placed(inner[1], ball) + wedge +
                            "ObjectEnd\n" + placed(move, "ObjectInstance \"o\"\n");
  const std::string parts = head + "ObjectBegin \"b\"\n" + ball + "ObjectEnd ObjectBegin \"o\"\n" +
                            placed(inner[1], "ObjectInstance \"b\"\n") + wedge + "ObjectEnd\n" +
                            placed(move, "ObjectInstance \"o\"\n");
  const BuiltScene a = build_text({parts}), b = build_text({whole});
  RandomStream random(4, RandomUse::test);
  int shapes = 0;
  for (int i = 0; i < 5'000; ++i) {
    const float x = random.next();
    const float y = random.next();
    const float time = random.next();
    const vec3 to(2.f * x - .5f, y - 1.f, 6.f);
    const Ray ray{vec3(0.f), glm::normalize(to), infinity, time};
    Hit p, q;
    ASSERT_EQ(a.scene->intersect(ray, 0.f, p), b.scene->intersect(ray, 0.f, q));
    EXPECT_EQ(p.position, q.position);
    shapes += std::abs(p.ng.y) < .99f ? 1 : 0;
  }
  EXPECT_GT(shapes, 200);
}

// An instance that moves may stand in an object that is turned, not in one that is stretched.
TEST(Instances, MotionInsideObjects) {
  const std::string moving = "ObjectBegin \"b\"\n" + ball + "ObjectEnd ObjectBegin \"o\"\n" +
                             placed("ActiveTransform EndTime Translate 1 0 0 ActiveTransform All",
                                    "ObjectInstance \"b\"\n") +
                             "ObjectEnd\n";
  const std::string use = "ObjectInstance \"o\"\n";
  const BuiltScene built = build_text({head + moving + placed("Rotate 90 0 1 0 Scale 2 2 2", use)});
  EXPECT_TRUE(built.scene->features().motion);
  EXPECT_THROW(build_text({head + moving + placed("Scale 1 2 1", use)}), Error);
  EXPECT_THROW(
      build_text({head + moving +
                  placed("ActiveTransform EndTime Translate 0 1 0 ActiveTransform All", use)}),
      Error);
}

// Objects that hold two of the one before: 2^40 instances are refused before memory runs out.
TEST(Instances, TooManyAreRefused) {
  std::string text = head + "ObjectBegin \"0\"\n" + ball + "ObjectEnd\n";
  for (int i = 1; i <= 40; ++i) {
    const std::string use = "ObjectInstance \"" + std::to_string(i - 1) + "\"\n";
    text += "ObjectBegin \"" + std::to_string(i) + "\"\n" + use + placed("Translate 1 0 0", use) +
            "ObjectEnd\n";
  }
  EXPECT_THROW(build_text({text + "ObjectInstance \"40\"\n"}), Error);
  EXPECT_EQ(build_text({text + "ObjectInstance \"8\"\n"}).scene->features().instance_count, 256u);
}

}  // namespace
}  // namespace pssmlt::test
