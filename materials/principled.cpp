// The metallic-roughness material of glTF 2.0 and its extensions (core/principled_bsdf.h): metals,
// plastics, cloth, car paint, thin and solid glass, and mixtures of them.
//
// Source: Khronos Group 2021, glTF 2.0 Specification, appendix B, and the extensions
// KHR_materials_ior, specular, transmission, volume, dispersion, clearcoat, sheen, anisotropy. The
// lobe's width is the square of the roughness, unless "remaproughness" is false. With a "thickness"
// the surface is the boundary of a body, which must be closed, and refracts; without one it is a
// thin sheet. Both sides look alike, but for refraction. The boundary of a dispersing body reflects
// and refracts by the index at the path's wavelength; every path that meets one has a wavelength,
// also where it is reflected by another lobe, all of which keep the index at the d line. Left out:
// normals of the coat's own, what facets scatter twice or more (metals lose it). Emission is an
// area light, opacity the shape's.
#include "core/cauchy_index.h"
#include "core/material_base.h"
#include "core/path/dispersion.h"
#include "core/plugin/plugin.h"
#include "core/principled_bsdf.h"

#include <glm/trigonometric.hpp>

namespace pssmlt {
namespace {

using FloatTexture = std::shared_ptr<const Texture<float>>;
using RgbTexture = std::shared_ptr<const Texture<Rgb>>;

bool is_constant(const Texture<float>& texture, float value) {
  return texture.constant() && texture.evaluate(Hit()) == value;
}

class Principled final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "metallic-roughness material of glTF 2.0";

  explicit Principled(Parameters& p) : BumpedMaterial(p) {
    read_base(p);
    read_surface(p);
    read_body(p);
    read_layers(p);
    if (p.describing()) return;
    if (!(eta_ >= 1.f || eta_ == 0.f))
      p.fail("ior", "\"ior\" must be 1 or more, or 0 for a dielectric that reflects all");
    if (!(thickness_ >= 0.f)) p.fail("thickness", "\"thickness\" must not be negative");
    if (!(dispersion_ >= 0.f) || !std::isfinite(dispersion_))
      p.fail("dispersion", "\"dispersion\" must be finite and not negative");
    if (refracts()) index_ = CauchyIndex(eta_, dispersion_);
    traits_ = find_traits();
  }

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const override {
    PrincipledPoint at;
    at.base = clamp_reflectance(base_->evaluate(hit));
    at.metallic = unit(metallic_, hit);
    at.thin = !(thickness_ > 0.f) || eta_ == 0.f;
    at.eta = index(u);
    at.transmission = unit(transmission_, hit);
    set_reflection(hit, at);
    set_widths(hit, at);
    at.coat = unit(coat_, hit);
    at.coat_alpha = width(*coat_roughness_, hit);
    at.sheen = clamp_reflectance(sheen_->evaluate(hit));
    at.sheen_roughness = unit(sheen_roughness_, hit);
    if (!is_usable(at)) return invalid_bsdf(storage);
    return storage.make<PrincipledBsdf>(at);
  }

  MaterialTraits traits() const override { return traits_; }

