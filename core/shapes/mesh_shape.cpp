#include "core/shapes/mesh_shape.h"

#include <glm/matrix.hpp>

#include "core/base/frame.h"
#include "core/base/log.h"

namespace pssmlt {
namespace {

// gamma(7) of Higham's error analysis: three products and sums, with a margin (Pharr, Jakob,
// Humphreys 2023, section 6.8.5).
constexpr float interpolation_error = 7.f * 0x1p-24f / (1.f - 7.f * 0x1p-24f);

float longest_edge(const vec3& p0, const vec3& p1, const vec3& p2) {
  return std::sqrt(
      std::max({length_squared(p1 - p0), length_squared(p2 - p1), length_squared(p0 - p2)}));
}

// How far off Embree may see the plane of a sliver [m]: it takes the normal from edges that start
// at the ray, with 4 roundings of the longest edge L, which the height w over that edge divides (4
// u L^2 / w, docs/numerics.md). No further than w, lest rays start behind what is near; 0 for other
// shapes.
float sliver_error(float longest, double area) {
  const float width = 2.f * static_cast<float>(area) / longest;
  if (!(width < 0.1f * longest)) return 0.f;
  return std::min(0x1p-22f * longest * (longest / width), width);
}

dvec3 area_vector(const vec3& p0, const vec3& p1, const vec3& p2) {
  return 0.5 * glm::cross(dvec3(p1) - dvec3(p0), dvec3(p2) - dvec3(p0));
}

vec3 barycentric(const vec2& where) { return {1.f - where.x - where.y, where.x, where.y}; }

template <typename V>
V mix(const std::vector<V>& values, const glm::uvec3& t, const vec3& b) {
  return b.x * values[t.x] + b.y * values[t.y] + b.z * values[t.z];
}

template <typename V>
bool all_finite(const std::vector<V>& values) {
  for (const V& v : values)
    for (int i = 0; i < V::length(); ++i)
      if (!std::isfinite(v[i])) return false;
  return true;
}

// Replaces what cannot be normalised by zero: "no normal here".
vec3 unit_or_zero(const dvec3& n) {
  const double length = glm::length(n);
  return length > 0.0 && std::isfinite(length) ? vec3(n / length) : vec3(0.f);
}

}  // namespace

std::vector<glm::uvec3> triangles_of(const std::vector<int>& indices, const Parameters& p) {
  if (indices.size() % 3 != 0)
    p.fail("indices", "the number of indices, " + std::to_string(indices.size()) +
                          ", is not a multiple of three");
  std::vector<glm::uvec3> triangles(indices.size() / 3);
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0) p.fail("indices", "index " + std::to_string(indices[i]) + " is negative");
    triangles[i / 3][static_cast<int>(i % 3)] = static_cast<uint32_t>(indices[i]);
  }
  return triangles;
}

MeshShape::MeshShape(MeshData data, const Parameters& p) {
  if (p.describing()) return;
  check(data, p);
  mesh_ = std::move(data.mesh);
  tangents_ = std::move(data.tangents);
  flip_ = p.reverse_orientation() != p.transform().swaps_handedness();
  transform(p);
  const size_t dropped = measure();
  find_plane();
  if (dropped != 0)
    log_debug(to_string(p.where()) + ": " + p.owner() + ": " + std::to_string(dropped) +
              " triangles without area left out");
  if (mesh_.triangles.empty())
    log_warning(to_string(p.where()) + ": " + p.owner() + ": no triangle has an area");
}

