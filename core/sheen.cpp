#include "core/sheen.h"

#include <algorithm>

namespace pssmlt {
namespace {

constexpr int quadrature = 32;  // points an axis over directions

// The fit of the logarithm of Lambda (Estevez, Kulla 2017, eq. 3).
float fitted(float x, float alpha) {
  const float t = sqr(1.f - alpha);
  const auto between = [t](float rough, float smooth) { return t * smooth + (1.f - t) * rough; };
  const float a = between(21.5473f, 25.3245f), b = between(3.82987f, 3.32435f);
  const float c = between(0.19823f, 0.16801f), d = between(-1.97760f, -1.27393f);
  const float e = between(-4.32054f, -4.85967f);
  return a / (1.f + b * std::pow(x, c)) + d * x + e;
}

float lambda(float mu, float alpha) {
  if (mu < 0.5f) return std::exp(fitted(mu, alpha));
  return std::exp(2.f * fitted(0.5f, alpha) - fitted(1.f - mu, alpha));
}

float alpha_of(float roughness) { return sqr(std::max(roughness, Sheen::least_roughness)); }

// Without the factor that keeps its albedo below one.
float raw_value(const vec3& wo, const vec3& wi, float alpha) {
  const float zo = std::abs(wo.z), zi = std::abs(wi.z);
  const vec3 h = wo + wi;
  const float l2 = length_squared(h);
  if (!(l2 > 0.f) || !(zo > 0.f) || !(zi > 0.f)) return 0.f;
  const float sine2 = std::max(0.f, 1.f - sqr(h.z) / l2);
  const float d = (2.f + 1.f / alpha) * std::pow(sine2, 0.5f / alpha) * (0.5f * inv_pi);
  return d / ((1.f + lambda(zo, alpha) + lambda(zi, alpha)) * 4.f * zo * zi);
}

float integrate(float mu, float alpha) {
  const vec3 wo(safe_sqrt(1.f - mu * mu), 0.f, mu);
  double sum = 0.0;
  for (int j = 0; j < quadrature; ++j) {
    const float z = (static_cast<float>(j) + 0.5f) / quadrature, r = safe_sqrt(1.f - z * z);
    for (int i = 0; i < quadrature; ++i) {
      const float phi = pi * (static_cast<float>(i) + 0.5f) / quadrature;
      const vec3 wi(r * std::cos(phi), r * std::sin(phi), z);
      sum += static_cast<double>(z * raw_value(wo, wi, alpha));
    }
  }
  return static_cast<float>(sum * 2.0 * std::numbers::pi / sqr(double{quadrature}));
}

struct Cell {
  size_t index;
  float share;
};
Cell cell(float x, int size) {
  const float scaled = std::clamp(x, 0.f, 1.f) * static_cast<float>(size - 1);
  const int i = std::min(static_cast<int>(scaled), size - 2);
  return {static_cast<size_t>(i), scaled - static_cast<float>(i)};
}

float mixed(float a, float b, float share) { return a + share * (b - a); }

}  // namespace

const Sheen& Sheen::table() {
  static const Sheen made;
  return made;
}

Sheen::Sheen() {
  for (size_t j = 0; j < size; ++j) {
    const float alpha = alpha_of(static_cast<float>(j) / (size - 1));
    float largest = 1.f;
    for (size_t i = 0; i < size; ++i) {
      const float mu = std::max(sqr(static_cast<float>(i) / (size - 1)), 1e-3f);
      albedo_[j][i] = integrate(mu, alpha);
      largest = std::max(largest, albedo_[j][i]);
    }
    factors_[j] = 1.f / largest;
    for (float& a : albedo_[j]) a /= largest;
  }
}

float Sheen::factor(float roughness) const {
  const Cell c = cell(roughness, size);
  return mixed(factors_[c.index], factors_[c.index + 1], c.share);
}

float Sheen::value(const vec3& wo, const vec3& wi, float roughness) const {
  return factor(roughness) * raw_value(wo, wi, alpha_of(roughness));
}

float Sheen::albedo(float mu, float roughness) const {
  const Cell r = cell(roughness, size), m = cell(std::sqrt(mu), size);
  const auto row = [&](size_t j) {
    return mixed(albedo_[j][m.index], albedo_[j][m.index + 1], m.share);
  };
  return mixed(row(r.index), row(r.index + 1), r.share);
}

}  // namespace pssmlt
