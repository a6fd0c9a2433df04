#include "core/shapes/patch_shape.h"

#include <glm/matrix.hpp>

namespace pssmlt {
namespace {

template <typename V>
V bilinear(const std::vector<V>& values, const Quad& q, const dvec2& uv) {
  using Double = glm::vec<V::length(), double>;
  const auto along_u = [&](uint32_t a, uint32_t b) {
    return (1.0 - uv.x) * Double(values[a]) + uv.x * Double(values[b]);
  };
  return V((1.0 - uv.y) * along_u(q[0], q[1]) + uv.y * along_u(q[2], q[3]));
}

// Derivatives of bilinear() along u and v.
template <typename V>
std::array<V, 2> derivatives(const std::vector<V>& values, const Quad& q, const dvec2& uv) {
  const float u = static_cast<float>(uv.x), v = static_cast<float>(uv.y);
  return {(1.f - v) * (values[q[1]] - values[q[0]]) + v * (values[q[3]] - values[q[2]]),
          (1.f - u) * (values[q[2]] - values[q[0]]) + u * (values[q[3]] - values[q[1]])};
}

vec3 rounding_error(const dvec3& p) { return vec3(glm::abs(p) * 0x1p-23 + 1e-40); }

}  // namespace

PatchShape::PatchShape(PatchData data, const Parameters& p)
    : data_(std::move(data)), flip_(p.reverse_orientation() != p.transform().swaps_handedness()) {
  const Transform& to_render = p.transform();
  for (vec3& v : data_.positions) {
    v = to_render.point(v);
    if (!is_finite(v)) p.fail("P", "a vertex is beyond the range of single precision");
  }
  const double side = p.reverse_orientation() ? -1.0 : 1.0;
  for (vec3& n : data_.normals) {
    const dvec3 m = side * to_render.normal(dvec3(n));
    n = glm::length(m) > 0.0 ? vec3(glm::normalize(m)) : vec3(0.f);
  }
  std::vector<Bounds> boxes(data_.quads.size());
  std::vector<double> areas;
  for (uint32_t i = 0; i < data_.quads.size(); ++i) {
    for (const uint32_t corner : data_.quads[i]) {
      // A patch lies in the hull of its corners.
      const vec3& c = data_.positions[corner];
      boxes[i].add(c - rounding_error(dvec3(c)));
      boxes[i].add(c + rounding_error(dvec3(c)));
    }
    areas.push_back(patch_area(i));
    const Patch& q = patch(i);
    const double longest = std::max({glm::length(q.du(0.0)), glm::length(q.du(1.0)),
                                     glm::length(q.dv(0.0)), glm::length(q.dv(1.0))});
    grain_ = std::max(grain_, static_cast<float>(0x1p-24 * longest));  // two coordinates
  }
  tree_ = BoxTree(boxes);
  choice_ = Distribution1D(std::span<const double>(areas));
}

PatchShape::Patch PatchShape::patch(uint32_t element) const {
  const Quad& q = data_.quads[element];
  return {dvec3(data_.positions[q[0]]), dvec3(data_.positions[q[1]]), dvec3(data_.positions[q[2]]),
          dvec3(data_.positions[q[3]])};
}

dvec3 PatchShape::Patch::at(const dvec2& uv) const {
  return (1.0 - uv.y) * ((1.0 - uv.x) * p00 + uv.x * p10) +
         uv.y * ((1.0 - uv.x) * p01 + uv.x * p11);
}

// Reshetov 2019: u solves a quadratic whose zeros are the rulings that the line meets; v and t are
// those of the point of the ruling that is nearest to the line.
template <typename Accept>
void PatchShape::Patch::roots(const dvec3& o, const dvec3& d, double margin,
                              const Accept& accept) const {
  const dvec3 q00 = p00 - o, q10 = p10 - o, e00 = p01 - p00, e11 = p11 - p10;
  const double a = glm::dot(glm::cross(q00, d), e00);
  const double c = glm::dot(glm::cross(p10 - p00, p01 - p11), d);
  const double b = glm::dot(glm::cross(q10, d), e11) - a - c;
  std::array<double, 2> us{-1e30, -1e30};
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) return;
  const double half = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  // Both quotients are stable; where a denominator vanishes there is no such root.
  if (c != 0.0) us[0] = half / c;
  if (half != 0.0) us[1] = a / half;
  for (const double u : us) {
    if (!(u >= -margin && u <= 1.0 + margin)) continue;
    const dvec3 from = (1.0 - u) * q00 + u * q10, along = (1.0 - u) * e00 + u * e11;
    const dvec3 n = glm::cross(d, along);
    const double determinant = glm::dot(n, n);
    if (!(determinant > 0.0)) continue;
    const dvec3 m = glm::cross(n, from);
    const double v = glm::dot(m, d) / determinant;
    if (!(v >= -margin && v <= 1.0 + margin)) continue;
    accept(glm::dot(m, along) / determinant, dvec2(u, v));
  }
}