 private:
  MaterialTraits find_traits() const {
    const bool smooth = may_be_smooth(*roughness_);
    const bool rough = may_be_rough(*roughness_) || !is_constant(*anisotropy_, 0.f);
    const bool coated = !is_constant(*coat_, 0.f);
    const bool base = !is_constant(*metallic_, 1.f) && !is_constant(*transmission_, 1.f);
    const bool fibres = !sheen_->constant() || !is_black(sheen_->evaluate(Hit()));
    return {.diffuse_lobes = rough || base || fibres || (coated && may_be_rough(*coat_roughness_)),
            .delta_lobes = smooth || (coated && may_be_smooth(*coat_roughness_)),
            .transmits = !is_constant(*transmission_, 0.f),
            .disperses = index_.varies()};
  }
  // Some of the light goes through the boundary of a body.
  bool refracts() const {
    return thickness_ > 0.f && eta_ != 0.f && !is_constant(*transmission_, 0.f) &&
           !is_constant(*metallic_, 1.f);
  }
  float index(const MaterialNumbers& u) const {
    if (eta_ == 0.f) return 1.f;
    if (!index_.varies() || !u.sample) return eta_;
    return index_.at(path_wavelength(*u.sample).nanometres);
  }
  void read_base(Parameters& p) {
    base_ = p.rgb_texture("basecolor", Rgb(0.8f), SpectrumUse::Albedo, "",
                          "colour of the diffuse base, of metal, and of what passes");
    metallic_ = p.float_texture("metallic", 0.f, "", "share of metal");
    roughness_ = p.float_texture("roughness", 0.5f, "", "of the surface; 0 is smooth");
    remap_ = p.flag("remaproughness", true, "the width of lobes is the square of roughnesses");
    anisotropy_ =
        p.float_texture("anisotropy", 0.f, "", "how much wider along the first axis, 0..1");
    turn_ = glm::radians(p.number("anisotropyrotation", 0.f, "degrees",
                                  "of the first axis from the tangent, counter-clockwise"));
    has_axes_ = p.has("anisotropymap");
    axes_ =
        p.rgb_texture("anisotropymap", Rgb(1.f, 0.5f, 1.f), SpectrumUse::Unbounded, "",
                      "first axis in red and green as (x + 1) / 2, factor of anisotropy in blue");
  }
  void read_surface(Parameters& p) {
    eta_ = p.number("ior", 1.5f, "", "refractive index; 0: the dielectric reflects all");
    specular_ = p.float_texture("specular", 1.f, "", "factor of the dielectric's reflection");
    specular_color_ = p.rgb_texture("specularcolor", Rgb(1.f), SpectrumUse::Unbounded, "",
                                    "its colour at normal incidence");
  }
  void read_body(Parameters& p) {
    transmission_ =
        p.float_texture("transmission", 0.f, "", "share of the base that lets light pass");
    thickness_ = p.number("thickness", 0.f, "m", "greater than 0: boundary of a body, refracts");
    dispersion_ = p.number("dispersion", 0.f, "", "20 / Abbe number, of a body that refracts");
  }
  void read_layers(Parameters& p) {
    coat_ = p.float_texture("clearcoat", 0.f, "", "share of a coat of index 1.5");
    coat_roughness_ = p.float_texture("clearcoatroughness", 0.f, "", "of the coat");
    sheen_ = p.rgb_texture("sheencolor", Rgb(0.f), SpectrumUse::Albedo, "", "of fibres on top");
    sheen_roughness_ = p.float_texture("sheenroughness", 0.f, "", "of the fibres; at least 0.1");
  }

  static float unit(const FloatTexture& texture, const Hit& hit) {
    return clamp_keep_nan(texture->evaluate(hit), 1.f);
  }
  float width_of(float roughness) const { return remap_ ? sqr(roughness) : roughness; }
  float width(const Texture<float>& roughness, const Hit& hit) const {
    return width_of(clamp_keep_nan(roughness.evaluate(hit), 1.f));
  }
  bool constant_smooth(const Texture<float>& roughness) const {
    return width(roughness, Hit()) < Ggx::smooth_below;
  }
  bool may_be_rough(const Texture<float>& r) const { return !r.constant() || !constant_smooth(r); }
  bool may_be_smooth(const Texture<float>& r) const { return !r.constant() || constant_smooth(r); }

  void set_reflection(const Hit& hit, PrincipledPoint& at) const {
    const float specular = unit(specular_, hit);
    const float f0 = eta_ == 0.f ? 1.f : sqr((1.f - eta_) / (1.f + eta_));
    at.f0 = specular * clamp_reflectance(f0 * specular_color_->evaluate(hit));
    at.f90 = specular;
  }
  void set_widths(const Hit& hit, PrincipledPoint& at) const {
    const float alpha = width(*roughness_, hit);
    at.alpha = vec2(alpha);
    float strength = unit(anisotropy_, hit);
    if (strength == 0.f) return;
    vec2 axis(std::cos(turn_), std::sin(turn_));
    if (has_axes_) {
      const Rgb map = axes_->evaluate(hit);
      const vec2 d(2.f * map.x - 1.f, 2.f * map.y - 1.f);
      const float length = glm::length(d);
      if (length > 0.f) {
        const vec2 unit_d = d / length;
        axis = {axis.x * unit_d.x - axis.y * unit_d.y, axis.y * unit_d.x + axis.x * unit_d.y};
      }
      strength *= clamp_keep_nan(map.z, 1.f);
    }
    at.alpha.x = alpha + (1.f - alpha) * sqr(strength);
    at.axis = axis;
  }
  // No texture failed.
  static bool is_usable(const PrincipledPoint& at) {
    return is_finite(at.base) && is_finite(at.f0) && is_finite(at.sheen) &&
           std::isfinite(at.alpha.x + at.alpha.y + at.axis.x + at.axis.y + at.metallic +
                         at.transmission + at.f90 + at.coat + at.coat_alpha + at.sheen_roughness);
  }

  RgbTexture base_, axes_, specular_color_, sheen_;
  FloatTexture metallic_, roughness_, anisotropy_, specular_, transmission_;
  FloatTexture coat_, coat_roughness_, sheen_roughness_;
  float turn_ = 0.f, eta_ = 1.5f, thickness_ = 0.f, dispersion_ = 0.f;
  bool remap_ = true, has_axes_ = false;
  CauchyIndex index_;  // does not vary where nothing refracts
  MaterialTraits traits_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "principled", pssmlt::Principled)
