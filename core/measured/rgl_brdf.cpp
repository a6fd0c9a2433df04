#include "core/measured/rgl_brdf.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/warp.h"
#include "core/microfacet.h"

namespace pssmlt {
namespace {

// Of samples by the cosine: so that no direction is left out where the tables' densities are zero.
constexpr float cosine_share = 0.05f;

vec2 to_square(const vec3& w) {
  const float theta = std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z);
  const float phi = std::atan2(w.y, w.x);
  return {std::sqrt(theta * (2.f * inv_pi)), phi * (0.5f * inv_pi) + 0.5f};
}
vec3 from_square(const vec2& u) {
  const float theta = u.x * u.x * (0.5f * pi), phi = (2.f * u.y - 1.f) * pi;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
// Solid angle over area of the square [sr].
float square_to_sphere(const vec2& u) {
  const float theta = u.x * u.x * (0.5f * pi);
  return std::max(2.f * sqr(pi) * u.x * std::sin(theta), 1e-9f);
}
float in_unit(float x) { return x - std::floor(x); }

template <typename T>
T on_grid(const T* values, const vec2& u, int width, int height) {
  const GridCell c = grid_cell(u, width, height);
  const auto w = static_cast<size_t>(width);
  const size_t at = static_cast<size_t>(c.y) * w + static_cast<size_t>(c.x);
  const T low = (1.f - c.fx) * values[at] + c.fx * values[at + 1];
  const T high = (1.f - c.fx) * values[at + w] + c.fx * values[at + w + 1];
  return (1.f - c.fy) * low + c.fy * high;
}

}  // namespace

float RglBrdf::Field::at(const vec2& u) const { return on_grid(values.data(), u, width, height); }

Rgb RglBrdf::colour(const GridBlend& blend, const vec2& u) const {
  const size_t size = static_cast<size_t>(width_) * static_cast<size_t>(height_);
  Rgb sum(0.f);
  for (size_t k = 0; k < 4; ++k)
    if (blend.weight[k] > 0.f)
      sum += blend.weight[k] * on_grid(colours_.data() + blend.grid[k] * size, u, width_, height_);
  return glm::max(sum, Rgb(0.f));
}

float RglBrdf::table_azimuth(const vec3& w) const {
  const float phi = std::atan2(w.y, w.x);
  return phi < axes_.first().front() && axes_.first().back() > pi * 1.001f ? phi + 2.f * pi : phi;
}

vec2 RglBrdf::mirroring(const vec3& wo) const {
  const vec2 along = vec2(wo.x, wo.y) * middle_;
  const auto sign = [](float x) { return x < 0.f ? -1.f : 1.f; };
  if (symmetry_ == 4) return {sign(along.x), sign(along.y)};
  return symmetry_ == 2 ? vec2(sign(along.x + along.y)) : vec2(1.f);
}

RglBrdf::Place RglBrdf::place(const vec3& wo_in, const vec3& wi_in) const {
  const vec3 turn(mirroring(wo_in), 1.f);
  const vec3 wo = wo_in * turn, wi = wi_in * turn;
  const vec3 m = glm::normalize(wo + wi);
  Place p;
  p.wo = to_square(wo);
  p.m = to_square(m);
  if (isotropic_) p.m.y = in_unit(p.m.y - p.wo.y + 0.5f);
  p.blend = axes_.at(table_azimuth(wo), p.wo.x * p.wo.x * (0.5f * pi));
  p.wo_dot_m = glm::dot(wo, m);
  return p;
}

Rgb RglBrdf::eval(const vec3& wo, const vec3& wi) const {
  if (!(wo.z > 0.f) || !(wi.z > 0.f)) return Rgb(0.f);
  const Place p = place(wo, wi);
  const vec2 u = visible_.invert(p.blend, p.m).point;
  const Rgb f_cos = colour(p.blend, u);
  const float cosine = std::max(wi.z, 1e-7f);
  if (!jacobian_) return f_cos / cosine;
  const float sigma = sigma_.at(p.wo);
  if (!(sigma > 0.f)) return Rgb(0.f);
  return f_cos * (ndf_.at(p.m) / (4.f * sigma * cosine));
}

float RglBrdf::pdf(const vec3& wo, const vec3& wi) const {
  if (!(wo.z > 0.f) || !(wi.z > 0.f)) return 0.f;
  const Place p = place(wo, wi);
  const BilinearWarp::Mapped u = visible_.invert(p.blend, p.m);
  const float normals =
      u.density * luminance_.density(p.blend, u.point) / square_to_sphere(p.m);  // [1/sr]
  const float table = p.wo_dot_m > 0.f ? normals / (4.f * p.wo_dot_m) : 0.f;
  return (1.f - cosine_share) * table + cosine_share * wi.z * inv_pi;
}

std::optional<vec3> RglBrdf::sample(const vec3& wo_in, float u_lobe, const vec2& u) const {
  if (u_lobe < cosine_share) return cosine_hemisphere(u);
  const vec3 turn(mirroring(wo_in), 1.f);
  const vec3 wo = wo_in * turn;
  const vec2 at = to_square(wo);
  const GridBlend blend = axes_.at(table_azimuth(wo), at.x * at.x * (0.5f * pi));
  vec2 m = visible_.sample(blend, luminance_.sample(blend, u).point).point;
  if (isotropic_) m.y = in_unit(m.y + at.y - 0.5f);
  const vec3 wi = reflect(wo, from_square(m));
  if (!(wi.z > 0.f)) return std::nullopt;
  return glm::normalize(wi * turn);
}

}  // namespace pssmlt