void MeshShape::check(const MeshData& data, const Parameters& p) const {
  const TriangleMesh& m = data.mesh;
  const size_t count = m.positions.size();
  const auto check_size = [&](size_t size, const char* parameter, const char* what) {
    if (size != 0 && size != count)
      p.fail(parameter, std::string("the mesh has ") + std::to_string(size) + " " + what + " for " +
                            std::to_string(count) + " vertices");
  };
  check_size(m.normals.size(), "N", "normals");
  check_size(m.uvs.size(), "uv", "texture coordinates");
  check_size(data.tangents.size(), "S", "tangents");
  check_size(m.second_uvs.size(), "uv1", "second texture coordinates");
  check_size(m.colors.size(), "color", "colours");
  check_size(m.opacities.size(), "coloralpha", "opacities");
  if (!all_finite(m.positions)) p.fail("P", "a vertex has a coordinate that is not finite");
  if (!all_finite(m.normals)) p.fail("N", "a normal has a component that is not finite");
  if (!all_finite(m.uvs)) p.fail("uv", "a texture coordinate is not finite");
  if (!all_finite(m.second_uvs)) p.fail("uv1", "a texture coordinate is not finite");
  if (!all_finite(data.tangents)) p.fail("S", "a tangent has a component that is not finite");
  for (const glm::uvec3& t : m.triangles)
    for (int i = 0; i < 3; ++i)
      if (t[i] >= count)
        p.fail("indices", "index " + std::to_string(t[i]) + " is out of range: there are " +
                              std::to_string(count) + " vertices");
}

void MeshShape::transform(const Parameters& p) {
  const Transform& to_render = p.transform();
  for (vec3& v : mesh_.positions) {
    v = to_render.point(v);
    if (!is_finite(v)) p.fail("P", "a vertex is beyond the range of single precision");
  }
  const double side = p.reverse_orientation() ? -1.0 : 1.0;
  for (vec3& n : mesh_.normals) n = unit_or_zero(side * to_render.normal(dvec3(n)));
  for (vec3& s : tangents_) s = to_render.vector(s);
}

size_t MeshShape::measure() {
  std::vector<glm::uvec3>& triangles = mesh_.triangles;
  face_normals_.reserve(triangles.size());
  double sum = 0.0;
  size_t kept = 0;
  for (const glm::uvec3& t : triangles) {
    const dvec3 a = area_vector(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
    const double length = glm::length(a);
    if (!(static_cast<float>(length) > 0.f)) continue;
    face_normals_.emplace_back((flip_ ? -a : a) / length);
    const float longest =
        longest_edge(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
    // Embree's coordinates come from some four roundings.
    grain_ = std::max(grain_, 0x1p-22f * longest);
    const float sliver = sliver_error(longest, length);
    if (sliver > 0.f) sliver_errors_.resize(triangles.size());
    if (sliver > 0.f) sliver_errors_[kept] = sliver;
    sum += length;
    triangles[kept++] = t;
  }
  const size_t dropped = triangles.size() - kept;
  triangles.resize(kept);
  area_ = static_cast<float>(sum);
  inverse_area_ = area_ > 0.f ? 1.f / area_ : 0.f;
  return dropped;
}

void MeshShape::find_plane() {
  if (mesh_.triangles.empty()) return;
  const auto normal_at = [this](uint32_t triangle, int corner) {
    return outside(triangle, mesh_.normals.empty()
                                 ? vec3(0.f)
                                 : mesh_.normals[mesh_.triangles[triangle][corner]]);
  };
  FacingPlane plane{mesh_.positions[mesh_.triangles[0].x], normal_at(0, 0)};
  for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (glm::distance(normal_at(i, k), plane.normal) > FacingPlane::angle) return;
      const float slack = plane.slack_of(mesh_.positions[mesh_.triangles[i][k]]);
      plane.slack = std::max(plane.slack, slack);
    }
  }
  plane_ = plane;
}

DirectionCone MeshShape::normals() const {
  DirectionCone cone = DirectionCone::none();
  for (uint32_t i = 0; i < mesh_.triangles.size() && !cone.is_all(); ++i) {
    // Where shading normals disagree about the side, both sides are outside.
    for (int k = 0; k < (mesh_.normals.empty() ? 1 : 3); ++k) {
      const vec3 ns = mesh_.normals.empty() ? vec3(0.f) : mesh_.normals[mesh_.triangles[i][k]];
      cone.add({outside(i, ns), 1.f});
    }
  }
  return cone;
}

const Distribution1D& MeshShape::areas() const {
  // The flag spares every sample the call into the threads' library.
  if (!areas_made_.load(std::memory_order_acquire)) {
    std::call_once(areas_once_, [this] { make_areas(); });
  }
  return areas_;
}

