// Lambertian reflection on both sides of a surface.
#include "core/base/warp.h"
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class DiffuseBsdf final : public Bsdf {
 public:
  explicit DiffuseBsdf(const Rgb& reflectance) : reflectance_(reflectance) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    return wo.z * wi.z > 0.f ? reflectance_ * inv_pi : Rgb(0.f);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    return wo.z * wi.z > 0.f ? std::abs(wi.z) * inv_pi : 0.f;
  }
  BothWays both_ways(const vec3& wo, const vec3& wi, Transport) const override {
    if (!(wo.z * wi.z > 0.f)) return {};
    return {reflectance_ * inv_pi, std::abs(wi.z) * inv_pi, std::abs(wo.z) * inv_pi};
  }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2& u, Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const vec3 up = cosine_hemisphere(u);
    if (!(up.z > 0.f)) return std::nullopt;
    BsdfSample s;
    s.wi = {up.x, up.y, std::copysign(up.z, wo.z)};
    s.weight = reflectance_;
    s.pdf = up.z * inv_pi;
    s.pdf_reverse = std::abs(wo.z) * inv_pi;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return reflectance_; }

 private:
  Rgb reflectance_;
};

class Diffuse final : public BumpedMaterial {
 public:
  static constexpr const char* summary = "Lambertian reflection on both sides";

  explicit Diffuse(Parameters& p)
      : BumpedMaterial(p),
        reflectance_(p.rgb_texture("reflectance", Rgb(0.5f), SpectrumUse::Albedo, "",
                                   "fraction of the light that is reflected")) {}

  const Bsdf* bsdf(const Hit& hit, MaterialNumbers, BsdfStorage& storage) const override {
    const Rgb reflectance = clamp_reflectance(reflectance_->evaluate(hit));
    if (is_black(reflectance)) return nullptr;
    return storage.make<DiffuseBsdf>(reflectance);
  }
  MaterialTraits traits() const override { return {.diffuse_lobes = true}; }
  bool isotropic() const override { return !bumped() && !reflectance_->reads_derivatives(); }

 private:
  std::shared_ptr<const Texture<Rgb>> reflectance_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "diffuse", pssmlt::Diffuse)
