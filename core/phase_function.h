// The phase function of Henyey and Greenstein 1941, Diffuse radiation in the Galaxy.
#pragma once

#include "core/base/frame.h"
#include "core/base/warp.h"
#include "core/bsdf.h"

namespace pssmlt {

// g in (-1, 1) is the mean cosine between the direction of flight before and after: positive values
// scatter forward. Both directions point away from the point, so light that is not deflected has
// dot(wo, wi) = -1.
class HenyeyGreenstein final : public Bsdf {
 public:
  explicit HenyeyGreenstein(float g) : g_(g) {}

  Rgb eval(const vec3& wo, const vec3& wi, Transport) const override { return Rgb(pdf(wo, wi)); }
  float pdf(const vec3& wo, const vec3& wi) const override { return value(glm::dot(wo, wi)); }
  std::optional<BsdfSample> sample(const vec3& wo, float, const vec2& u, Transport) const override {
    const float cos_theta = cosine(u.x);
    const float sin_theta = std::sqrt(std::fmax(0.f, 1.f - sqr(cos_theta)));
    const float phi = 2.f * pi * u.y;
    BsdfSample s;
    s.wi = Frame(wo).to_world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta});
    s.weight = Rgb(1.f);
    s.pdf = value(cos_theta);
    s.pdf_reverse = s.pdf;
    return s;
  }
  bool connectible() const override { return true; }
  Rgb albedo(const vec3&) const override { return Rgb(1.f); }

 private:
  float value(float cos_wo_wi) const {
    const float base = 1.f + g_ * g_ + 2.f * g_ * cos_wo_wi;
    return 0.25f * inv_pi * (1.f - g_ * g_) / (base * std::sqrt(std::fmax(base, 1e-12f)));
  }
  // dot(wo, wi) by inversion of the distribution function.
  float cosine(float u) const {
    if (std::abs(g_) < 1e-3f) return 1.f - 2.f * u;
    const float ratio = (1.f - g_ * g_) / (1.f + g_ - 2.f * g_ * u);
    return glm::clamp(-(1.f + g_ * g_ - ratio * ratio) / (2.f * g_), -1.f, 1.f);
  }
  float g_;
};

}  // namespace pssmlt
