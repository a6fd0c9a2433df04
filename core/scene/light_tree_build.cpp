// How the hierarchy of lights is built: top down by halves, each split the cheapest of those
// between bins along the three axes; then several generations become one.
#include <algorithm>
#include <array>
#include <numeric>

#include "core/scene/light_tree.h"

namespace pssmlt {
namespace {

constexpr size_t bins = 12;
// Past this depth halves have equal numbers of lights, so that recursion ends.
constexpr int deepest_split = 24;

double as_angle(float cosine) {
  return std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0));
}

void add(LightBounds& to, const LightBounds& b) {
  to.cos_spread = to.normals.is_empty() ? b.cos_spread : std::min(to.cos_spread, b.cos_spread);
  to.box.add(b.box);
  to.normals.add(b.normals);
  to.two_sided |= b.two_sided;
  to.intensity += b.intensity;
}
LightBounds nothing() {
  LightBounds b;
  b.normals = DirectionCone::none();
  return b;
}

// Conty Estevez and Kulla 2018, section 4.1: the cosine-weighted measure of the directions in which
// normals in the cone shine [sr].
double orientation_measure(const LightBounds& b) {
  const double o = as_angle(b.normals.cosine);
  const double w = std::min(o + as_angle(b.cos_spread), std::numbers::pi);
  const double cone = 2.0 * std::numbers::pi * (1.0 - std::cos(o));
  return cone +
         0.5 * std::numbers::pi *
             (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
}

double squared_diagonal(const Bounds& box) {
  const dvec3 diagonal = dvec3(box.max) - dvec3(box.min);
  return glm::dot(diagonal, diagonal);
}

// The paper weighs by the area of the box; the guess of a node's irradiance sees a sphere around
// it, and lights in one plane or line have boxes without area.
double cost(const LightBounds& b) {
  if (b.normals.is_empty()) return 0.0;
  return static_cast<double>(b.intensity) * orientation_measure(b) * squared_diagonal(b.box);
}

}  // namespace

class LightTreeBuilder {
 public:
  LightTreeBuilder(const std::vector<LightBounds>& lights, LightTree& tree)
      : lights_(lights), tree_(tree), order_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    for (const LightBounds& b : lights) {
      centers_.push_back(0.5f * b.box.min + 0.5f * b.box.max);
      tree_.intensity_ += static_cast<double>(b.intensity);
    }
    tree_.lights_.resize(lights.size());
    nodes_.reserve(2 * lights.size() - 1);
    nodes_.emplace_back();
    build(0, 0, lights.size(), 0);
    tree_.fans_.emplace_back();
    gather(0, 0);
    tree_.fans_.shrink_to_fit();
  }

 private:
  struct Split {
    double cost = std::numeric_limits<double>::infinity();
    int axis = 0;
    size_t bin = 0;  // the last one of the first child
  };
  struct Node {
    LightBounds bounds;
    uint32_t first = 0;   // of two children; leaf: the light
    uint32_t lights = 0;  // in it
    bool leaf = false;
  };
  void build(uint32_t node, size_t begin, size_t end, int depth);
  // Makes a fan of a node's descendants, then of theirs.
  void gather(uint32_t node, uint32_t fan);
  std::vector<uint32_t> descendants(uint32_t node) const;
  void fill(LightTree::Half& half, uint32_t lane, const LightBounds& b) const;
  // Where the second child's lights begin; both have some.
  size_t divide(size_t begin, size_t end, int depth);
  Split best_split(const Bounds& centers, size_t begin, size_t end) const;
  void try_axis(const Bounds& centers, int axis, size_t begin, size_t end, Split& best) const;
  size_t bin_of(const Bounds& centers, int axis, uint32_t light) const {
    const float extent = centers.max[axis] - centers.min[axis];
    const float at = (centers_[light][axis] - centers.min[axis]) / extent;
    return std::min(static_cast<size_t>(at * static_cast<float>(bins)), bins - 1);
  }

  const std::vector<LightBounds>& lights_;
  LightTree& tree_;
  std::vector<uint32_t> order_;
  std::vector<vec3> centers_;
  std::vector<Node> nodes_;  // halves, the root first, siblings side by side
};

LightTree::LightTree(const std::vector<LightBounds>& lights) { LightTreeBuilder(lights, *this); }

void LightTreeBuilder::fill(LightTree::Half& half, uint32_t lane, const LightBounds& b) const {
  const vec3 center = 0.5f * b.box.min + 0.5f * b.box.max;
  for (int k = 0; k < 3; ++k) {
    half.center[static_cast<size_t>(k)][lane] = center[k];
    half.axis[static_cast<size_t>(k)][lane] = b.normals.axis[k];
  }
  half.radius2[lane] = static_cast<float>(0.25 * squared_diagonal(b.box));
  half.cos_cone[lane] = b.normals.cosine;
  half.sin_cone[lane] = safe_sqrt(1.f - sqr(b.normals.cosine));
  half.cos_spread[lane] = b.cos_spread;
  half.two_sided[lane] = b.two_sided ? 1.f : 0.f;
  // Relative: sums stay in range whatever the lights' unit.
  half.intensity[lane] = static_cast<float>(static_cast<double>(b.intensity) / tree_.intensity_);
}

