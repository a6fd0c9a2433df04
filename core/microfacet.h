// The GGX (Trowbridge-Reitz) distribution of microfacet normals with Smith's height-correlated
// masking and shadowing (Walter et al. 2007; Heitz 2014, Understanding the Masking-Shadowing
// Function). All directions are local, z is the normal; those below the surface are mirrored.
#pragma once

#include <algorithm>
#include <optional>

#include "core/base/math.h"

namespace pssmlt {

class Ggx {
 public:
  // Below this width a lobe is narrower than float half vectors resolve, and is a mirror (pbrt-v4).
  static constexpr float smooth_below = 1e-3f;

  // Widths along x and y [1], >= 0. A lobe that is smooth along one axis only keeps a small width.
  Ggx(float alpha_x, float alpha_y) : ax_(alpha_x), ay_(alpha_y) {
    if (is_smooth()) return;
    ax_ = std::max(ax_, 1e-4f);
    ay_ = std::max(ay_, 1e-4f);
  }
  // Width for a perceptually even roughness in [0, 1] (pbrt-v4's "remaproughness").
  static float remap(float roughness) { return std::sqrt(roughness); }

  // The root of both widths' product.
  float width() const { return std::sqrt(ax_ * ay_); }
  bool is_smooth() const { return std::max(ax_, ay_) < smooth_below; }

  // Density of normals [1/sr] per projected area: its integral times cos is 1.
  float d(const vec3& m) const {
    const float s = sqr(m.x / ax_) + sqr(m.y / ay_) + sqr(m.z);
    return inv_pi / (ax_ * ay_ * s * s);
  }
  // G2(wo, wi) / (4 |wo.z| |wi.z|), in a form without cancellation.
  float visibility(const vec3& wo, const vec3& wi) const {
    const float zo = std::abs(wo.z), zi = std::abs(wi.z);
    return 0.5f / (zi * stretched(wo) + zo * stretched(wi));
  }
  // G2(wo, wi) / G1(wo): the weight of a sample of visible normals, in [0, 1].
  float shadowing(const vec3& wo, const vec3& wi) const {
    const float zo = std::abs(wo.z), zi = std::abs(wi.z), so = stretched(wo);
    return zi * (zo + so) / (zi * so + zo * stretched(wi));
  }
  // Density [1/sr] of sample_visible(w) at m: G1(w) |w.m| D(m) / |w.z|.
  float pdf_visible(const vec3& w, const vec3& m) const {
    return 2.f * d(m) * std::abs(glm::dot(w, m)) / (std::abs(w.z) + stretched(w));
  }
  // A normal (z > 0) among those visible from w, by spherical caps (Dupuy, Benyoub 2023, Sampling
  // Visible GGX Normals with Spherical Caps); nullopt if rounding leaves none.
  std::optional<vec3> sample_visible(const vec3& w, const vec2& u) const {
    const vec3 up = w.z < 0.f ? -w : w;
    const vec3 standard = glm::normalize(vec3(ax_ * up.x, ay_ * up.y, up.z));
    const float phi = 2.f * pi * u.x;
    const float z = (1.f - u.y) * (1.f + standard.z) - standard.z;
    const float sine = safe_sqrt(1.f - z * z);
    const vec3 h = vec3(sine * std::cos(phi), sine * std::sin(phi), z) + standard;
    const vec3 m(ax_ * h.x, ay_ * h.y, h.z);
    const float l2 = length_squared(m);
    if (!(l2 > 0.f) || !(m.z > 0.f)) return std::nullopt;
    // w below the surface sees the mirrored normals from the other side.
    return m / std::sqrt(l2);
  }

 private:
  // |w.z| (1 + 2 Lambda(w)).
  float stretched(const vec3& w) const {
    return std::sqrt(sqr(ax_ * w.x) + sqr(ay_ * w.y) + sqr(w.z));
  }
  float ax_, ay_;
};

inline vec3 reflect(const vec3& w, const vec3& m) { return 2.f * glm::dot(w, m) * m - w; }

struct Refraction {
  vec3 direction{0.f};  // unit, on the other side of m
  float eta = 1.f;      // index on the far side over that on w's side
};

// w refracted at a facet m that separates the outside (toward m) from an inside of relative index
// eta; nullopt on total internal reflection.
inline std::optional<Refraction> refract(const vec3& w, const vec3& m, float eta) {
  const float cosine = glm::dot(w, m);
  const vec3 n = cosine < 0.f ? -m : m;
  const float ratio = cosine < 0.f ? 1.f / eta : eta;
  const float c = std::min(std::abs(cosine), 1.f);
  const float sin2_t = (1.f - c * c) / (ratio * ratio);
  if (sin2_t >= 1.f) return std::nullopt;
  const float cos_t = std::sqrt(1.f - sin2_t);
  return Refraction{glm::normalize(-w / ratio + (c / ratio - cos_t) * n), ratio};
}

}  // namespace pssmlt