void MeshShape::make_areas() const {
  std::vector<double> a;
  a.reserve(mesh_.triangles.size());
  for (const glm::uvec3& t : mesh_.triangles) {
    a.push_back(
        glm::length(area_vector(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z])));
  }
  areas_ = Distribution1D(std::span<const double>(a));
  areas_made_.store(true, std::memory_order_release);
}

Bounds MeshShape::bounds() const {
  Bounds b;
  for (const vec3& p : mesh_.positions) b.add(p);
  return b;
}

MeshShape::Corners MeshShape::corners(uint32_t triangle) const {
  const glm::uvec3& t = mesh_.triangles[triangle];
  return {mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]};
}

vec3 MeshShape::outside(uint32_t triangle, const vec3& ns) const {
  const vec3& n = face_normals_[triangle];
  return glm::dot(n, ns) < 0.f ? -n : n;
}

vec3 MeshShape::shading_normal(uint32_t triangle, const vec3& b) const {
  return mesh_.normals.empty() ? vec3(0.f) : mix(mesh_.normals, mesh_.triangles[triangle], b);
}

vec2 MeshShape::interpolated_uv(uint32_t triangle, const vec3& b) const {
  // Without coordinates the corners are (0,0), (1,0), (1,1).
  if (mesh_.uvs.empty()) return {b.y + b.z, b.z};
  return mix(mesh_.uvs, mesh_.triangles[triangle], b);
}

void MeshShape::fill(const vec2& where, Hit& hit) const {
  const Corners c = corners(hit.element);
  const vec3 b = barycentric(where);
  hit.where = where;
  hit.position = b.x * c.p0 + b.y * c.p1 + b.z * c.p2;
  hit.error =
      interpolation_error * (glm::abs(b.x * c.p0) + glm::abs(b.y * c.p1) + glm::abs(b.z * c.p2));
  if (!sliver_errors_.empty()) hit.error += sliver_errors_[hit.element];
  const vec3 ns = shading_normal(hit.element, b);
  hit.ng = outside(hit.element, ns);
  const float l2 = length_squared(ns);
  hit.ns = l2 > 0.f && std::isfinite(l2) ? ns / std::sqrt(l2) : hit.ng;
  hit.uv = interpolated_uv(hit.element, b);
  if (!hit.with_derivatives) {
    hit.dpdu = hit.dpdv = hit.dndu = hit.dndv = vec3(0.f);
    return;
  }
  set_derivatives(hit.element, c, hit);
  if (!tangents_.empty()) set_tangent(hit.element, b, hit);
}

// Barycentric coordinates of triangles much larger than what is seen of them are too coarse for a
// position in single precision, and so is the ray tracer's distance.
void MeshShape::refine(const dvec3& origin, const dvec3& direction, Hit& hit) const {
  const Corners c = corners(hit.element);
  const dvec3 p0(c.p0), e1 = dvec3(c.p1) - p0, e2 = dvec3(c.p2) - p0;
  const dvec3 n = glm::cross(e1, e2);
  const double t = glm::dot(p0 - origin, n) / glm::dot(direction, n);
  if (!(t > 0.0) || !std::isfinite(t)) return;  // in its plane: nothing better is known
  const dvec3 from = origin + t * direction - p0;
  const double inverse = 1.0 / glm::dot(n, n), b1 = glm::dot(glm::cross(from, e2), n) * inverse,
               b2 = glm::dot(glm::cross(e1, from), n) * inverse;
  // From the corners, not from the ray: a plane through the origin has no error for rays to start
  // beyond, so that its points must lie in it.
  hit.position = vec3(p0 + b1 * e1 + b2 * e2);
  hit.distance = static_cast<float>(t);
  hit.where = vec2(b1, b2);
  const glm::uvec3& i = mesh_.triangles[hit.element];
  hit.uv = mesh_.uvs.empty() ? vec2(b1 + b2, b2)
                             : vec2((1.0 - b1 - b2) * dvec2(mesh_.uvs[i.x]) +
                                    b1 * dvec2(mesh_.uvs[i.y]) + b2 * dvec2(mesh_.uvs[i.z]));
}

