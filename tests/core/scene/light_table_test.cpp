#include "core/scene/light_table.h"

#include <gtest/gtest.h>

#include <memory>

namespace pssmlt {
namespace {

class Lamp final : public Light {
 public:
  Lamp(float power, EndpointTraits traits) : power_(power), traits_(traits) {}
  EndpointTraits traits() const override { return traits_; }
  float power() const override { return power_; }
  std::optional<LightBounds> bounds() const override { return bounds_; }
  void place(const vec3& at) {
    bounds_.emplace();
    bounds_->box.add(at);
    bounds_->intensity = power_ / (4.f * pi);
  }
  std::optional<Emission> emit(const vec2&, const dvec2&) const override { return std::nullopt; }
  std::optional<Toward> toward(const vec3&, const vec2&) const override { return std::nullopt; }
  EmissionValue evaluate(const EndpointPoint&, const vec3&) const override { return {}; }
  float pdf_toward(const vec3&, const EndpointPoint&) const override { return 0.f; }

 private:
  float power_;
  EndpointTraits traits_;
  std::optional<LightBounds> bounds_;
};

// A line of lamps at x = 0, 1, 2, ...
std::vector<std::unique_ptr<Lamp>> line_of_lamps(int count) {
  std::vector<std::unique_ptr<Lamp>> lamps;
  for (int i = 0; i < count; ++i) {
    lamps.push_back(std::make_unique<Lamp>(1.f, EndpointTraits{}));
    lamps.back()->place(vec3(static_cast<float>(i), 0.f, 0.f));
  }
  return lamps;
}
std::vector<const Light*> pointers(const std::vector<std::unique_ptr<Lamp>>& lamps) {
  std::vector<const Light*> out;
  for (const auto& lamp : lamps) out.push_back(lamp.get());
  return out;
}

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

// Few lights are chosen as for emission, wherever one looks from.
TEST(LightTable, TheHierarchyStartsAtEightLights) {
  const auto lamps = line_of_lamps(8);
  auto lights = pointers(lamps);
  const LightReceiver at{.position = vec3(0.f, 1.f, 0.f)};
  const LightTable many(lights);
  EXPECT_TRUE(many.by_place(LightPick::bvh));
  EXPECT_FALSE(many.by_place(LightPick::power));
  EXPECT_GT(many.probability(LightPick::bvh, at, lights[0]),
            2.f * many.probability(LightPick::bvh, at, lights[7]));
  lights.pop_back();
  const LightTable few(lights);
  EXPECT_FALSE(few.by_place(LightPick::bvh));
  for (int i = 0; i < 1000; ++i) {
    const double u = (i + 0.5) / 1000;
    const auto drawn = few.choose(LightPick::bvh, at, u), emitted = few.choose(u);
    EXPECT_EQ(drawn.light, emitted.light);
    EXPECT_EQ(drawn.probability, emitted.probability);
  }
}

// With lights at infinity and of unknown extent beside the hierarchy: every pick is a distribution,
// choose() follows it, and no light is ever left out.
TEST(LightTable, EveryPickIsADistribution) {
  const auto lamps = line_of_lamps(20);
  auto lights = pointers(lamps);
  const Lamp sky(500.f, {.infinite = true}), stranger(2.f, {});
  Lamp hidden(1e-6f, {});
  hidden.place(vec3(30.f, 0.f, -5.f));
  lights.insert(lights.end(), {&sky, &stranger, &hidden});
  const LightTable table(lights, {vec3(0.f), 25.f});
  for (const LightPick pick : {LightPick::bvh, LightPick::power, LightPick::uniform}) {
    for (const float x : {-40.f, 3.2f, 19.f}) {
      const LightReceiver at{.position = vec3(x, .5f, 0.f), .normal = vec3(0.f, 0.f, 1.f)};
      double sum = 0.0;
      for (const Light* light : lights) {
        EXPECT_GT(table.probability(pick, at, light), 0.f);
        sum += static_cast<double>(table.probability(pick, at, light));
      }
      EXPECT_NEAR(sum, 1.0, 1e-5);
      std::unordered_map<const Light*, double> found;
      constexpr int n = 1'000'000;
      for (int i = 0; i < n; ++i) {
        const auto choice = table.choose(pick, at, (i + 0.5) / n);
        EXPECT_EQ(choice.probability, table.probability(pick, at, choice.light));
        EXPECT_EQ(choice.emission, table.probability(choice.light));
        found[choice.light] += 1.0 / n;
      }
      for (const Light* light : lights)
        EXPECT_NEAR(found[light], table.probability(pick, at, light), 5e-6);
    }
  }
}

TEST(LightTable, NoLightsAndEndlessPower) {
  EXPECT_EQ(LightTable().choose(0.5f).light, nullptr);
  const Lamp endless(infinity, {}), one(1.f, {});
  const LightTable table({&endless, &one});
  EXPECT_NEAR(table.probability(&one), 0.05f, 1e-6f);
}

}  // namespace
}  // namespace pssmlt
