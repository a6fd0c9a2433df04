// A Lambertian base under a dielectric coat, smooth or rough: plastic, varnish, glazed tiles.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, sections 14.3.2 and 14.3.3, for
// what is meant and for the parameters. A coat whose medium does not scatter ("albedo" 0, the
// default) has a closed form (core/coat.h), which this evaluates; nothing is random about it, and
// "maxdepth" and "nsamples", which limit a random walk, have no effect then. The transmission of
// coats with two roughnesses is that of their geometric mean. A medium that scatters is walked
// through (core/layered/layered_bsdf.h).
#include <algorithm>
#include <array>
#include <vector>

#include "core/base/warp.h"
#include "core/coat.h"
#include "core/color/fresnel.h"
#include "core/dielectric_index.h"
#include "core/layered/layer_parameters.h"
#include "core/layered/layered_bsdf.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// Between two coats, `share` of the second.
struct CoatMix {
  const Coat *a = nullptr, *b = nullptr;
  float share = 0.f;
  float reflected(float mu) const {
    return a == b ? a->reflected(mu) : mixed(a->reflected(mu), b->reflected(mu));
  }
  float transmitted(float mu) const {
    return a == b ? a->transmitted(mu) : mixed(a->transmitted(mu), b->transmitted(mu));
  }
  float mean_transmitted() const { return mixed(a->mean_transmitted(), b->mean_transmitted()); }
  float sent_back() const { return mixed(a->sent_back(), b->sent_back()); }

 private:
  float mixed(float x, float y) const { return x + share * (y - x); }
};

class CoatedDiffuseBsdf final : public Bsdf {
 public:
  CoatedDiffuseBsdf(const Rgb& reflectance, float eta, const Ggx& ggx, const CoatMix& coat)
      : base_(reflectance / (eta * eta * (1.f - reflectance * coat.sent_back()))),
        eta_(eta),
        ggx_(ggx),
        smooth_(ggx.is_smooth()),
        coat_(coat) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    if (!(wo.z * wi.z > 0.f)) return Rgb(0.f);
    const float through = coat_.transmitted(std::abs(wo.z)) * coat_.transmitted(std::abs(wi.z));
    return Rgb(coat_lobe(wo, wi)) + base_ * (through * inv_pi);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    if (!(wo.z * wi.z > 0.f)) return 0.f;
    const float coat = coat_probability(wo);
    float density = (1.f - coat) * std::abs(wi.z) * inv_pi;
    if (!smooth_) density += coat * coat_density(wo, wi);
    return density;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override {
    if (wo.z == 0.f) return std::nullopt;
    const float coat = coat_probability(wo);
    if (smooth_ && u_lobe < coat) {
      return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                        .weight = Rgb(coat_.reflected(std::abs(wo.z)) / coat),
                        .pdf = coat,
                        .pdf_reverse = coat,
                        .delta = true};
    }
    const std::optional<vec3> wi = u_lobe < coat ? mirrored(wo, u) : diffuse(wo, u);
    if (!wi) return std::nullopt;
    BsdfSample s;
    s.wi = *wi;
    s.pdf = pdf(wo, s.wi);
    if (!(s.pdf > 0.f)) return std::nullopt;
    s.pdf_reverse = pdf(s.wi, wo);
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf);
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3& wo) const override {
    return Rgb(coat_.reflected(std::abs(wo.z))) + base_albedo(wo);
  }

 private:
  Rgb base_albedo(const vec3& wo) const {
    return base_ * (coat_.transmitted(std::abs(wo.z)) * coat_.mean_transmitted());
  }
  // Of sampling the coat's lobe: its share of the albedo.
  float coat_probability(const vec3& wo) const {
    const Rgb base = base_albedo(wo);
    const float coat = coat_.reflected(std::abs(wo.z)), rest = std::max({base.x, base.y, base.z});
    return rest > 0.f ? coat / (coat + rest) : 1.f;
  }
  static std::optional<vec3> diffuse(const vec3& wo, const vec2& u) {
    const vec3 up = cosine_hemisphere(u);
    if (!(up.z > 0.f)) return std::nullopt;
    return vec3(up.x, up.y, std::copysign(up.z, wo.z));
  }
  // Both sides are coated: seen from below all is mirrored.
  std::optional<vec3> mirrored(const vec3& wo, const vec2& u) const {
    const auto m = ggx_.sample_visible(wo, u);
    if (!m) return std::nullopt;
    const vec3 wi = glm::normalize(reflect(wo, *m));
    if (!(wi.z * wo.z > 0.f)) return std::nullopt;
    return wi;
  }
  // The half vector on wo's side; nullopt if the two are opposite.
  static std::optional<vec3> half(const vec3& wo, const vec3& wi) {
    const vec3 h = wo + wi;
    const float l2 = length_squared(h);
    if (!(l2 > 0.f)) return std::nullopt;
    return h / std::sqrt(l2);
  }
  float coat_lobe(const vec3& wo, const vec3& wi) const {
    if (smooth_) return 0.f;
    const auto m = half(wo, wi);
    if (!m) return 0.f;
    const float fresnel = fresnel_dielectric(std::abs(glm::dot(wo, *m)), eta_);
    return fresnel * ggx_.d(*m) * ggx_.visibility(wo, wi);
  }
  float coat_density(const vec3& wo, const vec3& wi) const {
    const auto m = half(wo, wi);
    if (!m) return 0.f;
    return ggx_.pdf_visible(wo, *m) / (4.f * std::abs(glm::dot(wo, *m)));
  }

  Rgb base_;  // rho / (eta^2 (1 - rho R))
  float eta_;
  Ggx ggx_;
  bool smooth_;
  CoatMix coat_;
};

