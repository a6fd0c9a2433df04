#include "core/dielectric_bsdf.h"

#include "core/color/fresnel.h"
#include "core/rough_interface.h"

namespace pssmlt {
namespace {

class SmoothDielectricBsdf final : public Bsdf {
 public:
  explicit SmoothDielectricBsdf(float eta) : eta_(eta) {}

  Rgb eval(const vec3&, const vec3&, Transport) const override { return Rgb(0.f); }
  float pdf(const vec3&, const vec3&) const override { return 0.f; }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2&,
                                   Transport mode) const override {
    if (wo.z == 0.f) return std::nullopt;
    const float r = fresnel_dielectric(wo.z, eta_);
    if (u_lobe < r)
      return BsdfSample{.wi = {-wo.x, -wo.y, wo.z},
                        .weight = Rgb(1.f),
                        .pdf = r,
                        .pdf_reverse = r,
                        .delta = true};
    const std::optional<Refraction> t = refract(wo, vec3(0.f, 0.f, 1.f), eta_);
    if (!t || !(wo.z * t->direction.z < 0.f)) return std::nullopt;
    return BsdfSample{.wi = t->direction,
                      .weight = Rgb(refracted_radiance_scale(t->eta, mode)),
                      .pdf = 1.f - r,
                      .pdf_reverse = 1.f - r,
                      .delta = true,
                      .transmitted = true,
                      .eta = t->eta};
  }
  bool connectible() const override { return false; }
  Rgb albedo(const vec3&) const override { return Rgb(1.f); }

 private:
  float eta_;
};

class RoughDielectricBsdf final : public Bsdf {
 public:
  RoughDielectricBsdf(float eta, const Ggx& ggx) : interface_(eta, ggx), ggx_(ggx) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport mode) const override {
    const std::optional<RoughInterface::Facet> f = interface_.facet(wo, wi);
    return Rgb(f ? interface_.value(*f, wo, wi, mode) : 0.f);
  }
  float pdf(const vec3& wo, const vec3& wi) const override {
    const std::optional<RoughInterface::Facet> f = interface_.facet(wo, wi);
    return f ? interface_.density(wo, *f) : 0.f;
  }
  std::optional<BsdfSample> sample(const vec3& wo, float u_lobe, const vec2& u,
                                   Transport mode) const override {
    const std::optional<RoughInterface::Draw> drawn = interface_.draw(wo, u_lobe, u);
    if (!drawn) return std::nullopt;
    const RoughInterface::Facet& f = drawn->facet;
    BsdfSample s;
    s.wi = drawn->wi;
    s.transmitted = !f.reflects;
    s.eta = f.eta;
    const float scale = f.reflects ? 1.f : refracted_radiance_scale(f.eta, mode);
    s.weight = Rgb(ggx_.shadowing(wo, s.wi) * scale);
    s.pdf = interface_.density(wo, f);
    s.pdf_reverse = interface_.density(s.wi, RoughInterface::reversed(f));
    if (!(s.pdf > 0.f)) return std::nullopt;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return Rgb(1.f); }

 private:
  RoughInterface interface_;
  Ggx ggx_;
};

}  // namespace

const Bsdf* make_dielectric_bsdf(float eta, const Ggx& ggx, BsdfStorage& storage) {
  if (refracts_sharply(eta, ggx)) return storage.make<SmoothDielectricBsdf>(eta);
  return storage.make<RoughDielectricBsdf>(eta, ggx);
}

}  // namespace pssmlt
