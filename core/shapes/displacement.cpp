#include "core/shapes/displacement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>

namespace pssmlt {
namespace {

constexpr size_t most_triangles = size_t{1} << 26;

template <typename V>
void append_middle(std::vector<V>& values, uint32_t a, uint32_t b) {
  if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
}

template <typename V>
void unshare(std::vector<V>& values, const std::vector<glm::uvec3>& triangles) {
  if (values.empty()) return;
  std::vector<V> own;
  for (const glm::uvec3& t : triangles)
    for (int k = 0; k < 3; ++k) own.push_back(values[t[k]]);
  values = std::move(own);
}

// Texture coordinates as meshes without any are given: the same in every triangle.
void give_coordinates(MeshData& data) {
  TriangleMesh& m = data.mesh;
  unshare(m.positions, m.triangles);
  unshare(m.normals, m.triangles);
  unshare(m.second_uvs, m.triangles);
  unshare(m.colors, m.triangles);
  unshare(m.opacities, m.triangles);
  unshare(data.tangents, m.triangles);
  for (uint32_t i = 0; i < m.triangles.size(); ++i) {
    m.triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
    for (const vec2& uv : {vec2(0.f), vec2(1.f, 0.f), vec2(1.f)}) m.uvs.push_back(uv);
  }
}

// Vertices that are one: a number for each, the same for those with equal keys.
using Key = std::array<uint32_t, 6>;
struct KeyHash {
  size_t operator()(const Key& key) const {
    uint64_t h = 0x9e3779b97f4a7c15ull;
    for (const uint32_t k : key) {
      h = (h ^ k) * 0xff51afd7ed558ccdull;
      h ^= h >> 32;
    }
    return static_cast<size_t>(h);
  }
};
// Adding 0 makes one zero of both.
uint32_t bits(float x) { return std::bit_cast<uint32_t>(x + 0.f); }

// By position, and by normal unless `normals` is empty.
std::vector<uint32_t> groups(const std::vector<vec3>& positions, const std::vector<vec3>& normals) {
  std::unordered_map<Key, uint32_t, KeyHash> known;
  std::vector<uint32_t> group(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    const vec3 &p = positions[i], n = normals.empty() ? vec3(0.f) : normals[i];
    const Key key{bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y), bits(n.z)};
    group[i] = known.try_emplace(key, static_cast<uint32_t>(known.size())).first->second;
  }
  return group;
}

// Means of the triangles' normals over each group, weighted by area; unit, or zero.
std::vector<vec3> mean_normals(const TriangleMesh& m, const std::vector<uint32_t>& group) {
  std::vector<dvec3> sums(group.size(), dvec3(0.0));
  for (const glm::uvec3& t : m.triangles) {
    const dvec3 p0(m.positions[t.x]), p1(m.positions[t.y]), p2(m.positions[t.z]);
    const dvec3 n = glm::cross(p1 - p0, p2 - p0);
    for (int k = 0; k < 3; ++k) sums[group[t[k]]] += n;
  }
  std::vector<vec3> normals(group.size());
  for (size_t i = 0; i < group.size(); ++i) {
    const double length = glm::length(sums[group[i]]);
    normals[i] = length > 0.0 ? vec3(sums[group[i]] / length) : vec3(0.f);
  }
  return normals;
}

class Refinement {
 public:
  Refinement(MeshData& data, const Transform& to_render, float longest)
      : data_(data), mesh_(data.mesh), to_render_(to_render), longest_(longest) {}

  // Halves all edges that are too long, once. False if there are none.
  bool step() {
    middles_.clear();
    std::vector<glm::uvec3> out;
    out.reserve(mesh_.triangles.size());
    for (const glm::uvec3& t : mesh_.triangles) split(t, out);
    mesh_.triangles = std::move(out);
    return !middles_.empty();
  }

 private:
  static constexpr uint32_t none = ~0u;

  // The vertex in the middle of an edge that is too long.
  uint32_t middle(uint32_t a, uint32_t b) {
    const dvec3 edge = dvec3(mesh_.positions[b]) - dvec3(mesh_.positions[a]);
    if (!(glm::length(to_render_.vector(edge)) > static_cast<double>(longest_))) return none;
    const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [found, is_new] =
        middles_.try_emplace(key, static_cast<uint32_t>(mesh_.positions.size()));
    if (is_new) {
      append_middle(mesh_.positions, a, b);
      append_middle(mesh_.normals, a, b);
      append_middle(mesh_.uvs, a, b);
      append_middle(mesh_.second_uvs, a, b);
      append_middle(mesh_.colors, a, b);
      append_middle(mesh_.opacities, a, b);
      append_middle(data_.tangents, a, b);
    }
    return found->second;
  }

