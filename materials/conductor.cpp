// Metals: a smooth mirror or a GGX lobe of single scattering, coloured by Fresnel's equations.
// Source: pbrt-v4's conductor for parameters; Walter et al. 2007 and Heitz 2014 for the lobe. The
// colour is tabulated over the angle from the spectra of eta and k (core/color/fresnel_rgb.h).
// Energy that a real surface scatters twice or more between its facets is lost.
#include "core/material_base.h"
#include "core/metal_parameters.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class MirrorBsdf final : public Bsdf {
 public:
  explicit MirrorBsdf(const MetalReflectance& f) : fresnel_(f) {}
  Rgb eval(const vec3&, const vec3&, Transport) const override { return Rgb(0.f); }
  float pdf(const vec3&, const vec3&) const override { return 0.f; }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2&, Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                      .weight = fresnel_(wo.z),
                      .pdf = 1.f,
                      .pdf_reverse = 1.f,
                      .delta = true};
  }
  bool connectible() const override { return false; }
  Rgb albedo(const vec3& wo) const override { return fresnel_(wo.z); }

 private:
  MetalReflectance fresnel_;
};

class RoughMirrorBsdf final : public Bsdf {
 public:
  RoughMirrorBsdf(const MetalReflectance& f, const Ggx& ggx) : mirror_(f, ggx) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    return mirror_.eval(wo, wi);
  }
  float pdf(const vec3& wo, const vec3& wi) const override { return mirror_.pdf(wo, wi); }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2& u, Transport) const override {
    const auto d = mirror_.draw(wo, u);
    if (!d) return std::nullopt;
    return BsdfSample{
        .wi = d->wi, .weight = d->weight, .pdf = d->pdf, .pdf_reverse = d->pdf_reverse};
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3& wo) const override { return mirror_.fresnel()(wo.z); }

 private:
  RoughMirror mirror_;
};

class Conductor final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "metal, smooth or rough";

  explicit Conductor(Parameters& p) : BumpedMaterial(p), roughness_(p), metal_(p, "", 1.f) {}

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    const vec2 alpha = roughness_.alpha(hit);
    const auto fresnel = metal_.at(hit);
    if (!fresnel || !std::isfinite(alpha.x) || !std::isfinite(alpha.y))
      return invalid_bsdf(storage);
    if (!fresnel->curve && is_black(fresnel->k)) return nullptr;
    const Ggx ggx(alpha.x, alpha.y);
    if (ggx.is_smooth()) return storage.make<MirrorBsdf>(*fresnel);
    return storage.make<RoughMirrorBsdf>(*fresnel, ggx);
  }
  MaterialTraits traits() const override {
    return {.diffuse_lobes = roughness_.may_be_rough(), .delta_lobes = roughness_.may_be_smooth()};
  }
  bool isotropic() const override {
    return !bumped() && roughness_.isotropic() && !metal_.reads_derivatives();
  }

 private:
  RoughnessTextures roughness_;
  Metal metal_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "conductor", pssmlt::Conductor)
