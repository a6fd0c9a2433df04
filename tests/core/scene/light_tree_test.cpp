// The hierarchy of lights as a distribution: complete, followed by what is chosen, and positive
// where there is light.
#include "core/scene/light_tree.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "tests/support/statistics.h"

namespace pssmlt {
namespace {

vec3 random_direction(RandomStream& random) {
  const float x = random.next();
  const float y = random.next();
  return uniform_sphere({x, y});
}
vec3 random_point(RandomStream& random, float size) {
  const float x = random.next();
  const float y = random.next();
  const float z = random.next();
  return size * (2.f * vec3(x, y, z) - 1.f);
}

// Small flat lamps, balls and spots, of powers over four decades.
std::vector<LightBounds> random_lights(int count, float size, uint64_t seed) {
  RandomStream random(seed, RandomUse::test);
  std::vector<LightBounds> lights;
  for (int i = 0; i < count; ++i) {
    LightBounds b;
    const vec3 at = random_point(random, size);
    b.box.add(at);
    b.box.add(at + 0.05f * random_point(random, 1.f));
    b.normals = {random_direction(random), 1.f};
    const float kind = random.next();
    if (kind < 0.2f) b.normals = DirectionCone();
    if (kind > 0.8f) b.normals.cosine = b.cos_spread = 0.8f;
    b.two_sided = kind > 0.4f && kind < 0.5f;
    b.intensity = std::pow(10.f, 4.f * random.next() - 2.f);
    lights.push_back(b);
  }
  return lights;
}

std::vector<LightReceiver> random_receivers(int count, float size, uint64_t seed) {
  RandomStream random(seed, RandomUse::test);
  std::vector<LightReceiver> out;
  for (int i = 0; i < count; ++i) {
    LightReceiver at{.position = random_point(random, size)};
    if (i % 3 != 0) at.normal = random_direction(random);
    at.transmits = i % 3 == 1;
    out.push_back(at);
  }
  return out;
}

double sum_of(const LightTree& tree, size_t lights, const LightReceiver& at) {
  double sum = 0.0;
  for (uint32_t i = 0; i < lights; ++i) sum += tree.probability(at, i);
  return sum;
}

TEST(LightTree, ProbabilitiesSumToOne) {
  for (const int count : {2, 3, 8, 100, 3000}) {
    const auto lights = random_lights(count, 1.f, 5);
    const LightTree tree(lights);
    for (const LightReceiver& at : random_receivers(60, 2.f, 6)) {
      EXPECT_NEAR(sum_of(tree, lights.size(), at), 1.0, 1e-10);
    }
    // On a light, and so far away that all is one point.
    EXPECT_NEAR(sum_of(tree, lights.size(), {lights[0].box.min}), 1.0, 1e-10);
    EXPECT_NEAR(sum_of(tree, lights.size(), {vec3(1e9f)}), 1.0, 1e-10);
    EXPECT_NEAR(sum_of(tree, lights.size(), {vec3(1e30f)}), 1.0, 1e-10);
  }
}

// Chi-square over all lights at a receiver, 27 of them: false alarms below 3e-6 with any seed.
TEST(LightTree, ChoicesFollowTheProbabilities) {
  const auto lights = random_lights(60, 1.f, 7);
  const LightTree tree(lights);
  RandomStream random(8, RandomUse::test);
  constexpr int samples = 60'000;
  for (const LightReceiver& at : random_receivers(27, 1.5f, 9)) {
    std::vector<double> counts(2), expected(2);  // the first bin holds all that are rare
    std::vector<size_t> bin(lights.size(), 0);
    for (uint32_t i = 0; i < lights.size(); ++i) {
      const double share = samples * tree.probability(at, i);
      if (share < 10.0) {
        expected[0] += share;
        continue;
      }
      bin[i] = expected.size();
      expected.push_back(share);
      counts.push_back(0.0);
    }
    for (int i = 0; i < samples; ++i) {
      const auto choice = tree.choose(at, random.next_double());
      EXPECT_NEAR(choice.probability / tree.probability(at, choice.light), 1.0, 1e-14);
      ++counts[bin[choice.light]];
    }
    EXPECT_GE(test::chi_square_p(counts, expected), test::false_alarm);
  }
}

// Equal steps of the number find every light as often as its probability says, to the step.
TEST(LightTree, OneNumberIsEnoughForManyLights) {
  const auto lights = random_lights(2000, 1.f, 10);
  const LightTree tree(lights);
  const LightReceiver at{.position = vec3(.3f, .2f, 4.f), .normal = vec3(0.f, 0.f, -1.f)};
  constexpr int steps = 2'000'000;
  std::vector<int> found(lights.size());
  for (int i = 0; i < steps; ++i) ++found[tree.choose(at, (i + 0.5) / steps).light];
  for (uint32_t i = 0; i < lights.size(); ++i) {
    EXPECT_NEAR(found[i], steps * tree.probability(at, i), 1.001);
  }
}

// Whatever light can come from a point of the light in a direction that it shines in, to the lit
// side of the receiver, the light can be chosen.
TEST(LightTree, IsPositiveWhereLightArrives) {
  const auto lights = random_lights(300, 1.f, 11);
  const LightTree tree(lights);
  RandomStream random(12, RandomUse::test);
  int lit = 0;
  for (const LightReceiver& at : random_receivers(300, 2.f, 13)) {
    for (uint32_t i = 0; i < lights.size(); ++i) {
      const LightBounds& b = lights[i];
      const float t = random.next();
      const vec3 d = at.position - (b.box.min + t * (b.box.max - b.box.min));
      const vec3 direction = glm::normalize(d);
      if (at.normal != vec3(0.f) && !at.transmits && !(glm::dot(at.normal, -direction) > 0.f))
        continue;
      const float shown = glm::dot(b.normals.axis, direction);
      const float off = std::acos(std::clamp(b.two_sided ? std::abs(shown) : shown, -1.f, 1.f)) -
                        std::acos(b.normals.cosine);
      if (!(off < std::acos(b.cos_spread))) continue;
      ++lit;
      EXPECT_GT(tree.probability(at, i), 0.0);
    }
  }
  EXPECT_GT(lit, 20'000);
}

// The nearer, the brighter and the one that faces is likelier.
TEST(LightTree, PrefersWhatMatters) {
  LightBounds lamp;
  lamp.normals = {vec3(0.f, 0.f, -1.f), 1.f};
  lamp.intensity = 1.f;
  const auto pair = [&](auto change) {
    std::vector<LightBounds> lights(2, lamp);
    lights[0].box.add(vec3(-1.f, 0.f, 1.f));
    lights[1].box.add(vec3(1.f, 0.f, 1.f));
    change(lights[0]);
    const LightTree tree(lights);
    return tree.probability({.position = vec3(0.f), .normal = vec3(0.f, 0.f, 1.f)}, 0);
  };
  EXPECT_NEAR(pair([](LightBounds&) {}), 0.5, 1e-6);
  EXPECT_NEAR(pair([](LightBounds& b) { b.intensity = 3.f; }), 0.75, 1e-6);
  EXPECT_EQ(pair([](LightBounds& b) { b.normals.axis.z = 1.f; }), 0.0);
  EXPECT_NEAR(pair([](LightBounds& b) { b.normals.axis.z = 1.f, b.two_sided = true; }), 0.5, 1e-6);
  EXPECT_LT(pair([](LightBounds& b) { b.box.min.z = b.box.max.z = 3.f; }), 0.45);
  EXPECT_EQ(pair([](LightBounds& b) { b.box.min.z = b.box.max.z = -1.f; }), 0.0);
}

// Lights in one point, in a line, and so placed that bins would cut off one at a time.
TEST(LightTree, BuildsWhatCannotBeDivided) {
  LightBounds lamp;
  lamp.intensity = 1.f;
  for (const float ratio : {0.f, 1.f, 3.f}) {
    std::vector<LightBounds> lights;
    float x = 1e-9f;
    for (int i = 0; i < 300; ++i) {
      LightBounds b = lamp;
      b.box.add(vec3(ratio == 0.f ? 1.f : x, 0.f, 0.f));
      lights.push_back(b);
      x = ratio == 3.f ? std::min(3.f * x, 1e17f) : x + 1.f;
    }
    const LightTree tree(lights);
    EXPECT_NEAR(sum_of(tree, lights.size(), {vec3(0.f, 2.f, 0.f)}), 1.0, 1e-10);
  }
}

TEST(LightTree, HundredThousandLightsAreCheap) {
  const auto lights = random_lights(100'000, 10.f, 14);
  const LightTree tree(lights);
  EXPECT_LE(tree.bytes(), lights.size() * 130);
  for (const LightReceiver& at : random_receivers(3, 10.f, 15)) {
    EXPECT_NEAR(sum_of(tree, lights.size(), at), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace pssmlt