std::optional<UserHit> PatchShape::intersect(const Ray& ray, float t_min) const {
  const dvec3 o(ray.origin), d(ray.direction);
  const double low = static_cast<double>(t_min);
  std::optional<UserHit> nearest;
  tree_.walk(o, d, low, static_cast<double>(ray.t_max), [&](uint32_t element, double& t_max) {
    patch(element).roots(o, d, 0.0, [&](double t, const dvec2& uv) {
      if (!(t > low && t < t_max)) return;
      t_max = t;
      nearest = UserHit{static_cast<float>(t), vec2(uv), element};
    });
  });
  return nearest;
}

DirectionCone PatchShape::normals() const {
  if (!data_.normals.empty()) return {};
  DirectionCone cone = DirectionCone::none();
  for (uint32_t i = 0; i < data_.quads.size(); ++i) {
    for (const dvec2 corner : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}) {
      cone.add({vec3(outside(i, corner, vec3(0.f))), 1.f});
    }
  }
  return cone;
}

vec3 PatchShape::shading_normal(uint32_t element, const dvec2& uv) const {
  if (data_.normals.empty()) return vec3(0.f);
  const vec3 n = bilinear(data_.normals, data_.quads[element], uv);
  const float l2 = length_squared(n);
  return l2 > 0.f ? n / std::sqrt(l2) : vec3(0.f);
}

vec2 PatchShape::texture_uv(uint32_t element, const dvec2& uv) const {
  return data_.uvs.empty() ? vec2(uv) : bilinear(data_.uvs, data_.quads[element], uv);
}

dvec3 PatchShape::outside(uint32_t element, const dvec2& uv, const vec3& ns) const {
  const Patch q = patch(element);
  dvec3 n = q.cross(uv);
  // At a corner that two vertices share, the diagonals stand in.
  if (!(glm::length(n) > 0.0)) n = glm::cross(q.p11 - q.p00, q.p01 - q.p10);
  n = glm::length(n) > 0.0 ? glm::normalize(n) : dvec3(0.0, 0.0, 1.0);
  const double agreement = glm::dot(n, dvec3(ns));
  if (agreement != 0.0) return agreement < 0.0 ? -n : n;
  return flip_ ? -n : n;
}

void PatchShape::fill(const vec2& where, Hit& hit) const {
  const dvec2 uv(where);
  const Patch q = patch(hit.element);
  const dvec3 p = q.at(uv);
  hit.position = vec3(p);
  hit.error = rounding_error(p);
  const vec3 ns = shading_normal(hit.element, uv);
  hit.ng = vec3(outside(hit.element, uv, ns));
  hit.ns = length_squared(ns) > 0.f ? ns : hit.ng;
  hit.dpdu = vec3(q.du(uv.y));
  hit.dpdv = vec3(q.dv(uv.x));
  if (data_.normals.empty()) {
    // Of the unit normal of the surface itself: d(N / |N|) with N = dpdu x dpdv.
    const dvec3 n = q.cross(uv), mixed = q.p00 - q.p10 - q.p01 + q.p11;
    const double length = glm::length(n);
    const double sign = glm::dot(dvec3(hit.ng), n) < 0.0 ? -1.0 : 1.0;
    const auto derivative = [&](const dvec3& dn) {
      if (!(length > 0.0)) return vec3(0.f);
      return vec3(sign * (dn - n * (glm::dot(n, dn) / (length * length))) / length);
    };
    hit.dndu = derivative(glm::cross(q.du(uv.y), mixed));
    hit.dndv = derivative(glm::cross(mixed, q.dv(uv.x)));
  } else {
    const auto d = derivatives(data_.normals, data_.quads[hit.element], uv);
    hit.dndu = d[0];
    hit.dndv = d[1];
  }
  hit.uv = texture_uv(hit.element, uv);
  if (!data_.uvs.empty()) set_texture_derivatives(hit.element, uv, hit);
}

