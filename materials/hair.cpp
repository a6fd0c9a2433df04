// Hair, for curves: what a fibre reflects (R), lets pass (TT) and reflects inside (TRT and more).
// Source: pbrt-v4's hair for parameters; d'Eon et al. 2011 and Chiang et al. 2016 for the model
// (core/hair_bsdf.h). The colour is, in this order, "sigma_a", "reflectance" (or "color"), or the
// pigments. v runs across the fibre, u along it.
// Blind to where the light leaves a fibre: at the point where it is met.
#include <numbers>

#include "core/base/log.h"
#include "core/fibre.h"
#include "core/hair_bsdf.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr float default_eumelanin = 1.3f;

class Hair final : public Material, public FibreMaterial {
 public:
  static constexpr const char* summary = "hair and fur, for curves";

  explicit Hair(Parameters& p) {
    read_colour(p);
    eta_ = p.float_texture("eta", 1.55f, "", "index of the fibre over that of the air");
    beta_m_ = p.float_texture("beta_m", 0.3f, "", "roughness along the fibre, in [0, 1]");
    beta_n_ = p.float_texture("beta_n", 0.3f, "", "roughness across the fibre, in [0, 1]");
    alpha_ = p.float_texture("alpha", 2.f, "deg", "tilt of the scales on the fibre");
    if (p.describing()) return;
    if (eta_->constant() && !(eta_->evaluate(Hit()) >= 1.f))
      p.fail("eta", "\"eta\" must be 1 or more");
  }

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    HairPoint point;
    point.h = offset(hit);
    point.eta = at_least_one(eta_->evaluate(hit));
    point.beta_m = roughness(*beta_m_, hit);
    point.beta_n = roughness(*beta_n_, hit);
    point.alpha = alpha_->evaluate(hit) * (pi / 180.f);
    point.sigma_a = absorption(hit, point.beta_n);
    const float sum = point.h + point.eta + point.beta_m + point.beta_n + point.alpha;
    if (!std::isfinite(sum) || !is_finite(point.sigma_a)) return invalid_bsdf(storage);
    return storage.make<HairBsdf>(point);
  }
  MaterialTraits traits() const override { return {.diffuse_lobes = true, .transmits = true}; }

 private:
  // Along the shading frame's y, which v runs along or against.
  static float offset(const Hit& hit) {
    const float h = 2.f * hit.uv.y - 1.f;
    return glm::dot(glm::cross(hit.ns, hit.dpdu), hit.dpdv) < 0.f ? -h : h;
  }
  static float at_least_one(float eta) { return eta < 1.f ? 1.f : eta; }  // NaN stays
  // As pbrt-v4: below a hundredth lobes are too narrow to be found.
  static float roughness(const Texture<float>& texture, const Hit& hit) {
    const float value = texture.evaluate(hit);
    return value < 0.01f ? 0.01f : clamp_keep_nan(value, 1.f);
  }
  Rgb absorption(const Hit& hit, float beta_n) const {
    if (sigma_a_) {
      const Rgb s = sigma_a_->evaluate(hit);
      return {clamp_keep_nan(s.x, 1e6f), clamp_keep_nan(s.y, 1e6f), clamp_keep_nan(s.z, 1e6f)};
    }
    if (colour_) return hair_absorption(clamp_reflectance(colour_->evaluate(hit)), beta_n);
    return hair_absorption(concentration(eumelanin_, hit), concentration(pheomelanin_, hit));
  }
  static float concentration(const std::shared_ptr<const Texture<float>>& texture, const Hit& hit) {
    return texture ? clamp_keep_nan(texture->evaluate(hit), 1e6f) : 0.f;
  }

  void read_colour(Parameters& p) {
    const bool has_absorption = p.has("sigma_a"), has_reflectance = p.has("reflectance"),
               has_color = p.has("color");
    auto sigma_a = p.rgb_texture("sigma_a", Rgb(0.f), SpectrumUse::Unbounded, "1/radius",
                                 "absorption inside the fibre");
    auto reflectance =
        p.rgb_texture("reflectance", Rgb(0.f), SpectrumUse::Albedo, "",
                      "colour of a head of such hair, from which the absorption follows");
    auto color = p.rgb_texture("color", Rgb(0.f), SpectrumUse::Albedo, "",
                               "the same; \"reflectance\" goes first");
    eumelanin_ = p.optional_float_texture(
        "eumelanin", "concentration of the brown pigment; 1.3 if no colour is given at all");
    pheomelanin_ = p.optional_float_texture("pheomelanin", "concentration of the red pigment");
    if (has_absorption) sigma_a_ = std::move(sigma_a);
    if (!has_absorption && (has_reflectance || has_color))
      colour_ = has_reflectance ? std::move(reflectance) : std::move(color);
    const char* const used = has_absorption    ? "sigma_a"
                             : has_reflectance ? "reflectance"
                             : has_color       ? "color"
                                               : nullptr;
    const bool pigments = eumelanin_ || pheomelanin_;
    if (!used && !pigments) eumelanin_ = constant_texture(default_eumelanin);
    const int given = has_absorption + has_reflectance + has_color + pigments;
    if (used && given > 1)
      log_warning(to_string(p.where()) + ": " + p.owner() + ": the colour is given twice; \"" +
                  used + "\" is taken");
  }

  std::shared_ptr<const Texture<Rgb>> sigma_a_, colour_;  // at most one
  std::shared_ptr<const Texture<float>> eumelanin_, pheomelanin_;
  std::shared_ptr<const Texture<float>> eta_, beta_m_, beta_n_, alpha_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "hair", pssmlt::Hair)
