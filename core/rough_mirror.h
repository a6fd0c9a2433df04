// Reflection by metal: the Fresnel reflectance of a smooth surface or of GGX facets that scatter
// once (Walter et al. 2007; Heitz 2014). Directions are local and on the same side.
#pragma once

#include "core/color/fresnel_rgb.h"
#include "core/microfacet.h"

namespace pssmlt {

// Fresnel reflectance: a material's table or, where a texture decides, relative index and
// extinction of this point.
struct MetalReflectance {
  const FresnelCurve* curve = nullptr;
  float eta = 1.f;
  Rgb k{0.f};
  // |cosine| is used.
  Rgb operator()(float cosine) const {
    return curve ? (*curve)(cosine) : fresnel_conductor(cosine, Rgb(eta), k);
  }
};

class RoughMirror {
 public:
  RoughMirror(const MetalReflectance& fresnel, const Ggx& ggx) : fresnel_(fresnel), ggx_(ggx) {}

  struct Draw {
    vec3 wi{0.f};
    Rgb weight{0.f};  // f |cos| / pdf [1]
    float pdf = 0.f;  // [1/sr], > 0
    float pdf_reverse = 0.f;
  };

  // f(wo, wi) [1/sr], no cosine.
  Rgb eval(const vec3& wo, const vec3& wi) const {
    if (!(wo.z * wi.z > 0.f)) return Rgb(0.f);
    const vec3 m = half_vector(wo, wi);
    return fresnel_(glm::dot(wo, m)) * (ggx_.d(m) * ggx_.visibility(wo, wi));
  }
  // Density [1/sr] of draw(wo) at wi.
  float pdf(const vec3& wo, const vec3& wi) const {
    if (!(wo.z * wi.z > 0.f)) return 0.f;
    const vec3 m = half_vector(wo, wi);
    return density(wo, m, glm::dot(wo, m));
  }
  // nullopt where the facet drawn reflects into the surface.
  std::optional<Draw> draw(const vec3& wo, const vec2& u) const {
    if (wo.z == 0.f) return std::nullopt;
    const std::optional<vec3> m = ggx_.sample_visible(wo, u);
    if (!m) return std::nullopt;
    const float cosine = glm::dot(wo, *m);
    Draw d;
    d.wi = glm::normalize(reflect(wo, *m));
    if (!(wo.z * d.wi.z > 0.f) || cosine == 0.f) return std::nullopt;
    d.weight = fresnel_(cosine) * ggx_.shadowing(wo, d.wi);
    d.pdf = density(wo, *m, cosine);
    d.pdf_reverse = density(d.wi, *m, cosine);
    if (!(d.pdf > 0.f)) return std::nullopt;
    return d;
  }
  const MetalReflectance& fresnel() const { return fresnel_; }
  const Ggx& ggx() const { return ggx_; }

 private:
  static vec3 half_vector(const vec3& wo, const vec3& wi) { return glm::normalize(wo + wi); }
  // pdf_visible / (4 |wo.m|): normals to directions.
  float density(const vec3& wo, const vec3& m, float cosine) const {
    return ggx_.pdf_visible(wo, m) / (4.f * std::abs(cosine));
  }
  MetalReflectance fresnel_;
  Ggx ggx_;
};

}  // namespace pssmlt
