// A dielectric coat over an opaque base, as random walks between the two with the numbers of the
// vertex (core/layered/layer_walk.h). Both sides of the surface are coated alike.
#pragma once

#include "core/bsdf.h"
#include "core/layered/layer_walk.h"

namespace pssmlt {

// Directions are drawn from a mixture of densities in closed form, which does not depend on the
// walk: multiple importance sampling needs no estimate of a density. The coat's own mirror image is
// a delta lobe where the boundary is smooth.
class LayeredBsdf final : public Bsdf {
 public:
  // `medium` must outlive this.
  LayeredBsdf(const LayerMedium& medium, const Ggx& boundary, const LayerBase& base,
              const MaterialNumbers& u);

  Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override;
  float pdf(const vec3& wo, const vec3& wi) const override;
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override;
  bool connectible() const override { return true; }
  Rgb albedo(const vec3& wo) const override;

 private:
  // Of choosing what the boundary reflects itself; 0 < p < 1 unless there is only one.
  float coat_probability(const vec3& wo) const;
  std::optional<vec3> draw(const vec3& wo, float u_lobe, const vec2& u) const;
  bool smooth() const { return refracts_sharply(medium_.eta, boundary_); }
  // The lobe that the base's makes above the boundary.
  Ggx seen_lobe() const;

  const LayerMedium& medium_;
  Ggx boundary_;
  LayerBase base_;
  WalkNumbers numbers_;
};

// The same where boundary and base are smooth and nothing scatters in between: a mirror, in closed
// form.
class LayeredMirrorBsdf final : public Bsdf {
 public:
  LayeredMirrorBsdf(const LayerMedium& medium, const MetalReflectance& base)
      : medium_(medium), base_(base) {}
  Rgb eval(const vec3&, const vec3&, Transport) const override { return Rgb(0.f); }
  float pdf(const vec3&, const vec3&) const override { return 0.f; }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2&, Transport) const override;
  bool connectible() const override { return false; }
  Rgb albedo(const vec3& wo) const override;

 private:
  const LayerMedium& medium_;
  MetalReflectance base_;
};

// The one of the two that fits, in `storage`.
const Bsdf* make_layered_bsdf(const LayerMedium& medium, const Ggx& boundary, LayerBase base,
                              const MaterialNumbers& u, BsdfStorage& storage);

}  // namespace pssmlt
