// Metal under a dielectric coat, smooth or rough: anodised or lacquered metal.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 14.3, for what is meant
// and for the parameters. Boundary and metal both smooth, with nothing that scatters between them,
// have a closed form; all else is walked (core/layered/layered_bsdf.h).
#include "core/dielectric_index.h"
#include "core/layered/layer_parameters.h"
#include "core/layered/layered_bsdf.h"
#include "core/material_base.h"
#include "core/metal_parameters.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class CoatedConductor final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "metal under a dielectric coat";

  explicit CoatedConductor(Parameters& p)
      : BumpedMaterial(p),
        boundary_(p, "interface."),
        metal_roughness_(p, "conductor."),
        medium_(read_layer_medium(p, read_dielectric_index(p, "interface.eta"))),
        metal_(p, "conductor.", medium_.eta) {}

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const override {
    const vec2 outer = boundary_.alpha(hit), inner = metal_roughness_.alpha(hit);
    const auto metal = metal_.at(hit);
    if (!metal || !std::isfinite(outer.x + outer.y) || !std::isfinite(inner.x + inner.y))
      return invalid_bsdf(storage);
    LayerBase base;
    base.metal = {*metal, Ggx(inner.x, inner.y)};
    return make_layered_bsdf(medium_, Ggx(outer.x, outer.y), base, u, storage);
  }
  MaterialTraits traits() const override {
    const bool all_smooth = boundary_.may_be_smooth() && metal_roughness_.may_be_smooth();
    const bool any_rough = boundary_.may_be_rough() || metal_roughness_.may_be_rough();
    return {.diffuse_lobes = any_rough || (all_smooth && medium_.scatters()),
            .delta_lobes = boundary_.may_be_smooth() || medium_.eta == 1.f,
            .draws_numbers = true};
  }

 private:
  RoughnessTextures boundary_, metal_roughness_;
  LayerMedium medium_;
  Metal metal_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "coatedconductor", pssmlt::CoatedConductor)
