// Metals: a smooth mirror or a GGX lobe of single scattering, coloured by Fresnel's equations.
// Source: pbrt-v4's conductor for parameters; Walter et al. 2007 and Heitz 2014 for the lobe. The
// colour is tabulated over the angle from the spectra of eta and k (core/color/fresnel_rgb.h).
// Energy that a real surface scatters twice or more between its facets is lost.
#include <array>

#include "core/color/fresnel_rgb.h"
#include "core/color/named_spectra.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// Fresnel reflectance: the material's table or, where a texture decides, eta = 1 and this point's
// k.
struct Reflectance {
  const FresnelCurve* curve = nullptr;
  Rgb k{0.f};
  Rgb operator()(float cosine) const {
    return curve ? (*curve)(cosine) : fresnel_conductor(cosine, Rgb(1.f), k);
  }
};

class MirrorBsdf final : public Bsdf {
 public:
  explicit MirrorBsdf(const Reflectance& f) : fresnel_(f) {}
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
  Reflectance fresnel_;
};

class RoughMirrorBsdf final : public Bsdf {
 public:
  RoughMirrorBsdf(const Reflectance& f, const Ggx& ggx) : fresnel_(f), ggx_(ggx) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    if (!(wo.z * wi.z > 0.f)) return Rgb(0.f);
    const vec3 m = half_vector(wo, wi);
    return fresnel_(glm::dot(wo, m)) * (ggx_.d(m) * ggx_.visibility(wo, wi));
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    if (!(wo.z * wi.z > 0.f)) return 0.f;
    const vec3 m = half_vector(wo, wi);
    return reflected_pdf(wo, m, glm::dot(wo, m));
  }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2& u, Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const std::optional<vec3> m = ggx_.sample_visible(wo, u);
    if (!m) return std::nullopt;
    const float cosine = glm::dot(wo, *m);
    BsdfSample s;
    s.wi = glm::normalize(reflect(wo, *m));
    if (!(wo.z * s.wi.z > 0.f) || cosine == 0.f) return std::nullopt;
    s.weight = fresnel_(cosine) * ggx_.shadowing(wo, s.wi);
    s.pdf = reflected_pdf(wo, *m, cosine);
    s.pdf_reverse = reflected_pdf(s.wi, *m, cosine);
    if (!(s.pdf > 0.f)) return std::nullopt;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3& wo) const override { return fresnel_(wo.z); }

 private:
  static vec3 half_vector(const vec3& wo, const vec3& wi) { return glm::normalize(wo + wi); }
  // pdf_visible / (4 |wo.m|): normals to directions.
  float reflected_pdf(const vec3& wo, const vec3& m, float cosine) const {
    return ggx_.pdf_visible(wo, m) / (4.f * std::abs(cosine));
  }
  Reflectance fresnel_;
  Ggx ggx_;
};

// The colour of a spectrum that multiplies nothing in particular: lit by D65.
Rgb mean_rgb(std::string_view name) {
  const Samples samples = *named_spectrum(name);
  return Rgb(reflectance_rgb([&](double l) { return evaluate(samples, l, Outside::Clamp); }));
}

constexpr const char* default_eta = "metal-Cu-eta";
constexpr const char* default_k = "metal-Cu-k";

FresnelCurve read_index(Parameters& p) {
  for (const char* name : {"eta", "k"}) {
    if (p.type(name) == ParameterType::Texture) p.fail(name, "textures are not supported here yet");
  }
  constexpr const char* eta_doc = "refractive index; default: metal-Cu-eta";
  constexpr const char* k_doc = "extinction coefficient; default: metal-Cu-k";
  const auto is_rgb = [&p](const char* name) { return p.type(name) == ParameterType::Rgb; };
  if (!is_rgb("eta") && !is_rgb("k")) {
    const auto eta = p.spectrum("eta", "", eta_doc);
    const auto k = p.spectrum("k", "", k_doc);
    return FresnelCurve::from_spectra(eta ? *eta : *named_spectrum(default_eta),
                                      k ? *k : *named_spectrum(default_k));
  }
  const Rgb eta = p.rgb("eta", mean_rgb(default_eta), SpectrumUse::Unbounded, "", eta_doc);
  const Rgb k = p.rgb("k", mean_rgb(default_k), SpectrumUse::Unbounded, "", k_doc);
  return FresnelCurve::from_rgb(eta, k);
}

class Conductor final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "metal, smooth or rough";

  explicit Conductor(Parameters& p) : BumpedMaterial(p), roughness_(p), curve_(read_curve(p)) {}

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    const vec2 alpha = roughness_.alpha(hit);
    Reflectance fresnel{&curve_};
    if (reflectance_) {
      const Rgb value = clamp_reflectance(reflectance_->evaluate(hit));
      if (!is_finite(value)) return invalid_bsdf(storage);
      if (is_black(value)) return nullptr;
      fresnel = {nullptr, conductor_k_from_reflectance(value)};
    }
    if (!std::isfinite(alpha.x) || !std::isfinite(alpha.y)) return invalid_bsdf(storage);
    const Ggx ggx(alpha.x, alpha.y);
    if (ggx.is_smooth()) return storage.make<MirrorBsdf>(fresnel);
    return storage.make<RoughMirrorBsdf>(fresnel, ggx);
  }
  MaterialTraits traits() const override {
    return {.diffuse_lobes = roughness_.may_be_rough(), .delta_lobes = roughness_.may_be_smooth()};
  }

 private:
  // Sets reflectance_ if it varies; the curve is then not used.
  FresnelCurve read_curve(Parameters& p) {
    const bool has_index = p.has("eta") || p.has("k");
    if (p.has("reflectance") && has_index)
      p.fail("reflectance", "\"reflectance\" excludes \"eta\" and \"k\"");
    const bool given = p.has("reflectance");
    const auto reflectance = p.rgb_texture("reflectance", Rgb(0.f), SpectrumUse::Albedo, "",
                                           "reflectance at normal incidence, instead of eta and k");
    if (!given) return read_index(p);
    if (!reflectance->constant()) reflectance_ = reflectance;
    const Rgb value = reflectance_ ? Rgb(0.f) : clamp_reflectance(reflectance->evaluate(Hit()));
    return FresnelCurve::from_reflectance(value);
  }

  RoughnessTextures roughness_;
  std::shared_ptr<const Texture<Rgb>> reflectance_;
  FresnelCurve curve_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "conductor", pssmlt::Conductor)
