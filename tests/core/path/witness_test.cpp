// Who is named for a spoilt sample.
#include "core/path/witness.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace pssmlt {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

struct Plugin final : PluginNamed {
  explicit Plugin(const char* name) { name_plugin("Material", name); }
};

struct FixedBsdf final : Bsdf {
  Rgb f{0.5f};
  float density = 1.f;
  bool throws = false;
  Rgb eval(const vec3&, const vec3&, Transport) const override {
    if (throws) throw std::runtime_error("no");
    return f;
  }
  float pdf(const vec3&, const vec3&) const override { return density; }
  std::optional<BsdfSample> sample(const vec3&, float, const vec2&, Transport) const override {
    return BsdfSample{.wi = vec3(0.f, 0.f, 1.f), .weight = f, .pdf = density};
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return f; }
};

const vec3 up(0.f, 0.f, 1.f);

std::string named_by(const FixedBsdf& bsdf) {
  const Plugin plugin("suspect");
  Witness witness;
  const Bsdf* const watched = witness.watch(bsdf, plugin);
  try {
    (void)watched->both_ways(up, up, Transport::radiance);
    (void)watched->sample(up, 0.f, vec2(0.f), Transport::radiance);
  } catch (const std::runtime_error&) {
  }
  return witness.culprit();
}

TEST(Witness, NamesWhatReturnsTheImpossible) {
  FixedBsdf bsdf;
  EXPECT_EQ(named_by(bsdf), "");
  bsdf.density = 1e38f;  // nearly a mirror's
  EXPECT_EQ(named_by(bsdf), "");
  for (const float bad : {nan, infinity, -infinity, -1.f}) {
    bsdf.density = bad;
    EXPECT_EQ(named_by(bsdf), "material \"suspect\"") << bad;
  }
  bsdf.density = 1.f;
  for (const float bad : {nan, infinity, -1.f, 1e38f}) {
    bsdf.f = Rgb(0.5f, bad, 0.5f);
    EXPECT_EQ(named_by(bsdf), "material \"suspect\"") << bad;
  }
  bsdf.f = Rgb(0.5f);
  bsdf.throws = true;
  EXPECT_EQ(named_by(bsdf), "material \"suspect\"");
}

TEST(Witness, NamesTheFirst) {
  const Plugin first("first"), second("second");
  Witness witness;
  witness.look_at(Rgb(1.f), second);
  witness.look_at(Rgb(nan), first);
  witness.look_at(Rgb(nan), second);
  EXPECT_EQ(witness.culprit(), "material \"first\"");
}

TEST(Witness, IsThereOnlyWhileItLives) {
  EXPECT_EQ(Witness::here(), nullptr);
  {
    Witness witness;
    EXPECT_EQ(Witness::here(), &witness);
  }
  EXPECT_EQ(Witness::here(), nullptr);
}

TEST(PluginName, IsThatOfScenes) {
  const Plugin material("diffuse");
  EXPECT_EQ(material.plugin_name(), "material \"diffuse\"");
  struct Lamp final : PluginNamed {
  } lamp;
  EXPECT_EQ(lamp.plugin_name(), "unnamed");
  lamp.name_plugin("AreaLight", "diffuse");
  EXPECT_EQ(lamp.plugin_name(), "area light \"diffuse\"");
}

}  // namespace
}  // namespace pssmlt
