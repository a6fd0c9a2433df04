#include "core/coat.h"

#include <cmath>

#include "core/color/fresnel.h"

namespace pssmlt {
namespace {

constexpr int quadrature = 32;     // points an axis over visible normals
constexpr int mean_points = 1024;  // over directions

vec3 direction(float mu, float side) { return {safe_sqrt(1.f - mu * mu), 0.f, side * mu}; }

}  // namespace

Coat::Coat(float eta, float thickness, float alpha)
    : eta_(eta), thickness_(thickness), ggx_(alpha, alpha), smooth_(ggx_.is_smooth()) {
  if (!smooth_) tabulate();
  integrate();
}

Coat::Fractions Coat::smooth(const vec3& w) const {
  const float f = fresnel_dielectric(w.z, eta_);
  if (w.z < 0.f) return {f, f * sqr(left(w.z))};
  const auto inside = refract(w, vec3(0.f, 0.f, 1.f), eta_);
  return {f, inside ? (1.f - f) * left(inside->direction.z) : 0.f};
}

Coat::Fractions Coat::rough(const vec3& w) const {
  Fractions sum;
  for (int j = 0; j < quadrature; ++j) {
    for (int i = 0; i < quadrature; ++i) {
      const vec2 u((static_cast<float>(i) + 0.5f) / quadrature,
                   (static_cast<float>(j) + 0.5f) / quadrature);
      const auto m = ggx_.sample_visible(w, u);
      if (!m) continue;
      const float f = fresnel_dielectric(glm::dot(w, *m), eta_);
      const vec3 mirrored = reflect(w, *m);
      if (mirrored.z * w.z > 0.f) {
        const float part = f * ggx_.shadowing(w, mirrored);
        sum.reflected += part;
        if (w.z < 0.f) sum.inside += part * left(w.z) * left(mirrored.z);
      }
      const auto refracted = refract(w, *m, eta_);
      if (w.z > 0.f && refracted && refracted->direction.z < 0.f) {
        sum.inside +=
            (1.f - f) * ggx_.shadowing(w, refracted->direction) * left(refracted->direction.z);
      }
    }
  }
  return {sum.reflected / sqr(float{quadrature}), sum.inside / sqr(float{quadrature})};
}

void Coat::tabulate() {
  for (int i = 0; i < size; ++i) {
    // Not quite grazing, where nothing has a width.
    const float mu = std::max(sqr(static_cast<float>(i) / (size - 1)), 1e-5f);
    const Fractions f = rough(direction(mu, 1.f));
    reflected_[static_cast<size_t>(i)] = f.reflected;
    transmitted_[static_cast<size_t>(i)] = f.inside;
  }
}

void Coat::integrate() {
  double transmitted = 0.0, back = 0.0;
  const int points = smooth_ ? mean_points : size;
  for (int i = 0; i < points; ++i) {
    // Uniform in mu^2: weights are equal under a cosine.
    const float mu = std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(points));
    transmitted += static_cast<double>(this->transmitted(mu));
    back += static_cast<double>(fractions(direction(mu, -1.f)).inside);
  }
  mean_transmitted_ = static_cast<float>(transmitted / points);
  sent_back_ = static_cast<float>(back / points);
}

float Coat::at(const Table& table, float mu) {
  const float x = std::sqrt(mu) * (size - 1);
  const int i = std::min(static_cast<int>(x), size - 2);
  const float t = x - static_cast<float>(i);
  return (1.f - t) * table[static_cast<size_t>(i)] + t * table[static_cast<size_t>(i) + 1];
}

float Coat::reflected(float mu) const {
  return smooth_ ? fresnel_dielectric(mu, eta_) : at(reflected_, mu);
}

float Coat::transmitted(float mu) const {
  return smooth_ ? smooth(direction(mu, 1.f)).inside : at(transmitted_, mu);
}

}  // namespace pssmlt
