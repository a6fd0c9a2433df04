#include "core/shapes/quadric.h"

#include <glm/matrix.hpp>

namespace pssmlt {
namespace {

// The common length of the columns if they are orthogonal and equally long (to what matrices
// written in single precision can say), else 0.
double similarity_of(const glm::dmat3& m) {
  const double l = glm::length(m[0]);
  const double tolerance = 1e-5 * l * l;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      if (!(std::abs(glm::dot(m[i], m[j]) - (i == j ? l * l : 0.0)) <= tolerance)) return 0.0;
  return l;
}

// Bound on the rounding of a point to single precision, with a factor of 2 for what later steps do
// with it.
vec3 rounding_error(const dvec3& p) { return vec3(glm::abs(p) * 0x1p-23 + 1e-40); }

}  // namespace

double azimuth(double x, double y) {
  const double phi = std::atan2(y, x);
  return phi < 0.0 ? phi + 2.0 * std::numbers::pi : phi;
}

QuadricShape::QuadricShape(const Parameters& p)
    : to_render_(p.transform()),
      linear_(p.transform().matrix()),
      side_(p.reverse_orientation() ? -1.0 : 1.0),
      determinant_(std::abs(glm::determinant(linear_))),
      similarity_(similarity_of(linear_)) {}

Bounds QuadricShape::bounds() const {
  dvec3 low, high;
  local_box(low, high);
  Bounds b;
  for (int i = 0; i < 8; ++i) {
    const dvec3 corner((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                       (i & 4) != 0 ? high.z : low.z);
    const dvec3 p = to_render_.point(corner);
    const vec3 rounded(p), margin = 2.f * rounding_error(p);
    b.add(rounded - margin);
    b.add(rounded + margin);
  }
  return b;
}

std::optional<UserHit> QuadricShape::intersect(const Ray& ray, float t_min) const {
  const dmat4& to_object = to_render_.inverse_matrix();
  const dvec3 origin(to_object * glm::dvec4(dvec3(ray.origin), 1.0));
  const dvec3 direction(to_object * glm::dvec4(dvec3(ray.direction), 0.0));
  const auto root = intersect_local(origin, direction, static_cast<double>(t_min),
                                    static_cast<double>(ray.t_max));
  if (!root) return std::nullopt;
  return UserHit{static_cast<float>(root->t), vec2(root->uv), 0};
}

vec3 QuadricShape::render_normal(const dvec3& normal) const {
  return vec3(side_ * glm::normalize(to_render_.normal(normal)));
}

void QuadricShape::fill(const vec2& where, Hit& hit) const { fill_at(dvec2(where), hit); }

void QuadricShape::fill_at(const dvec2& uv, Hit& hit) const {
  const Local local = at(uv);
  const dvec3 p = to_render_.point(local.position);
  const dvec3 n = to_render_.normal(local.normal);
  const double length = glm::length(n);
  const dvec3 unit = n / length;
  // Derivative of the normalised transformed normal.
  const auto normal_derivative = [&](const dvec3& dn) {
    const dvec3 d = to_render_.normal(dn) / length;
    return vec3(side_ * (d - unit * glm::dot(unit, d)));
  };
  hit.position = vec3(p);
  hit.error = rounding_error(p);
  hit.ng = hit.ns = vec3(side_ * unit);
  hit.dpdu = vec3(to_render_.vector(local.dpdu));
  hit.dpdv = vec3(to_render_.vector(local.dpdv));
  hit.dndu = normal_derivative(local.dndu);
  hit.dndv = normal_derivative(local.dndv);
  hit.uv = vec2(uv);
}

float QuadricShape::grain() const {
  const Bounds b = bounds();
  // An angle is a part of the turn, rounded to 2^-25, and a circle pi times as long as wide.
  return 0x1p-23f * glm::distance(b.min, b.max);
}

void QuadricShape::refine(const dvec3& origin, const dvec3& direction, Hit& hit) const {
  const dmat4& to_object = to_render_.inverse_matrix();
  // The same of two roots, not the one where the ray may start.
  const double t = static_cast<double>(hit.distance);
  const auto root =
      intersect_local(dvec3(to_object * glm::dvec4(origin, 1.0)),
                      dvec3(to_object * glm::dvec4(direction, 0.0)), 0.5 * t, 2.0 * t);
  if (!root) return;
  fill_at(root->uv, hit);
  hit.distance = static_cast<float>(root->t);
  hit.where = vec2(root->uv);
}

SurfaceSample QuadricShape::surface_point(const dvec2& uv) const {
  const Local local = at(uv);
  const dvec3 p = to_render_.point(local.position);
  SurfaceSample s;
  s.position = vec3(p);
  s.error = rounding_error(p);
  s.normal = render_normal(local.normal);
  s.uv = vec2(uv);
  return s;
}

SurfaceSample QuadricShape::sample_area(const vec2& u) const {
  SurfaceSample s = surface_point(sample_uv(dvec2(u)));
  s.pdf = pdf_area(s);
  return s;
}

float QuadricShape::pdf_area(const SurfaceSample& at) const {
  // An area element with unit normal n in render space is |det A| / |A^T n| times as large as in
  // object space.
  const double shrinks = glm::length(glm::transpose(linear_) * dvec3(at.normal)) / determinant_;
  return static_cast<float>(shrinks / local_area());
}

float QuadricShape::area() const {
  std::call_once(area_once_, [this] {
    if (similarity_ > 0.0) {
      area_ = static_cast<float>(local_area() * similarity_ * similarity_);
      return;
    }
    // Midpoint rule over the uniformly sampled parameters: the integrand is smooth, periodic in
    // one of them.
    constexpr int rows = 512, columns = 64;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const dvec2 uv = sample_uv({(i + 0.5) / rows, (j + 0.5) / columns});
        sum += glm::length(to_render_.normal(at(uv).normal));
      }
    area_ = static_cast<float>(local_area() * determinant_ * sum / (rows * columns));
  });
  return area_;
}

}  // namespace pssmlt