void LightTreeBuilder::build(uint32_t node, size_t begin, size_t end, int depth) {
  LightBounds all = nothing();
  for (size_t i = begin; i < end; ++i) add(all, lights_[order_[i]]);
  nodes_[node].bounds = all;
  nodes_[node].lights = static_cast<uint32_t>(end - begin);
  nodes_[node].leaf = end - begin == 1;
  if (nodes_[node].leaf) {
    nodes_[node].first = order_[begin];
    return;
  }
  const size_t middle = divide(begin, end, depth);
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_[node].first = first;
  nodes_.resize(first + 2);
  build(first, begin, middle, depth + 1);
  build(first + 1, middle, end, depth + 1);
}

// What takes a node's place in a fan. The brightest are divided, since they are chosen most often;
// first those with more lights than a fan has room for.
std::vector<uint32_t> LightTreeBuilder::descendants(uint32_t node) const {
  std::vector<uint32_t> found = {node};
  const auto less_wanted = [&](uint32_t i, uint32_t k) {
    const Node &a = nodes_[i], &b = nodes_[k];
    if (a.leaf != b.leaf) return a.leaf;
    const bool large_a = a.lights > LightTree::width, large_b = b.lights > LightTree::width;
    return large_a != large_b ? large_b : a.bounds.intensity < b.bounds.intensity;
  };
  while (found.size() < LightTree::width) {
    const auto most = std::max_element(found.begin(), found.end(), less_wanted);
    if (nodes_[*most].leaf) break;
    *most = nodes_[*most].first;
    found.push_back(*most + 1);
  }
  return found;
}

void LightTreeBuilder::gather(uint32_t node, uint32_t fan) {
  const std::vector<uint32_t> nodes = descendants(node);
  const auto count = static_cast<uint32_t>(nodes.size());
  tree_.fans_[fan].count = count;
  for (uint32_t lane = 0; lane < count; ++lane) {
    const Node& n = nodes_[nodes[lane]];
    const uint32_t next = n.leaf ? n.first : static_cast<uint32_t>(tree_.fans_.size());
    if (!n.leaf) tree_.fans_.emplace_back().at = {fan, lane};
    fill(tree_.fans_[fan].half[lane / 4], lane % 4, n.bounds);
    tree_.fans_[fan].leaf[lane] = n.leaf;
    tree_.fans_[fan].next[lane] = next;
    if (n.leaf) tree_.lights_[n.first] = {fan, lane};
    if (!n.leaf) gather(nodes[lane], next);
  }
}

size_t LightTreeBuilder::divide(size_t begin, size_t end, int depth) {
  Bounds centers;
  for (size_t i = begin; i < end; ++i) centers.add(centers_[order_[i]]);
  const auto from = order_.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto to = order_.begin() + static_cast<std::ptrdiff_t>(end);
  if (depth < deepest_split) {
    const Split split = best_split(centers, begin, end);
    if (split.cost < std::numeric_limits<double>::infinity()) {
      const auto middle = std::partition(from, to, [&](uint32_t light) {
        return bin_of(centers, split.axis, light) <= split.bin;
      });
      return static_cast<size_t>(middle - order_.begin());
    }
  }
  const vec3 extent = centers.max - centers.min;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto middle = from + (to - from) / 2;
  std::nth_element(from, middle, to, [&](uint32_t a, uint32_t b) {
    return centers_[a][axis] != centers_[b][axis] ? centers_[a][axis] < centers_[b][axis] : a < b;
  });
  return static_cast<size_t>(middle - order_.begin());
}

LightTreeBuilder::Split LightTreeBuilder::best_split(const Bounds& centers, size_t begin,
                                                     size_t end) const {
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (centers.max[axis] > centers.min[axis]) try_axis(centers, axis, begin, end, best);
  }
  return best;
}

void LightTreeBuilder::try_axis(const Bounds& centers, int axis, size_t begin, size_t end,
                                Split& best) const {
  std::array<LightBounds, bins> content;
  content.fill(nothing());
  for (size_t i = begin; i < end; ++i) {
    add(content[bin_of(centers, axis, order_[i])], lights_[order_[i]]);
  }
  std::array<double, bins> below{};  // cost of the bins up to here
  LightBounds sum = nothing();
  for (size_t i = 0; i + 1 < bins; ++i) {
    add(sum, content[i]);
    below[i] = cost(sum);
  }
  sum = nothing();
  for (size_t i = bins - 1; i > 0; --i) {
    add(sum, content[i]);
    const double total = below[i - 1] + cost(sum);
    if (total < best.cost) best = {total, axis, i - 1};
  }
}

}  // namespace pssmlt
