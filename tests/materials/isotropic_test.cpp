// Materials and textures that ask hits for no derivatives are taken at their word: rays then find
// points without them. Every registered plugin that says so is held to it.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/make_plugin.h"

namespace pssmlt {
namespace {

using namespace test;

Hit with_derivatives() {
  Hit hit;
  hit.position = {0.3f, 0.7f, 0.2f};
  hit.ng = hit.ns = {0.f, 0.f, 1.f};
  hit.uv = {0.37f, 0.61f};
  hit.footprint = 0.05f;
  hit.dpdu = {2.f, 0.5f, 0.f};
  hit.dpdv = {-0.3f, 1.5f, 0.f};
  hit.dndu = {0.1f, 0.2f, 0.f};
  hit.dndv = {-0.2f, 0.3f, 0.f};
  return hit;
}
Hit without_derivatives() {
  Hit hit = with_derivatives();
  hit.dpdu = hit.dpdv = hit.dndu = hit.dndv = vec3(0.f);
  return hit;
}

vec3 random_direction(RandomStream& random) {
  const float z = 2.f * random.next() - 1.f;
  const float azimuth = 2.f * pi * random.next();
  const float r = std::sqrt(std::max(0.f, 1.f - z * z));
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}
vec3 turned(const vec3& v, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

// Textures that need a file or another texture cannot be made from nothing.
template <typename T>
std::shared_ptr<const Texture<T>> made_plainly(const std::string& name) {
  try {
    return make_texture<T>(name);
  } catch (const Error&) {
    return nullptr;
  }
}

template <typename T>
int textures_that_do_not_read() {
  int checked = 0;
  for (const std::string& name : Registry::instance().names("texture")) {
    const FoundPlugin found = Registry::instance().find("texture", name, {});
    if (!(std::is_same_v<T, float> ? found.descriptor->create : found.descriptor->create_rgb))
      continue;
    const auto texture = made_plainly<T>(name);
    if (!texture || texture->reads_derivatives()) continue;
    ++checked;
    EXPECT_EQ(texture->evaluate(with_derivatives()), texture->evaluate(without_derivatives()))
        << name;
  }
  return checked;
}

TEST(Isotropic, TexturesReadNoDerivativesUnlessTheySaySo) {
  EXPECT_GE(textures_that_do_not_read<float>(), 3);
  EXPECT_GE(textures_that_do_not_read<Rgb>(), 3);
}

TEST(Isotropic, CombinationsReadWhatTheirPartsRead) {
  Resolver resolver;
  resolver.floats["grid"] = make_texture<float>("fbm");
  ASSERT_TRUE(resolver.floats["grid"]->reads_derivatives());
  EXPECT_TRUE(
      make_texture<float>("scale", {texture("tex", "grid")}, &resolver)->reads_derivatives());
  EXPECT_TRUE(
      make_texture<float>("mix", {texture("tex2", "grid")}, &resolver)->reads_derivatives());
  EXPECT_TRUE(
      make_texture<Rgb>("mix", {texture("amount", "grid")}, &resolver)->reads_derivatives());
  EXPECT_FALSE(make_material("conductor", {texture("roughness", "grid")}, &resolver)->isotropic());
  EXPECT_FALSE(make_material("diffuse", {texture("displacement", "grid")}, &resolver)->isotropic());
}

void expect_turnable(const Material& material, const std::string& name) {
  BsdfStorage plain_storage, full_storage;
  const Bsdf* const plain = material.bsdf(without_derivatives(), {0.3f, 0.6f}, plain_storage);
  const Bsdf* const full = material.bsdf(with_derivatives(), {0.3f, 0.6f}, full_storage);
  ASSERT_EQ(plain == nullptr, full == nullptr) << name;
  if (!plain) return;
  RandomStream random{77, RandomUse::test};
  for (int i = 0; i < 300; ++i) {
    const vec3 wo = random_direction(random);
    const vec3 wi = random_direction(random);
    const float angle = 2.f * pi * random.next();
    const Rgb value = plain->eval(wo, wi, Transport::radiance);
    EXPECT_EQ(value, full->eval(wo, wi, Transport::radiance)) << name;
    const Rgb there = plain->eval(turned(wo, angle), turned(wi, angle), Transport::radiance);
    const float pdf = plain->pdf(wo, wi);
    // Turning rounds directions, which narrow lobes feel.
    EXPECT_NEAR(plain->pdf(turned(wo, angle), turned(wi, angle)), pdf, 2e-3f * pdf) << name;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], value[c], 2e-3f * value[c]) << name;
  }
}

TEST(Isotropic, MaterialsThatSaySoScatterAlikeAllAround) {
  const std::vector<ParameterSet> variants = {
      {}, {number("roughness", 0.4f)}, {number("uroughness", 0.5f), number("vroughness", 0.1f)}};
  int checked = 0, refused = 0;
  for (const std::string& name : Registry::instance().names("material")) {
    for (const ParameterSet& set : variants) {
      std::shared_ptr<const Material> material;
      try {
        material = make_material(name, set);
      } catch (const Error&) {
        continue;
      }
      if (!material->isotropic()) {
        ++refused;
        continue;
      }
      ++checked;
      expect_turnable(*material, name);
    }
  }
  EXPECT_GE(checked, 6);
  EXPECT_GE(refused, 3);
}

}  // namespace
}  // namespace pssmlt
