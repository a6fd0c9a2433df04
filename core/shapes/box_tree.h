// A small hierarchy of boxes for shapes of many parts that the ray tracer sees as one geometry.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/shape.h"

namespace pssmlt {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Bounds> boxes) {
    for (uint32_t i = 0; i < boxes.size(); ++i) parts_.push_back(i);
    if (!boxes.empty()) build(boxes, 0, static_cast<uint32_t>(boxes.size()));
  }
  Bounds bounds() const { return nodes_.empty() ? Bounds{vec3(0.f), vec3(0.f)} : nodes_[0].box; }

  // Calls visit(part, t_max) for parts whose boxes the ray meets before t_max; visit may lower
  // t_max.
  template <typename Visit>
  void walk(const dvec3& origin, const dvec3& direction, double t_min, double t_max,
            const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<uint32_t, 64> stack;  // the median split halves: depth <= 32
    size_t size = 0;
    stack[size++] = 0;
    const dvec3 inverse = 1.0 / direction;
    while (size != 0) {
      const Node& node = nodes_[stack[--size]];
      if (!meets(node.box, origin, inverse, t_min, t_max)) continue;
      if (node.second == 0) {
        for (uint32_t i = node.begin; i != node.end; ++i) visit(parts_[i], t_max);
      } else {
        stack[size++] = node.second;
        stack[size++] = static_cast<uint32_t>(&node - nodes_.data()) + 1;
      }
    }
  }

 private:
  struct Node {
    Bounds box;
    uint32_t begin = 0, end = 0;  // leaf: into parts_
    uint32_t second = 0;          // the second child; the first one follows. 0: leaf
  };

  static bool meets(const Bounds& b, const dvec3& o, const dvec3& inverse, double t0, double t1) {
    for (int i = 0; i < 3; ++i) {
      const double a = (static_cast<double>(b.min[i]) - o[i]) * inverse[i];
      const double c = (static_cast<double>(b.max[i]) - o[i]) * inverse[i];
      // fmin and fmax ignore the NaN of 0 * infinity: a ray in a box's side counts as inside.
      t0 = std::fmax(t0, std::fmin(a, c));
      t1 = std::fmin(t1, std::fmax(a, c));
    }
    return t0 <= t1;
  }

  void build(std::span<const Bounds> boxes, uint32_t begin, uint32_t end) {
    const size_t at = nodes_.size();
    nodes_.emplace_back();
    Bounds box, centers;
    for (uint32_t i = begin; i != end; ++i) {
      const Bounds& b = boxes[parts_[i]];
      box.add(b.min);
      box.add(b.max);
      centers.add(0.5f * b.min + 0.5f * b.max);
    }
    nodes_[at] = {box, begin, end, 0};
    constexpr uint32_t leaf_size = 2;
    if (end - begin <= leaf_size) return;
    const vec3 extent = centers.max - centers.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(parts_.begin() + begin, parts_.begin() + middle, parts_.begin() + end,
                     [&](uint32_t a, uint32_t b) {
                       const float ca = boxes[a].min[axis] + boxes[a].max[axis];
                       const float cb = boxes[b].min[axis] + boxes[b].max[axis];
                       return ca != cb ? ca < cb : a < b;
                     });
    build(boxes, begin, middle);
    nodes_[at].second = static_cast<uint32_t>(nodes_.size());
    build(boxes, middle, end);
  }

  std::vector<Node> nodes_;
  std::vector<uint32_t> parts_;
};

}  // namespace pssmlt