// Solves edges = (du dv) derivatives for position and normal (Pharr, Jakob, Humphreys 2023, section
// 6.5.2).
void MeshShape::set_derivatives(uint32_t triangle, const Corners& c, Hit& hit) const {
  const glm::uvec3& t = mesh_.triangles[triangle];
  vec2 uv0(0.f), uv1(1.f, 0.f), uv2(1.f, 1.f);
  if (!mesh_.uvs.empty()) uv0 = mesh_.uvs[t.x], uv1 = mesh_.uvs[t.y], uv2 = mesh_.uvs[t.z];
  const vec2 d02 = uv0 - uv2, d12 = uv1 - uv2;
  const float determinant = d02.x * d12.y - d02.y * d12.x;
  const float inverse = 1.f / determinant;
  const auto solve = [&](const vec3& a02, const vec3& a12, vec3& du, vec3& dv) {
    du = (d12.y * a02 - d02.y * a12) * inverse;
    dv = (d02.x * a12 - d12.x * a02) * inverse;
  };
  solve(c.p0 - c.p2, c.p1 - c.p2, hit.dpdu, hit.dpdv);
  const float spread = length_squared(glm::cross(hit.dpdu, hit.dpdv));
  const bool degenerate =
      !(std::abs(determinant) >= 1e-9f) || !(spread > 0.f) || !std::isfinite(spread);
  if (degenerate) {
    const Frame frame(hit.ng);
    hit.dpdu = frame.s;
    hit.dpdv = frame.t;
  }
  hit.dndu = hit.dndv = vec3(0.f);
  if (mesh_.normals.empty() || degenerate) return;
  const vec3 &n0 = mesh_.normals[t.x], &n1 = mesh_.normals[t.y], &n2 = mesh_.normals[t.z];
  solve(n0 - n2, n1 - n2, hit.dndu, hit.dndv);
}

// The given tangent, perpendicular to the shading normal, replaces the direction of dpdu; dpdv
// keeps its side, which mirrored texture coordinates turn.
void MeshShape::set_tangent(uint32_t triangle, const vec3& b, Hit& hit) const {
  const vec3 s = mix(tangents_, mesh_.triangles[triangle], b);
  const vec3 along = s - hit.ns * glm::dot(s, hit.ns);
  const float l2 = length_squared(along);
  if (!(l2 > 0.f)) return;
  const vec3 unit = along / std::sqrt(l2);
  const float side = glm::dot(glm::cross(hit.ns, hit.dpdu), hit.dpdv) < 0.f ? -1.f : 1.f;
  hit.dpdu = glm::length(hit.dpdu) * unit;
  hit.dpdv = side * glm::length(hit.dpdv) * glm::cross(hit.ns, unit);
}

SurfaceSample MeshShape::sample_area(const vec2& u) const {
  SurfaceSample s;
  if (!(area_ > 0.f)) return s;
  const auto cell = areas().sample(static_cast<double>(u.x));
  const float x = static_cast<float>(cell.offset);
  // Heitz 2019, A Low-Distortion Map Between Triangle and Square.
  vec3 b;
  if (x < u.y) {
    b.x = 0.5f * x;
    b.y = u.y - b.x;
  } else {
    b.y = 0.5f * u.y;
    b.x = x - b.y;
  }
  b.z = 1.f - b.x - b.y;
  const Corners c = corners(cell.index);
  s.position = b.x * c.p0 + b.y * c.p1 + b.z * c.p2;
  s.error =
      interpolation_error * (glm::abs(b.x * c.p0) + glm::abs(b.y * c.p1) + glm::abs(b.z * c.p2));
  if (!sliver_errors_.empty()) s.error += sliver_errors_[cell.index];
  s.normal = outside(cell.index, shading_normal(cell.index, b));
  s.uv = interpolated_uv(cell.index, b);
  s.element = cell.index;
  s.pdf = inverse_area_;
  return s;
}

}  // namespace pssmlt
