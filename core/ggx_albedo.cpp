#include "core/ggx_albedo.h"

#include "core/microfacet.h"

namespace pssmlt {
namespace {

constexpr int quadrature = 20;    // points an axis over visible normals
constexpr int mean_points = 512;  // over directions

float fifth_power(float x) { return sqr(sqr(x)) * x; }

SchlickAlbedo mirror(float mu) {
  const float grazing = fifth_power(1.f - mu);
  return {1.f - grazing, grazing};
}

SchlickAlbedo integrate(float mu, float alpha) {
  const Ggx ggx(alpha, alpha);
  const vec3 wo(safe_sqrt(1.f - mu * mu), 0.f, mu);
  SchlickAlbedo sum;
  for (int j = 0; j < quadrature; ++j) {
    for (int i = 0; i < quadrature; ++i) {
      const vec2 u((static_cast<float>(i) + 0.5f) / quadrature,
                   (static_cast<float>(j) + 0.5f) / quadrature);
      const auto m = ggx.sample_visible(wo, u);
      if (!m) continue;
      const vec3 wi = reflect(wo, *m);
      if (!(wi.z > 0.f)) continue;
      const float part = ggx.shadowing(wo, wi);
      const float grazing = fifth_power(1.f - std::min(std::abs(glm::dot(wo, *m)), 1.f));
      sum.low += part * (1.f - grazing);
      sum.high += part * grazing;
    }
  }
  return {sum.low / sqr(float{quadrature}), sum.high / sqr(float{quadrature})};
}

SchlickAlbedo mixed(const SchlickAlbedo& a, const SchlickAlbedo& b, float share) {
  return {a.low + share * (b.low - a.low), a.high + share * (b.high - a.high)};
}

struct Cell {
  size_t index;
  float share;
};
Cell cell(float x, int size) {
  const float scaled = std::sqrt(std::clamp(x, 0.f, 1.f)) * static_cast<float>(size - 1);
  const int i = std::min(static_cast<int>(scaled), size - 2);
  return {static_cast<size_t>(i), scaled - static_cast<float>(i)};
}

}  // namespace

const GgxAlbedo& GgxAlbedo::table() {
  static const GgxAlbedo made;
  return made;
}

SchlickAlbedo GgxAlbedo::in_row(const Row& row, float mu) {
  const Cell c = cell(mu, size);
  return mixed(row[c.index], row[c.index + 1], c.share);
}

GgxAlbedo::GgxAlbedo() {
  for (int j = 0; j < size; ++j) {
    const auto row = static_cast<size_t>(j);
    const float alpha = sqr(static_cast<float>(j) / (size - 1));
    for (int i = 0; i < size; ++i) {
      // Not quite grazing, where nothing has a width.
      const float mu = std::max(sqr(static_cast<float>(i) / (size - 1)), 1e-5f);
      rows_[row][static_cast<size_t>(i)] = j == 0 ? mirror(mu) : integrate(mu, alpha);
    }
    double low = 0.0, high = 0.0;
    for (int i = 0; i < mean_points; ++i) {
      // Uniform in mu^2: weights are equal under a cosine.
      const float mu = std::sqrt((static_cast<float>(i) + 0.5f) / mean_points);
      const SchlickAlbedo a = in_row(rows_[row], mu);
      low += static_cast<double>(a.low);
      high += static_cast<double>(a.high);
    }
    means_[row] = {static_cast<float>(low / mean_points), static_cast<float>(high / mean_points)};
  }
}

SchlickAlbedo GgxAlbedo::at(float mu, float alpha) const {
  const Cell c = cell(alpha, size);
  return mixed(in_row(rows_[c.index], mu), in_row(rows_[c.index + 1], mu), c.share);
}

SchlickAlbedo GgxAlbedo::mean(float alpha) const {
  const Cell c = cell(alpha, size);
  return mixed(means_[c.index], means_[c.index + 1], c.share);
}

}  // namespace pssmlt
