// A thin sheet of a dielectric: both interfaces at once, without displacement of the ray. The
// infinite series of reflections between them sums to R + T^2 R / (1 - R^2) (Stokes; Pharr, Jakob,
// Humphreys 2023, section 9.5.2).
#include "core/color/fresnel.h"
#include "core/dielectric_index.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class ThinDielectricBsdf final : public Bsdf {
 public:
  explicit ThinDielectricBsdf(float eta) : eta_(eta) {}

  Rgb eval(const vec3&, const vec3&, Transport) const override { return Rgb(0.f); }
  float pdf(const vec3&, const vec3&) const override { return 0.f; }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2&,
                                   Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const float r = reflectance(wo);
    if (u_lobe < r)
      return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                        .weight = Rgb(1.f),
                        .pdf = r,
                        .pdf_reverse = r,
                        .delta = true};
    return BsdfSample{.wi = -wo,
                      .weight = Rgb(1.f),
                      .pdf = 1.f - r,
                      .pdf_reverse = 1.f - r,
                      .delta = true,
                      .transmitted = true};
  }
  bool connectible() const override { return false; }
  Rgb albedo(const vec3&) const override { return Rgb(1.f); }

 private:
  float reflectance(const vec3& wo) const {
    const float r = fresnel_dielectric(std::abs(wo.z), eta_);
    const float t = 1.f - r;
    return t > 0.f ? r + t * t * r / (1.f - r * r) : 1.f;
  }
  float eta_;
};

class ThinDielectric final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "thin sheet of glass, smooth";

  explicit ThinDielectric(Parameters& p) : BumpedMaterial(p), eta_(read_dielectric_index(p)) {}
  const Bsdf* bsdf(const Hit&, MaterialNumbers, BsdfStorage& storage) const override {
    return storage.make<ThinDielectricBsdf>(eta_);
  }
  MaterialTraits traits() const override { return {.delta_lobes = true, .transmits = true}; }
  bool isotropic() const override { return !bumped(); }

 private:
  float eta_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "thindielectric", pssmlt::ThinDielectric)