void PatchShape::refine(const dvec3& origin, const dvec3& direction, Hit& hit) const {
  const Patch q = patch(hit.element);
  // Of the two points that a line may meet, the one that was found.
  constexpr double margin = 0x1p-20;
  const dvec2 rounded(hit.where);
  double nearest = std::numeric_limits<double>::infinity();
  q.roots(origin, direction, margin, [&](double t, const dvec2& uv) {
    const double off = glm::distance(uv, rounded);
    if (!(t > 0.0) || !(off < nearest)) return;
    nearest = off;
    hit.where = vec2(uv);
    hit.position = vec3(q.at(uv));
    hit.distance = static_cast<float>(t);
    hit.uv = texture_uv(hit.element, uv);
  });
}

// From derivatives along the patch's parameters to those along the texture coordinates.
void PatchShape::set_texture_derivatives(uint32_t element, const dvec2& uv, Hit& hit) const {
  const auto d = derivatives(data_.uvs, data_.quads[element], uv);
  const float determinant = d[0].x * d[1].y - d[0].y * d[1].x;
  if (!(std::abs(determinant) >= 1e-9f)) return;
  const auto solve = [&](vec3& du, vec3& dv) {
    const vec3 s = (d[1].y * du - d[0].y * dv) / determinant;
    const vec3 t = (d[0].x * dv - d[1].x * du) / determinant;
    du = s;
    dv = t;
  };
  solve(hit.dpdu, hit.dpdv);
  solve(hit.dndu, hit.dndv);
}

double PatchShape::patch_area(uint32_t element) const {
  const Patch q = patch(element);
  // Midpoint rule; |dpdu x dpdv| is smooth but where a patch folds onto itself.
  constexpr int n = 16;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += glm::length(q.cross({(i + 0.5) / n, (j + 0.5) / n}));
  return sum / (n * n);
}

constexpr double everywhere = 0.1;  // of the points, whatever the emission

dvec2 PatchShape::sample_parameters(const dvec2& u) const {
  if (!(data_.emission.sum() > 0.0)) return u;
  if (u.x < everywhere) return {u.x / everywhere, u.y};
  const dvec2 at = data_.emission.sample({(u.x - everywhere) / (1.0 - everywhere), u.y}).uv;
  return {at.x, 1.0 - at.y};
}

double PatchShape::pdf_parameters(const dvec2& uv) const {
  if (!(data_.emission.sum() > 0.0)) return 1.0;
  return everywhere + (1.0 - everywhere) * data_.emission.pdf({uv.x, 1.0 - uv.y});
}

SurfaceSample PatchShape::sample_area(const vec2& u) const {
  SurfaceSample s;
  if (!(choice_.sum() > 0.0)) return s;
  const auto cell = choice_.sample(static_cast<double>(u.x));
  const dvec2 uv = sample_parameters({cell.offset, static_cast<double>(u.y)});
  const Patch q = patch(cell.index);
  const dvec3 p = q.at(uv);
  s.position = vec3(p);
  s.error = rounding_error(p);
  s.normal = vec3(outside(cell.index, uv, shading_normal(cell.index, uv)));
  s.uv = texture_uv(cell.index, uv);
  s.element = cell.index;
  const double stretch = glm::length(q.cross(uv));
  s.pdf = stretch > 0.0 ? static_cast<float>(cell.probability * pdf_parameters(uv) / stretch) : 0.f;
  return s;
}

dvec2 PatchShape::parameters(const SurfaceSample& at) const {
  if (data_.uvs.empty()) return dvec2(at.uv);
  // The parameters of the patch's point nearest along the normal: rounding has moved `at` by
  // little.
  dvec2 found(0.5);
  double nearest = std::numeric_limits<double>::infinity();
  patch(at.element)
      .roots(dvec3(at.position), dvec3(at.normal), 1e-3, [&](double t, const dvec2& uv) {
        if (std::abs(t) >= nearest) return;
        nearest = std::abs(t);
        found = uv;
      });
  return glm::min(glm::max(found, dvec2(0.0)), dvec2(1.0));
}

float PatchShape::pdf_area(const SurfaceSample& at) const {
  const dvec2 uv = parameters(at);
  const double stretch = glm::length(patch(at.element).cross(uv));
  const double pdf = choice_.probability(at.element) * pdf_parameters(uv);
  return stretch > 0.0 ? static_cast<float>(pdf / stretch) : 0.f;
}

}  // namespace pssmlt
