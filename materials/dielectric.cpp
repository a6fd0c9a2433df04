// Glass: a smooth interface or GGX lobes of reflection and refraction (core/rough_interface.h),
// single scattering. Source: Walter et al. 2007, Microfacet Models for Refraction through Rough
// Surfaces; pbrt-v4's dielectric for parameters. Radiance is scaled by the squared ratio of indices
// on refraction, importance is not (Veach 1997, section 5.2).
#include "core/dielectric_bsdf.h"
#include "core/dielectric_index.h"
#include "core/material_base.h"
#include "core/path/dispersion.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Dielectric final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "glass, smooth or rough";

  explicit Dielectric(Parameters& p) : BumpedMaterial(p), roughness_(p), index_(p) {}

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const override {
    const vec2 alpha = roughness_.alpha(hit);
    if (!std::isfinite(alpha.x) || !std::isfinite(alpha.y)) return invalid_bsdf(storage);
    return make_dielectric_bsdf(eta(u), Ggx(alpha.x, alpha.y), storage);
  }
  MaterialTraits traits() const override {
    const bool matched = !index_.varies() && index_.at_d() == 1.f;
    return {.diffuse_lobes = !matched && roughness_.may_be_rough(),
            .delta_lobes = matched || roughness_.may_be_smooth(),
            .transmits = true,
            .disperses = index_.varies()};
  }
  bool isotropic() const override { return !bumped() && roughness_.isotropic(); }

 private:
  float eta(const MaterialNumbers& u) const {
    if (!index_.varies() || !u.sample) return index_.at_d();
    return index_.at(path_wavelength(*u.sample).nanometres);
  }
  RoughnessTextures roughness_;
  DielectricIndex index_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "dielectric", pssmlt::Dielectric)
