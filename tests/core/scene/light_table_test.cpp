#include "core/scene/light_table.h"

#include <gtest/gtest.h>

namespace pssmlt {
namespace {

class Lamp final : public Light {
 public:
  Lamp(float power, EndpointTraits traits) : power_(power), traits_(traits) {}
  EndpointTraits traits() const override { return traits_; }
  float power() const override { return power_; }
  std::optional<Emission> emit(const vec2&, const dvec2&) const override { return std::nullopt; }
  std::optional<Toward> toward(const vec3&, const vec2&) const override { return std::nullopt; }
  EmissionValue evaluate(const EndpointPoint&, const vec3&) const override { return {}; }
  float pdf_toward(const vec3&, const EndpointPoint&) const override { return 0.f; }

 private:
  float power_;
  EndpointTraits traits_;
};

TEST(LightTable, ProbabilitiesAreMostlyByPower) {
  const Lamp weak(1.f, {}), strong(9.f, {.infinite = true}), dark(0.f, {});
  const Lamp sun(30.f, {.delta_direction = true, .infinite = true});
  const LightTable table({&weak, &dark, &strong, &sun});
  EXPECT_EQ(table.all().size(), 3u);
  EXPECT_EQ(table.infinite(), std::vector<const Light*>{&strong});
  EXPECT_NEAR(table.probability(&weak), 0.9 / 40 + 0.1 / 3, 1e-6);
  EXPECT_NEAR(table.probability(&sun), 0.9 * 30 / 40 + 0.1 / 3, 1e-6);
  EXPECT_EQ(table.probability(&dark), 0.f);
  // The shares of u are the probabilities.
  std::unordered_map<const Light*, double> found;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const auto choice = table.choose((static_cast<float>(i) + 0.5f) / n);
    EXPECT_EQ(choice.probability, table.probability(choice.light));
    found[choice.light] += 1.0 / n;
  }
  for (const Light* light : table.all()) EXPECT_NEAR(found[light], table.probability(light), 3e-5);
  EXPECT_EQ(table.choose(0.f).light, &weak);
  EXPECT_EQ(table.choose(one_minus_epsilon).light, &sun);
}

TEST(LightTable, NoLightsAndEndlessPower) {
  EXPECT_EQ(LightTable().choose(0.5f).light, nullptr);
  const Lamp endless(infinity, {}), one(1.f, {});
  const LightTable table({&endless, &one});
  EXPECT_NEAR(table.probability(&one), 0.05f, 1e-6f);
}

}  // namespace
}  // namespace pssmlt
