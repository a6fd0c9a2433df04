// Refraction and reflection at a rough boundary between two dielectrics: GGX facets, single
// scattering (Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces).
// Radiance is scaled by the squared ratio of indices on refraction, importance is not (Veach 1997,
// section 5.2). Directions are local; those with z > 0 are outside.
#pragma once

#include "core/bsdf.h"
#include "core/color/fresnel.h"
#include "core/microfacet.h"

namespace pssmlt {

// What radiance gains by a refraction after which the path sees relative index `eta`.
inline float refracted_radiance_scale(float eta, Transport mode) {
  return mode == Transport::radiance ? 1.f / (eta * eta) : 1.f;
}

// True where facets bend light by so little that directions in float do not tell the lobe's shape:
// half vectors are a difference of directions |eta - 1| apart, known to some 42 roundings, and a
// lobe of facets of width alpha needs them to alpha (docs/numerics.md). Such a boundary is smooth;
// what it reflects is less than a share |eta - 1| of diffuse light.
inline bool refracts_sharply(float eta, const Ggx& ggx) {
  return ggx.is_smooth() || std::abs(eta - 1.f) * ggx.width() < 0x1p-16f;
}

class RoughInterface {
 public:
  // eta: index of the inside over that of the outside; not where refracts_sharply().
  RoughInterface(float eta, const Ggx& ggx) : eta_(eta), ggx_(ggx) {}

  // The one microfacet that connects two directions.
  struct Facet {
    vec3 m{0.f};                     // unit, z > 0
    float cos_o = 0.f, cos_i = 0.f;  // signed, to m
    float eta = 1.f;                 // index on wi's side over that on wo's
    float fresnel = 0.f;             // fraction that is reflected
    bool reflects = true;
  };
  struct Draw {
    vec3 wi{0.f};
    Facet facet;
  };

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
  // f(wo, wi) [1/sr], no cosine.
  float value(const Facet& f, const vec3& wo, const vec3& wi, Transport mode) const {
    const float common = ggx_.d(f.m) * ggx_.visibility(wo, wi);
    if (f.reflects) return f.fresnel * common;
    // D G |wo.m| |wi.m| / (|wo.z| |wi.z| (wi.m + wo.m / eta)^2); `common` holds D G / (4 |..|).
    const float jacobian = std::abs(f.cos_i) / refraction_denominator(f, f.eta);
    return (1.f - f.fresnel) * common * 4.f * std::abs(f.cos_o) * jacobian *
           refracted_radiance_scale(f.eta, mode);
  }
  // Density [1/sr] of draw(wo) at the other side of the facet (Walter et al., eq. 14 and 17).
  float density(const vec3& wo, const Facet& f) const {
    const float visible = ggx_.pdf_visible(wo, f.m);
    if (f.reflects) return f.fresnel * visible / (4.f * std::abs(f.cos_o));
    return (1.f - f.fresnel) * visible * std::abs(f.cos_i) / refraction_denominator(f, f.eta);
  }
  // nullopt where the facet drawn connects nothing.
  std::optional<Draw> draw(const vec3& wo, float u_lobe, const vec2& u) const {
    if (wo.z == 0.f) return std::nullopt;
    const std::optional<vec3> m = ggx_.sample_visible(wo, u);
    if (!m) return std::nullopt;
    Facet f{.m = *m, .cos_o = glm::dot(wo, *m)};
    f.fresnel = fresnel_dielectric(f.cos_o, eta_);
    f.reflects = u_lobe < f.fresnel;
    vec3 wi(0.f);
    if (f.reflects) {
      wi = glm::normalize(reflect(wo, *m));
    } else {
      const std::optional<Refraction> t = refract(wo, *m, eta_);
      if (!t) return std::nullopt;
      wi = t->direction;
      f.eta = t->eta;
    }
    f.cos_i = glm::dot(wi, *m);
    f.fresnel = reflected_fraction(f);
    if (!is_valid(f, wo, wi)) return std::nullopt;
    return Draw{wi, f};
  }
  // The same facet seen from the other direction.
  static Facet reversed(const Facet& f) {
    return {f.m, f.cos_i, f.cos_o, 1.f / f.eta, f.fresnel, f.reflects};
  }

 private:
  // The facet must show each direction the side that the surface shows it.
  static bool is_valid(const Facet& f, const vec3& wo, const vec3& wi) {
    const bool same_side = wo.z * wi.z > 0.f;
    return wi.z != 0.f && same_side == f.reflects && f.cos_o * wo.z > 0.f && f.cos_i * wi.z > 0.f;
  }
  // Refraction: from the side of the lower index, where nothing cancels near the critical angle,
  // and where both ways give the same number.
  float reflected_fraction(const Facet& f) const {
    if (f.reflects) return fresnel_dielectric(f.cos_o, eta_);
    const float outside = std::max(f.cos_o, f.cos_i), inside = std::min(f.cos_o, f.cos_i);
    return fresnel_dielectric(eta_ > 1.f ? outside : inside, eta_);
  }
  static float refraction_denominator(const Facet& f, float eta) {
    return sqr(f.cos_i + f.cos_o / eta);
  }

  float eta_;
  Ggx ggx_;
};

}  // namespace pssmlt
