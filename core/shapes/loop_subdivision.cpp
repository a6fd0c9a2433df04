#include "core/shapes/loop_subdivision.h"

#include <algorithm>
#include <array>
#include <span>

namespace pssmlt {
namespace {

constexpr uint32_t none = 0xFFFFFFFFu;

// For every vertex, the sides (a, b) of its triangles that lie opposite to it, in index order.
class Rings {
 public:
  struct Side {
    uint32_t a, b;
  };
  explicit Rings(const SubdivisionMesh& mesh) : start_(mesh.positions.size() + 1) {
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) ++start_[t[i] + 1];
    for (size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
    sides_.resize(3 * mesh.triangles.size());
    std::vector<uint32_t> fill(start_.begin(), start_.end() - 1);
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) sides_[fill[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
  }
  std::span<const Side> of(uint32_t vertex) const {
    return {sides_.data() + start_[vertex], sides_.data() + start_[vertex + 1]};
  }
  // Neighbours in order around the vertex, from one end of the boundary to the other if it is on it
  // (`closed` false). False if they form no single fan.
  bool ordered(uint32_t vertex, std::vector<uint32_t>& ring, bool& closed) const {
    const auto sides = of(vertex);
    ring.clear();
    closed = true;
    if (sides.empty()) return true;
    uint32_t at = sides[0].a;
    for (const Side& s : sides)
      if (!starts_at(sides, s.a)) {
        at = s.a;
        closed = false;
      }
    const uint32_t first = at;
    for (size_t i = 0; i < sides.size(); ++i) {
      ring.push_back(at);
      const auto next = std::ranges::find(sides, at, &Side::a);
      if (next == sides.end()) return false;
      at = next->b;
      if (at == first) return closed && i + 1 == sides.size();
    }
    ring.push_back(at);
    return !closed && std::ranges::find(sides, at, &Side::a) == sides.end();
  }

 private:
  // True if some side ends where one starts at `a`.
  static bool starts_at(std::span<const Side> sides, uint32_t a) {
    return std::ranges::find(sides, a, &Side::b) != sides.end();
  }
  std::vector<uint32_t> start_;
  std::vector<Side> sides_;
};

// The weight of each neighbour of an inner vertex.
double beta(size_t valence) {
  return valence == 3 ? 3.0 / 16.0 : 3.0 / (8.0 * static_cast<double>(valence));
}

// A vertex moved by its ring: `inner` for each neighbour of an inner vertex, `edge` for the two
// boundary neighbours of a boundary vertex.
dvec3 weighted(const std::vector<dvec3>& p, uint32_t vertex, const std::vector<uint32_t>& ring,
               bool closed, double inner, double edge) {
  if (ring.empty()) return p[vertex];
  if (!closed) return (1.0 - 2.0 * edge) * p[vertex] + edge * (p[ring.front()] + p[ring.back()]);
  dvec3 sum(0.0);
  for (const uint32_t r : ring) sum += p[r];
  return (1.0 - inner * static_cast<double>(ring.size())) * p[vertex] + inner * sum;
}

// Tangents of the surface around a vertex.
std::array<dvec3, 2> tangents(const std::vector<dvec3>& p, uint32_t vertex,
                              const std::vector<uint32_t>& ring, bool closed) {
  const size_t n = ring.size();
  dvec3 s(0.0), t(0.0);
  if (closed) {
    for (size_t j = 0; j < n; ++j) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(n);
      s += std::cos(angle) * p[ring[j]];
      t += std::sin(angle) * p[ring[j]];
    }
    return {s, t};
  }
  const dvec3 &v = p[vertex], &first = p[ring.front()], &last = p[ring.back()];
  s = last - first;
  if (n == 2) {
    t = first + last - 2.0 * v;
  } else if (n == 3) {
    t = p[ring[1]] - v;
  } else if (n == 4) {  // regular
    t = -first + 2.0 * p[ring[1]] + 2.0 * p[ring[2]] - last - 2.0 * v;
  } else {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    t = -std::sin(theta) * (first + last);
    for (size_t k = 1; k + 1 < n; ++k)
      t -= (2.0 * std::cos(theta) - 2.0) * std::sin(static_cast<double>(k) * theta) * p[ring[k]];
  }
  return {s, t};
}

// New vertices on the edges, numbered from `first`: the number of each edge by its triangles.
class EdgeVertices {
 public:
  EdgeVertices(const SubdivisionMesh& mesh, const Rings& rings)
      : first_(static_cast<uint32_t>(mesh.positions.size())), of_(mesh.triangles.size()) {
    // Edges are found in the bucket of their lower vertex, which is short.
    std::vector<std::vector<Edge>> buckets(mesh.positions.size());
    for (uint32_t v = 0; v < buckets.size(); ++v) buckets[v].reserve(rings.of(v).size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
        auto& bucket = buckets[std::min(a, b)];
        const uint32_t high = std::max(a, b), opposite = mesh.triangles[t][(i + 2) % 3];
        const auto known = std::ranges::find(bucket, high, &Edge::high);
        if (known != bucket.end()) {
          known->right = opposite;
          of_[t][i] = known->vertex;
          continue;
        }
        of_[t][i] = first_ + count_++;
        bucket.push_back({high, of_[t][i], opposite, none});
      }
    place(mesh, buckets);
  }
  const std::vector<dvec3>& positions() const { return positions_; }
  const glm::uvec3& of(size_t triangle) const { return of_[triangle]; }