  void split(glm::uvec3 t, std::vector<glm::uvec3>& out) {
    glm::uvec3 m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
    const int halved = (m.x != none) + (m.y != none) + (m.z != none);
    if (halved == 0) return out.push_back(t);
    if (halved == 3) {
      for (const glm::uvec3& s :
           {glm::uvec3(t.x, m.x, m.z), glm::uvec3(m.x, t.y, m.y), glm::uvec3(m.z, m.y, t.z), m})
        out.push_back(s);
      return;
    }
    // Turned so that of one halved edge it is the first, of two the first two.
    while (m.x == none || (halved == 2 && m.y == none)) {
      t = {t.y, t.z, t.x};
      m = {m.y, m.z, m.x};
    }
    if (halved == 1) {
      out.emplace_back(t.x, m.x, t.z);
      out.emplace_back(m.x, t.y, t.z);
      return;
    }
    out.emplace_back(m.x, t.y, m.y);
    out.emplace_back(t.x, m.x, m.y);
    out.emplace_back(t.x, m.y, t.z);
  }

  MeshData& data_;
  TriangleMesh& mesh_;
  const Transform& to_render_;
  float longest_;
  std::unordered_map<uint64_t, uint32_t> middles_;
};

// How far each vertex moves; all that lie at one place by the mean of what is asked of them.
std::vector<vec3> offsets(const TriangleMesh& m, const std::vector<uint32_t>& place,
                          const Texture<float>& height, const Parameters& p) {
  std::vector<dvec3> sums(place.size(), dvec3(0.0));
  std::vector<uint32_t> counts(place.size(), 0);
  for (size_t i = 0; i < place.size(); ++i) {
    Hit hit;
    hit.position = p.transform().point(m.positions[i]);
    hit.ng = hit.ns = glm::normalize(p.transform().normal(m.normals[i]));
    hit.uv = m.uvs[i];
    const float h = height.evaluate(hit);
    if (!std::isfinite(h)) p.fail("displacement", "the displacement is not finite everywhere");
    sums[place[i]] += dvec3(h * m.normals[i]);
    ++counts[place[i]];
  }
  std::vector<vec3> moves(place.size());
  for (size_t i = 0; i < place.size(); ++i)
    moves[i] = vec3(sums[place[i]] / static_cast<double>(counts[place[i]]));
  return moves;
}

}  // namespace

// Triangles of the given edges that cover the mesh's area, at least.
static double fewest_triangles(const TriangleMesh& m, const Transform& to_render, float edge) {
  double area = 0.0;
  for (const glm::uvec3& t : m.triangles) {
    const dvec3 p(m.positions[t.x]);
    area += 0.5 * glm::length(glm::cross(to_render.vector(dvec3(m.positions[t.y]) - p),
                                         to_render.vector(dvec3(m.positions[t.z]) - p)));
  }
  return area / (0.25 * std::sqrt(3.0) * sqr(static_cast<double>(edge)));
}

MeshData displace(MeshData data, const Displacement& displacement, const Parameters& p) {
  TriangleMesh& m = data.mesh;
  if (m.uvs.empty()) give_coordinates(data);
  const bool has_normals = !m.normals.empty();
  const std::vector<vec3> means = mean_normals(m, groups(m.positions, {}));
  if (!has_normals) m.normals = means;
  for (size_t i = 0; i < means.size(); ++i) {
    const float length = glm::length(m.normals[i]);
    m.normals[i] = length > 0.f ? m.normals[i] / length : means[i];
  }
  Refinement refinement(data, p.transform(), displacement.edge_length);
  const double fewest = fewest_triangles(m, p.transform(), displacement.edge_length);
  bool fits = fewest <= static_cast<double>(most_triangles);
  while (fits && refinement.step()) fits = m.triangles.size() <= most_triangles;
  if (!fits) p.fail("displacement.edgelength", "edges this short take more than 2^26 triangles");
  for (vec3& n : m.normals) {
    const float length = glm::length(n);
    n = length > 0.f ? n / length : vec3(0.f);
  }
  const std::vector<uint32_t> place = groups(m.positions, {});
  // Where normals were given, different ones at a place are an edge that stays sharp.
  const std::vector<uint32_t> smooth = has_normals ? groups(m.positions, m.normals) : place;
  const std::vector<vec3> moves = offsets(m, place, *displacement.height, p);
  for (size_t i = 0; i < moves.size(); ++i) m.positions[i] += moves[i];
  std::vector<vec3> moved = mean_normals(m, smooth);
  for (size_t i = 0; i < moved.size(); ++i)
    if (glm::dot(moved[i], m.normals[i]) < 0.f) moved[i] = -moved[i];
  m.normals = std::move(moved);
  return data;
}

}  // namespace pssmlt
