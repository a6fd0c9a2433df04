// Glass: a smooth interface or GGX lobes of reflection and refraction, single scattering. Source:
// Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces (half vector,
// Jacobian); Heitz 2014 (masking); pbrt-v4's dielectric for parameters. Radiance is scaled by the
// squared ratio of indices on refraction, importance is not (Veach 1997, section 5.2).
#include "core/color/fresnel.h"
#include "core/dielectric_index.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// What radiance gains by a refraction after which the path sees relative index `eta`.
float radiance_scale(float eta, Transport mode) {
  return mode == Transport::radiance ? 1.f / (eta * eta) : 1.f;
}

class SmoothDielectricBsdf final : public Bsdf {
 public:
  explicit SmoothDielectricBsdf(float eta) : eta_(eta) {}

  Rgb eval(const vec3&, const vec3&, Transport) const override { return Rgb(0.f); }
  float pdf(const vec3&, const vec3&) const override { return 0.f; }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2&,
                                   Transport mode) const override {
    if (wo.z == 0.f) return std::nullopt;
    const float r = fresnel_dielectric(wo.z, eta_);
    if (u_lobe < r)
      return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                        .weight = Rgb(1.f),
                        .pdf = r,
                        .pdf_reverse = r,
                        .delta = true};
    const std::optional<Refraction> t = refract(wo, vec3(0.f, 0.f, 1.f), eta_);
    if (!t || !(wo.z * t->direction.z < 0.f)) return std::nullopt;
    return BsdfSample{.wi = t->direction,
                      .weight = Rgb(radiance_scale(t->eta, mode)),
                      .pdf = 1.f - r,
                      .pdf_reverse = 1.f - r,
                      .delta = true,
                      .transmitted = true,
                      .eta = t->eta};
  }
  bool connectible() const override { return false; }
  Rgb albedo(const vec3&) const override { return Rgb(1.f); }

 private:
  float eta_;
};