 private:
  struct Edge {
    uint32_t high, vertex, left, right;
  };
  void place(const SubdivisionMesh& mesh, const std::vector<std::vector<Edge>>& buckets) {
    const auto& p = mesh.positions;
    positions_.resize(count_);
    for (size_t low = 0; low < buckets.size(); ++low)
      for (const Edge& e : buckets[low])
        positions_[e.vertex - first_] =
            e.right == none ? 0.5 * (p[low] + p[e.high])
                            : 0.375 * (p[low] + p[e.high]) + 0.125 * (p[e.left] + p[e.right]);
  }
  uint32_t first_, count_ = 0;
  std::vector<glm::uvec3> of_;
  std::vector<dvec3> positions_;
};

}  // namespace

std::string check_for_subdivision(const SubdivisionMesh& mesh) {
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i)
      if (t[i] >= mesh.positions.size())
        return "index " + std::to_string(t[i]) + " is out of range";
    if (t.x == t.y || t.y == t.z || t.z == t.x)
      return "a triangle uses vertex " + std::to_string(t.x == t.y ? t.x : t.z) + " twice";
  }
  const Rings rings(mesh);
  std::vector<uint32_t> ring;
  bool closed = false;
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const auto sides = rings.of(v);
    for (size_t i = 0; i < sides.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (sides[i].a == sides[j].a || sides[i].b == sides[j].b)
          return "triangles at vertex " + std::to_string(v) +
                 " overlap or differ in orientation: the mesh is not a surface";
    if (!rings.ordered(v, ring, closed))
      return "the triangles at vertex " + std::to_string(v) +
             " form no single fan: the mesh is not a surface";
  }
  return "";
}

SubdivisionMesh subdivide(const SubdivisionMesh& mesh) {
  const Rings rings(mesh);
  SubdivisionMesh result;
  std::vector<uint32_t> ring;
  bool closed = false;
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    rings.ordered(v, ring, closed);
    result.positions.push_back(
        weighted(mesh.positions, v, ring, closed, closed ? beta(ring.size()) : 0.0, 0.125));
  }
  const EdgeVertices edges(mesh, rings);
  result.positions.insert(result.positions.end(), edges.positions().begin(),
                          edges.positions().end());
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 &t = mesh.triangles[i], &e = edges.of(i);
    result.triangles.emplace_back(t.x, e.x, e.z);
    result.triangles.emplace_back(e.x, t.y, e.y);
    result.triangles.emplace_back(e.z, e.y, t.z);
    result.triangles.push_back(e);
  }
  return result;
}

LimitSurface limit_surface(const SubdivisionMesh& mesh) {
  const Rings rings(mesh);
  LimitSurface limit;
  std::vector<uint32_t> ring;
  bool closed = false;
  const auto count = static_cast<uint32_t>(mesh.positions.size());
  for (uint32_t v = 0; v < count; ++v) {
    rings.ordered(v, ring, closed);
    const double n = static_cast<double>(ring.size());
    const double gamma = ring.empty() ? 0.0 : 1.0 / (n + 3.0 / (8.0 * beta(ring.size())));
    limit.positions.push_back(weighted(mesh.positions, v, ring, closed, gamma, 0.2));
  }
  for (uint32_t v = 0; v < count; ++v) {
    rings.ordered(v, ring, closed);
    dvec3 normal(0.0);
    if (!ring.empty()) {
      // The tangents' masks see the limit positions, as the format's own renderer has it.
      const auto [s, t] = tangents(limit.positions, v, ring, closed);
      normal = glm::cross(s, t);
      dvec3 side(0.0);  // sum of the normals of the triangles around
      for (const auto& edge : rings.of(v))
        side += glm::cross(limit.positions[edge.a] - limit.positions[v],
                           limit.positions[edge.b] - limit.positions[v]);
      if (glm::dot(normal, side) < 0.0) normal = -normal;
    }
    const double length = glm::length(normal);
    limit.normals.push_back(length > 0.0 ? vec3(normal / length) : vec3(0.f));
  }
  return limit;
}

}  // namespace pssmlt