class CoatedDiffuse final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "Lambertian base under a dielectric coat";

  explicit CoatedDiffuse(Parameters& p)
      : BumpedMaterial(p),
        roughness_(p),
        eta_(read_dielectric_index(p)),
        reflectance_(p.rgb_texture("reflectance", Rgb(0.5f), SpectrumUse::Albedo, "",
                                   "fraction of the light that the base reflects")) {
    medium_ = read_layer_medium(p, eta_);
    if (!p.describing() && !medium_.scatters()) tabulate(medium_.thickness);
  }

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const override {
    const vec2 alpha = roughness_.alpha(hit);
    if (!std::isfinite(alpha.x) || !std::isfinite(alpha.y)) return invalid_bsdf(storage);
    const Rgb reflectance = clamp_reflectance(reflectance_->evaluate(hit));
    if (!is_finite(reflectance)) return invalid_bsdf(storage);
    const Ggx ggx(alpha.x, alpha.y);
    if (medium_.scatters()) {
      LayerBase base;
      base.lambertian = true;
      base.reflectance = reflectance;
      return make_layered_bsdf(medium_, ggx, base, u, storage);
    }
    return storage.make<CoatedDiffuseBsdf>(reflectance, eta_, ggx, coat(alpha, ggx.is_smooth()));
  }
  MaterialTraits traits() const override {
    return {.diffuse_lobes = true,
            .delta_lobes = roughness_.may_be_smooth(),
            .draws_numbers = medium_.scatters()};
  }
  bool isotropic() const override {
    return !bumped() && roughness_.isotropic() && !reflectance_->reads_derivatives();
  }

 private:
  // Widths of the tabulated coats, where they follow a texture; the first is smooth.
  static constexpr int levels = 24;
  static float width(int level) {
    return level == 0 ? 0.f
                      : std::max(sqr(static_cast<float>(level) / (levels - 1)), Ggx::smooth_below);
  }
  void tabulate(float thickness) {
    if (const auto alpha = roughness_.constant()) {
      coats_.emplace_back(eta_, thickness, std::sqrt(alpha->x * alpha->y));
      return;
    }
    for (int i = 0; i < levels; ++i) coats_.emplace_back(eta_, thickness, width(i));
  }
  CoatMix coat(const vec2& alpha, bool smooth) const {
    if (smooth || coats_.size() == 1) return {&coats_[0], &coats_[0], 0.f};
    const float mean = std::clamp(std::sqrt(alpha.x * alpha.y), width(1), 1.f);
    const float x = std::sqrt(mean) * (levels - 1);
    const auto i = static_cast<size_t>(std::clamp(static_cast<int>(x), 1, levels - 2));
    return {&coats_[i], &coats_[i + 1], std::clamp(x - static_cast<float>(i), 0.f, 1.f)};
  }

  RoughnessTextures roughness_;
  float eta_;
  LayerMedium medium_;
  std::shared_ptr<const Texture<Rgb>> reflectance_;
  std::vector<Coat> coats_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "coateddiffuse", pssmlt::CoatedDiffuse)
