// Lambertian reflection and transmission: leaves, paper, thin curtains.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 9.5.4 (parameters),
// each lobe Lambert's.
#include <algorithm>

#include "core/base/warp.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class DiffuseTransmissionBsdf final : public Bsdf {
 public:
  DiffuseTransmissionBsdf(const Rgb& reflectance, const Rgb& transmittance)
      : reflectance_(reflectance), transmittance_(transmittance) {
    const float r = largest(reflectance), t = largest(transmittance);
    reflects_ = r / (r + t);
  }

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    const float sides = wo.z * wi.z;
    return sides > 0.f ? reflectance_ * inv_pi : sides < 0.f ? transmittance_ * inv_pi : Rgb(0.f);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    const float sides = wo.z * wi.z;
    return sides == 0.f ? 0.f : lobe(sides > 0.f) * std::abs(wi.z) * inv_pi;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const vec3 up = cosine_hemisphere(u);
    if (!(up.z > 0.f)) return std::nullopt;
    const bool reflected = u_lobe < reflects_;
    BsdfSample s;
    s.transmitted = !reflected;
    s.wi = {up.x, up.y, std::copysign(up.z, reflected ? wo.z : -wo.z)};
    s.weight = (reflected ? reflectance_ : transmittance_) / lobe(reflected);
    s.pdf = lobe(reflected) * up.z * inv_pi;
    s.pdf_reverse = lobe(reflected) * std::abs(wo.z) * inv_pi;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return reflectance_ + transmittance_; }

 private:
  static float largest(const Rgb& c) { return std::max({c.x, c.y, c.z}); }
  // Probability of the lobe.
  float lobe(bool reflection) const { return reflection ? reflects_ : 1.f - reflects_; }

  Rgb reflectance_, transmittance_;
  float reflects_;
};

class DiffuseTransmission final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "Lambertian reflection and transmission";

  explicit DiffuseTransmission(Parameters& p)
      : BumpedMaterial(p),
        reflectance_(p.rgb_texture("reflectance", Rgb(0.25f), SpectrumUse::Albedo, "",
                                   "fraction of the light that is reflected")),
        transmittance_(p.rgb_texture("transmittance", Rgb(0.25f), SpectrumUse::Albedo, "",
                                     "fraction of the light that comes out on the other side")),
        scale_(p.number("scale", 1.f, "", "factor of both")) {
    if (!(scale_ >= 0.f)) p.fail("scale", "\"scale\" must not be negative");
  }

  // What both lobes take together may exceed 1 nowhere: light is not made.
  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    Rgb r = clamp_reflectance(scale_ * reflectance_->evaluate(hit));
    Rgb t = clamp_reflectance(scale_ * transmittance_->evaluate(hit));
    for (int c = 0; c < 3; ++c) {
      const float sum = r[c] + t[c];
      if (sum > 1.f) r[c] /= sum, t[c] /= sum;
    }
    if (is_black(r) && is_black(t)) return nullptr;
    return storage.make<DiffuseTransmissionBsdf>(r, t);
  }
  MaterialTraits traits() const override { return {.diffuse_lobes = true, .transmits = true}; }
  bool isotropic() const override {
    return !bumped() && !reflectance_->reads_derivatives() && !transmittance_->reads_derivatives();
  }

 private:
  std::shared_ptr<const Texture<Rgb>> reflectance_, transmittance_;
  float scale_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "diffusetransmission", pssmlt::DiffuseTransmission)
