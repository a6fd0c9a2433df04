// The phase function of Henyey and Greenstein, over its parameter.
#include "core/phase_function.h"

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/make_endpoint.h"

namespace pssmlt::test {
namespace {

class Phase : public testing::TestWithParam<float> {};

TEST_P(Phase, SamplesFollowTheDensityAndTheMeanCosineIsG) {
  const float g = GetParam();
  const HenyeyGreenstein phase(g);
  const vec3 wo = glm::normalize(vec3(.3f, -.5f, -.9f));
  const auto draw = [&](RandomStream& random) {
    return phase.sample(wo, 0.f, draw2(random), Transport::radiance);
  };
  const auto result = chi_square_sphere(
      [&](RandomStream& random) -> std::optional<vec3> { return draw(random)->wi; },
      [&](const vec3& wi) { return static_cast<double>(phase.pdf(wo, wi)); }, {.fine = 128});
  EXPECT_GT(result.p, false_alarm);
  RandomStream random(31, RandomUse::test);
  constexpr int samples = 100'000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < samples; ++i) {
    const auto s = draw(random);
    EXPECT_NEAR(s->pdf / phase.pdf(wo, s->wi), 1.f, 2e-3f);
    const double cosine = static_cast<double>(glm::dot(-wo, s->wi));
    sum += cosine;
    squares += cosine * cosine;
  }
  const double mean = sum / samples;
  const double error = std::sqrt((squares / samples - mean * mean) / samples);
  EXPECT_NEAR(mean, g, 5.0 * error);
}

INSTANTIATE_TEST_SUITE_P(All, Phase, testing::Values(-.9f, -.3f, 0.f, 5e-4f, 2e-3f, .5f, .85f));

}  // namespace
}  // namespace pssmlt::test