class RoughDielectricBsdf final : public Bsdf {
 public:
  RoughDielectricBsdf(float eta, const Ggx& ggx) : eta_(eta), ggx_(ggx) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override {
    const std::optional<Facet> f = facet(wo, wi);
    if (!f) return Rgb(0.f);
    const float common = ggx_.d(f->m) * ggx_.visibility(wo, wi);
    if (f->reflects) return Rgb(f->fresnel * common);
    // D G |wo.m| |wi.m| / (|wo.z| |wi.z| (wi.m + wo.m / eta)^2); `common` holds D G / (4 |..|).
    const float jacobian = std::abs(f->cos_i) / refraction_denominator(*f, f->eta);
    return Rgb((1.f - f->fresnel) * common * 4.f * std::abs(f->cos_o) * jacobian *
               radiance_scale(f->eta, mode));
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    const std::optional<Facet> f = facet(wo, wi);
    return f ? density(wo, *f) : 0.f;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override {
    if (wo.z == 0.f) return std::nullopt;
    const std::optional<vec3> m = ggx_.sample_visible(wo, u);
    if (!m) return std::nullopt;
    Facet f{.m = *m, .cos_o = glm::dot(wo, *m)};
    f.fresnel = fresnel_dielectric(f.cos_o, eta_);
    f.reflects = u_lobe < f.fresnel;
    BsdfSample s;
    if (f.reflects) {
      s.wi = glm::normalize(reflect(wo, *m));
    } else {
      const std::optional<Refraction> t = refract(wo, *m, eta_);
      if (!t) return std::nullopt;
      s.wi = t->direction;
      f.eta = t->eta;
    }
    f.cos_i = glm::dot(s.wi, *m);
    f.fresnel = reflected_fraction(f);
    if (!is_valid(f, wo, s.wi)) return std::nullopt;
    s.transmitted = !f.reflects;
    s.eta = f.eta;
    const float scale = f.reflects ? 1.f : radiance_scale(f.eta, mode);
    s.weight = Rgb(ggx_.shadowing(wo, s.wi) * scale);
    s.pdf = density(wo, f);
    s.pdf_reverse = density(s.wi, reversed(f));
    if (!(s.pdf > 0.f)) return std::nullopt;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return Rgb(1.f); }

 private:
  // The one microfacet that connects two directions.
  struct Facet {
    vec3 m{0.f};                     // unit, z > 0
    float cos_o = 0.f, cos_i = 0.f;  // signed, to m
    float eta = 1.f;                 // index on wi's side over that on wo's
    float fresnel = 0.f;             // fraction that is reflected
    bool reflects = true;
  };

  // The facet must show each direction the side that the surface shows it.
  static bool is_valid(const Facet& f, const vec3& wo, const vec3& wi) {
    const bool same_side = wo.z * wi.z > 0.f;
    return wi.z != 0.f && same_side == f.reflects && f.cos_o * wo.z > 0.f && f.cos_i * wi.z > 0.f;
  }
  std::optional<Facet> facet(const vec3& wo, const vec3& wi) const {
    if (wo.z == 0.f || wi.z == 0.f) return std::nullopt;
    Facet f;
    f.reflects = wo.z * wi.z > 0.f;
    if (!f.reflects) f.eta = wo.z > 0.f ? eta_ : 1.f / eta_;
    const vec3 h = wo + f.eta * wi;
    const float l2 = length_squared(h);
    if (!(l2 > 0.f) || h.z == 0.f) return std::nullopt;
    f.m = h * (std::copysign(1.f, h.z) / std::sqrt(l2));
    f.cos_o = glm::dot(wo, f.m);
    f.cos_i = glm::dot(wi, f.m);
    if (!is_valid(f, wo, wi)) return std::nullopt;
    f.fresnel = reflected_fraction(f);
    return f;
  }
  // Refraction: from the side of the lower index, where nothing cancels near the critical angle,
  // and where both ways give the same number.
  float reflected_fraction(const Facet& f) const {
    if (f.reflects) return fresnel_dielectric(f.cos_o, eta_);
    const float outside = std::max(f.cos_o, f.cos_i), inside = std::min(f.cos_o, f.cos_i);
    return fresnel_dielectric(eta_ > 1.f ? outside : inside, eta_);
  }
  static Facet reversed(const Facet& f) {
    return {f.m, f.cos_i, f.cos_o, 1.f / f.eta, f.fresnel, f.reflects};
  }
  static float refraction_denominator(const Facet& f, float eta) {
    return sqr(f.cos_i + f.cos_o / eta);
  }
  // [1/sr] of sample(wo) at the other side of the facet (Walter et al., eq. 14 and 17).
  float density(const vec3& wo, const Facet& f) const {
    const float visible = ggx_.pdf_visible(wo, f.m);
    if (f.reflects) return f.fresnel * visible / (4.f * std::abs(f.cos_o));
    return (1.f - f.fresnel) * visible * std::abs(f.cos_i) / refraction_denominator(f, f.eta);
  }

  float eta_;
  Ggx ggx_;
};

class Dielectric final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "glass, smooth or rough";

  explicit Dielectric(Parameters& p)
      : BumpedMaterial(p), roughness_(p), eta_(read_dielectric_index(p)) {}

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    const vec2 alpha = roughness_.alpha(hit);
    if (!std::isfinite(alpha.x) || !std::isfinite(alpha.y)) return invalid_bsdf(storage);
    const Ggx ggx(alpha.x, alpha.y);
    // Without contrast a facet's normal can't be told from the directions: the ray goes on.
    if (eta_ == 1.f || ggx.is_smooth()) return storage.make<SmoothDielectricBsdf>(eta_);
    return storage.make<RoughDielectricBsdf>(eta_, ggx);
  }
  MaterialTraits traits() const override {
    const bool matched = eta_ == 1.f;
    return {.diffuse_lobes = !matched && roughness_.may_be_rough(),
            .delta_lobes = matched || roughness_.may_be_smooth(),
            .transmits = true};
  }

 private:
  RoughnessTextures roughness_;
  float eta_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "dielectric", pssmlt::Dielectric)
