// A walk over the registry: every medium keeps the laws that free flight and its density stand on.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_medium.h"

namespace pssmlt::test {
namespace {

class AnyMedium : public testing::TestWithParam<std::string> {
 protected:
  AnyMedium() {
    const auto text = sample_medium(GetParam());
    if (text) medium_ = make_medium("Translate .1 .2 .3 Rotate 20 1 2 3 Scale 1.5 1.2 1\n" + *text);
  }
  // From around the medium through it, some from inside.
  Ray random_ray(RandomStream& random) const {
    const float away = 2.f * random.next();
    const vec3 from = vec3(.8f) + away * uniform_sphere(draw2(random));
    const vec3 to = vec3(.8f) + .5f * uniform_sphere(draw2(random));
    return {from, glm::normalize(to - from), .2f + 4.f * random.next()};
  }
  std::shared_ptr<const Medium> medium_;  // null: needs a file
};

// The optical depth is the integral of the extinction, by the midpoint rule; float sums of up to
// some hundred cells, and the rule's own error at the kinks.
TEST_P(AnyMedium, OpticalDepthIntegratesTheExtinction) {
  if (!medium_) return;
  RandomStream random(21, RandomUse::test);
  double total = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Ray ray = random_ray(random);
    constexpr int steps = 4000;
    dvec3 sum(0.0);
    for (int k = 0; k < steps; ++k) {
      const float t = ray.t_max * (static_cast<float>(k) + .5f) / steps;
      sum += dvec3(medium_->at(ray.origin + t * ray.direction).extinction);
    }
    sum *= static_cast<double>(ray.t_max) / steps;
    const Rgb depth = medium_->optical_depth(ray);
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(depth[c], sum[c], 2e-3 * sum[c] + 1e-4) << i;
      total += sum[c];
    }
  }
  EXPECT_GT(total, 10.0) << "the rays miss the medium";
}

TEST_P(AnyMedium, DistanceInvertsTheOpticalDepth) {
  if (!medium_) return;
  RandomStream random(22, RandomUse::test);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray = random_ray(random);
    const float target = -std::log1p(-random.next());
    const int channel = i % 3;
    const float whole = medium_->optical_depth(ray)[channel];
    const auto t = medium_->distance(ray, channel, target);
    if (!t) {
      ASSERT_LE(whole, target * (1.f + 1e-4f) + 1e-6f);
      continue;
    }
    ++found;
    ASSERT_GE(*t, 0.f);
    ASSERT_LE(*t, ray.t_max);
    ray.t_max = *t;
    const float sigma = medium_->at(ray.origin + *t * ray.direction).extinction[channel];
    ASSERT_NEAR(medium_->optical_depth(ray)[channel], target,
                1e-4f * target + 1e-6f + 4e-6f * sigma * (1.f + *t));
  }
  EXPECT_GT(found, 100);
}

TEST_P(AnyMedium, LosesAtLeastWhatItScatters) {
  if (!medium_) return;
  RandomStream random(23, RandomUse::test);
  const MediumTraits traits = medium_->traits();
  for (int i = 0; i < 5000; ++i) {
    const vec2 xy = draw2(random);
    const MediumPoint p = medium_->at(2.f * vec3(xy, random.next()));
    ASSERT_TRUE(is_valid(p.extinction) && is_valid(p.scattering) && is_valid(p.emission));
    for (int c = 0; c < 3; ++c) {
      ASSERT_LE(p.scattering[c], p.extinction[c] * (1.f + 1e-5f) + 1e-6f);
    }
    ASSERT_TRUE(traits.scatters || is_black(p.scattering));
    ASSERT_TRUE(traits.emits || is_black(p.emission));
  }
}

// Behind an empty stretch, and without an end.
TEST_P(AnyMedium, StandsInfiniteRays) {
  if (!medium_) return;
  for (const vec3& direction :
       {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, -1), glm::normalize(vec3(1, 2, 3))}) {
    for (const vec3& origin : {vec3(0.f), vec3(.8f), vec3(1e6f, 0.f, -3.f), -5.f * direction}) {
      const Ray ray{origin, direction, infinity};
      const Rgb depth = medium_->optical_depth(ray);
      for (int c = 0; c < 3; ++c) ASSERT_GE(depth[c], 0.f);  // false for NaN
      medium_->distance(ray, 0, 1e30f);
    }
  }
}

TEST_P(AnyMedium, PhaseFunctionIsADensity) {
  if (!medium_) return;
  BsdfStorage storage;
  const Bsdf& phase = *medium_->phase(vec3(.8f), storage);
  const vec3 wo = glm::normalize(vec3(1.f, -2.f, .5f));
  const auto result = chi_square_sphere(
      [&](RandomStream& random) -> std::optional<vec3> {
        const float lobe = random.next();
        const auto s = phase.sample(wo, lobe, draw2(random), Transport::radiance);
        return s ? std::optional(s->wi) : std::nullopt;
      },
      [&](const vec3& wi) { return static_cast<double>(phase.pdf(wo, wi)); }, {.fine = 64});
  EXPECT_GT(result.p, false_alarm);
  EXPECT_NEAR(result.integral + result.failures, 1.0, 3e-3);
  RandomStream random(24, RandomUse::test);
  for (int i = 0; i < 1000; ++i) {
    const vec3 wi = uniform_sphere(draw2(random));
    const Rgb value = phase.eval(wo, wi, Transport::radiance);
    EXPECT_EQ(value, phase.eval(wi, wo, Transport::importance));
    EXPECT_NEAR(value.x, phase.pdf(wo, wi), 1e-6f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyMedium, testing::ValuesIn(Registry::instance().names("medium")),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace pssmlt::test
