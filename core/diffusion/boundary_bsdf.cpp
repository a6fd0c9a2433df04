#include "core/diffusion/boundary_bsdf.h"

#include "core/base/warp.h"

namespace pssmlt {
namespace {

float enters(const vec3& w, float eta) { return 1.f - fresnel_dielectric(std::abs(w.z), eta); }
float cosine_density(const vec3& w) { return std::abs(w.z) * inv_pi; }

class EntryBsdf final : public Bsdf {
 public:
  EntryBsdf(const DiffusionProfile& profile, const Ggx& ggx)
      : profile_(profile), ggx_(ggx), smooth_(ggx.is_smooth()) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override {
    if (smooth_ || !(wo.z * wi.z > 0.f)) return Rgb(0.f);
    const vec3 m = glm::normalize(wo + wi);
    return Rgb(reflectance(glm::dot(wo, m)) * ggx_.d(m) * ggx_.visibility(wo, wi));
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    if (smooth_ || !(wo.z * wi.z > 0.f)) return 0.f;
    const vec3 m = glm::normalize(wo + wi);
    return reflectance(wo.z) * ggx_.pdf_visible(wo, m) / (4.f * std::abs(glm::dot(wo, m)));
  }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport) const override {
    if (wo.z == 0.f) return std::nullopt;
    const float r = reflectance(wo.z);
    if (u_lobe < r) return smooth_ ? mirrored(wo, r) : reflected(wo, u, r);
    return BsdfSample{.wi = {0.f, 0.f, wo.z > 0.f ? -1.f : 1.f},
                      .weight = Rgb(1.f),
                      .pdf = 1.f - r,
                      .pdf_reverse = cosine_density(wo),
                      .beneath = &profile_};
  }
  // What diffuses beneath can be lit only where it leaves, which is another vertex.
  bool connectible() const override { return !smooth_; }
  Rgb albedo(const vec3& wo) const override {
    return glm::mix(profile_.albedo(), Rgb(1.f), reflectance(wo.z));
  }

 private:
  float reflectance(float cosine) const {
    return fresnel_dielectric(std::abs(cosine), profile_.eta());
  }
  static BsdfSample mirrored(const vec3& wo, float r) {
    return {
        .wi = {-wo.x, -wo.y, wo.z}, .weight = Rgb(1.f), .pdf = r, .pdf_reverse = r, .delta = true};
  }
  std::optional<BsdfSample> reflected(const vec3& wo, const vec2& u, float r) const {
    const std::optional<vec3> m = ggx_.sample_visible(wo, u);
    if (!m) return std::nullopt;
    BsdfSample s;
    s.wi = glm::normalize(reflect(wo, *m));
    s.pdf = pdf(wo, s.wi);
    s.pdf_reverse = pdf(s.wi, wo);
    if (!(s.pdf > 0.f)) return std::nullopt;
    s.weight = Rgb(reflectance(glm::dot(wo, *m)) * ggx_.shadowing(wo, s.wi) / r);
    return s;
  }
  const DiffusionProfile& profile_;
  Ggx ggx_;
  bool smooth_;
};

class ExitBsdf final : public Bsdf {
 public:
  ExitBsdf(const DiffusionProfile& profile, float side) : profile_(profile), side_(side) {}

  Rgb eval(const vec3&, const vec3& wi, Transport) const override {
    return Rgb(outside(wi) ? enters(wi, profile_.eta()) / profile_.leaving() : 0.f);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    if (wi == beneath) return outside(wo) ? enters(wo, profile_.eta()) : 0.f;
    return outside(wi) ? cosine_density(wi) : 0.f;
  }
  std::optional<BsdfSample> sample(const vec3&, float, const vec2& u, Transport) const override {
    BsdfSample s;
    s.wi = cosine_hemisphere(u);
    s.wi.z *= side_;
    s.pdf = cosine_density(s.wi);
    if (!(s.pdf > 0.f)) return std::nullopt;
    s.pdf_reverse = enters(s.wi, profile_.eta());
    s.weight = Rgb(s.pdf_reverse * pi / profile_.leaving());
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return profile_.albedo(); }

 private:
  bool outside(const vec3& w) const { return w.z * side_ > 0.f; }
  const DiffusionProfile& profile_;
  float side_;
};

}  // namespace

const Bsdf* make_entry_bsdf(const DiffusionProfile& profile, const Ggx& ggx, BsdfStorage& storage) {
  return storage.make<EntryBsdf>(profile, ggx);
}

const Bsdf* make_exit_bsdf(const DiffusionProfile& profile, float side, BsdfStorage& storage) {
  return storage.make<ExitBsdf>(profile, side);
}

}  // namespace pssmlt
