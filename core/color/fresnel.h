// Fresnel reflectance of unpolarised light at smooth interfaces (Born and Wolf, Principles of
// Optics, sections 1.5.2 and 14.2).
#pragma once

#include <algorithm>

#include "core/base/rgb.h"

namespace pssmlt {

// Dielectric. eta: refractive index of the inside over that of the outside; cos_i: cosine of the
// incident direction to the normal, negative when it comes from inside. 1 on total internal
// reflection.
inline float fresnel_dielectric(float cos_i, float eta) {
  if (cos_i < 0.f) {
    eta = 1.f / eta;
    cos_i = -cos_i;
  }
  cos_i = std::min(cos_i, 1.f);
  const float sin2_t = (1.f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.f) return 1.f;
  const float cos_t = std::sqrt(1.f - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Conductor with complex index eta + i k over that of the outside; |cos_i| is used.
template <typename Real>
Real fresnel_conductor(Real cos_i, Real eta, Real k) {
  const Real c = std::min(std::abs(cos_i), Real(1));
  const Real c2 = c * c, s2 = 1 - c2;
  const Real t0 = eta * eta - k * k - s2;
  // a^2 + b^2 and a, where a + i b = sqrt((eta + i k)^2 - sin^2).
  const Real a2_plus_b2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k);
  const Real a = std::sqrt(std::max(Real(0), Real(0.5) * (a2_plus_b2 + t0)));
  const Real t1 = a2_plus_b2 + c2, t2 = 2 * c * a;
  if (!(t1 + t2 > 0)) return 1;  // grazing, and no contrast
  const Real perpendicular = (t1 - t2) / (t1 + t2);
  const Real t3 = c2 * a2_plus_b2 + s2 * s2, t4 = t2 * s2;
  if (!(t3 + t4 > 0)) return perpendicular;
  return Real(0.5) * perpendicular * (1 + (t3 - t4) / (t3 + t4));
}

// The same for each component.
inline Rgb fresnel_conductor(float cos_i, const Rgb& eta, const Rgb& k) {
  return {fresnel_conductor(cos_i, eta.x, k.x), fresnel_conductor(cos_i, eta.y, k.y),
          fresnel_conductor(cos_i, eta.z, k.z)};
}

// The k that gives a conductor with eta = 1 the reflectance r at normal incidence:
// 2 sqrt(r) / sqrt(1 - r). r is clipped to [0, 0.9999], as pbrt-v4 does.
inline Rgb conductor_k_from_reflectance(const Rgb& r) {
  const auto k = [](float value) {
    const float clipped = std::clamp(value, 0.f, 0.9999f);
    return 2.f * std::sqrt(clipped) / std::sqrt(1.f - clipped);
  };
  return {k(r.x), k(r.y), k(r.z)};
}

}  // namespace pssmlt
