// Paint that fails on purpose: like diffuse, but for a share of all pairs of directions its value
// is not a number, infinite, negative or huge. Which pairs is a hash of their bits, so that a
// sample that failed fails again when it is replayed. For `pssmlt stress` alone.
#include <array>
#include <bit>
#include <limits>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "core/material.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 4> faults = {"nan", "infinite", "negative", "huge"};

float value_of(std::string_view fault) {
  if (fault == "nan") return std::numeric_limits<float>::quiet_NaN();
  if (fault == "infinite") return infinity;
  return fault == "negative" ? -1.f : 1e38f;
}

class FaultyBsdf final : public Bsdf {
 public:
  FaultyBsdf(float reflectance, float fault, float probability)
      : reflectance_(reflectance), fault_(fault), probability_(probability) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    if (!(wo.z * wi.z > 0.f)) return Rgb(0.f);
    return Rgb(fails(wo, wi) ? fault_ : reflectance_ * inv_pi);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    return wo.z * wi.z > 0.f ? std::abs(wi.z) * inv_pi : 0.f;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2& u, Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const vec3 up = cosine_hemisphere(u);
    if (!(up.z > 0.f)) return std::nullopt;
    BsdfSample s;
    s.wi = {up.x, up.y, std::copysign(up.z, wo.z)};
    s.weight = Rgb(fails(wo, s.wi) ? fault_ : reflectance_);
    s.pdf = up.z * inv_pi;
    s.pdf_reverse = std::abs(wo.z) * inv_pi;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return Rgb(reflectance_); }

 private:
  bool fails(const vec3& wo, const vec3& wi) const {
    uint64_t hash = 0;
    for (const float x : {wo.x, wo.y, wi.x, wi.y})
      hash = mix_bits(hash ^ std::bit_cast<uint32_t>(x));
    return static_cast<double>(hash) * 0x1p-64 < static_cast<double>(probability_);
  }
  float reflectance_, fault_, probability_;
};

class StressFault final : public Material {
 public:
  static constexpr const char* summary = "paint that fails on purpose";

  explicit StressFault(Parameters& p)
      : reflectance_(p.number("reflectance", .6f, "", "where it does not fail")),
        fault_(value_of(p.choice("fault", "nan", faults, "what it returns instead"))),
        probability_(p.number("probability", 1e-4f, "", "share of directions that fail")) {}

  const Bsdf* bsdf(const Hit&, MaterialNumbers, BsdfStorage& storage) const override {
    return storage.make<FaultyBsdf>(reflectance_, fault_, probability_);
  }
  MaterialTraits traits() const override { return {.diffuse_lobes = true}; }

 private:
  float reflectance_, fault_, probability_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "stress_fault", pssmlt::StressFault)
