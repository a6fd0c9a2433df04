// Lambertian reflection on both sides of a surface.
#include "core/material_base.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// A point of the unit disk, by the concentric map of Shirley and Chiu (1997).
vec2 concentric_disk(const vec2& u) {
  const vec2 p = 2.f * u - 1.f;
  if (p.x == 0.f && p.y == 0.f) return vec2(0.f);
  const bool x_leads = std::abs(p.x) > std::abs(p.y);
  const float r = x_leads ? p.x : p.y;
  const float phi = x_leads ? pi / 4.f * (p.y / p.x) : pi / 2.f - pi / 4.f * (p.x / p.y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

class DiffuseBsdf final : public Bsdf {
 public:
  explicit DiffuseBsdf(const Rgb& reflectance) : reflectance_(reflectance) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    return wo.z * wi.z > 0.f ? reflectance_ * inv_pi : Rgb(0.f);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    return wo.z * wi.z > 0.f ? std::abs(wi.z) * inv_pi : 0.f;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2& u, Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const vec2 p = concentric_disk(u);
    const float z = safe_sqrt(1.f - p.x * p.x - p.y * p.y);
    if (!(z > 0.f)) return std::nullopt;
    BsdfSample s;
    s.wi = {p.x, p.y, std::copysign(z, wo.z)};
    s.weight = reflectance_;
    s.pdf = z * inv_pi;
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

 private:
  std::shared_ptr<const Texture<Rgb>> reflectance_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Material, "diffuse", pssmlt::Diffuse)
