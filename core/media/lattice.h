// Values on a regular lattice in a box, interpolated trilinearly and zero beyond the outermost
// values: densities of media. Along a straight line the interpolant is a cubic polynomial inside
// every cell, which two points of Gauss-Legendre quadrature integrate exactly: integrals along rays
// and their inverses need no step size.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/ray.h"
#include "core/base/rgb.h"
#include "core/base/transform.h"

namespace pssmlt {

// The box that a lattice fills, in a space of its own.
struct LatticeFrame {
  ivec3 size{1};             // values along x, y, z
  vec3 low{0.f}, high{1.f};  // corners; values stand at the centres of size^3 equal parts
  Transform to_render;
};

// A straight line in units of cells: value (i, j, k) stands at the point (i, j, k).
struct LatticeLine {
  dvec3 origin{0.0}, direction{0.0};  // per metre
};

// Where lines meet lattices, whatever the values are.
class LatticeSpace {
 public:
  explicit LatticeSpace(const LatticeFrame& frame);
  const ivec3& size() const { return size_; }
  dvec3 point(const vec3& position) const { return to_cells_.point(dvec3(position)); }
  LatticeLine line(const Ray& ray) const;
  // Calls visit(from, to) [m along the ray] for every cell that the ray crosses, in order, until it
  // returns true; true if it did.
  bool walk(const LatticeLine& line, double t_max,
            const std::function<bool(double, double)>& visit) const;

 private:
  ivec3 size_;
  Transform to_cells_;  // render space to units of cells
};

template <typename T>
class Lattice {
 public:
  // values: x fastest, then y, then z; as many as frame.size says.
  Lattice(const LatticeFrame& frame, std::vector<T> values)
      : space_(frame), values_(std::move(values)) {}

  T at(const vec3& position) const { return interpolate(space_.point(position)); }
  // Over the ray from 0 to t_max [value * m].
  T integral(const Ray& ray) const {
    const LatticeLine line = space_.line(ray);
    T sum(0.f);
    space_.walk(line, static_cast<double>(ray.t_max), [&](double a, double b) {
      sum += piece(line, a, b);
      return false;
    });
    return sum;
  }
  // Where on the ray the integral of component(value), which is not negative, reaches `target`
  // [value * m]; nullopt if it does not.
  template <typename Component>
  std::optional<float> invert(const Ray& ray, float target, const Component& component) const {
    const LatticeLine line = space_.line(ray);
    float left = target;
    std::optional<float> found;
    space_.walk(line, static_cast<double>(ray.t_max), [&](double a, double b) {
      const float here = component(piece(line, a, b));
      if (here < left || !(here > 0.f)) {
        left -= here;
        return false;
      }
      found = static_cast<float>(solve(line, a, b, left, component));
      return true;
    });
    return found;
  }
  uint64_t bytes() const { return values_.size() * sizeof(T); }

 private:
  T value(int x, int y, int z) const {
    const ivec3& n = space_.size();
    if (x < 0 || y < 0 || z < 0 || x >= n.x || y >= n.y || z >= n.z) return T(0.f);
    return values_[(static_cast<size_t>(z) * static_cast<size_t>(n.y) + static_cast<size_t>(y)) *
                       static_cast<size_t>(n.x) +
                   static_cast<size_t>(x)];
  }
  T interpolate(const dvec3& p) const {
    const dvec3 n(space_.size());
    for (int i = 0; i < 3; ++i) {
      if (!(p[i] > -1.0 && p[i] < n[i])) return T(0.f);
    }
    const dvec3 low = glm::floor(p);
    const vec3 f(p - low);
    const ivec3 i(low);
    const auto row = [&](int y, int z) {
      return (1.f - f.x) * value(i.x, y, z) + f.x * value(i.x + 1, y, z);
    };
    const auto plane = [&](int z) { return (1.f - f.y) * row(i.y, z) + f.y * row(i.y + 1, z); };
    return (1.f - f.z) * plane(i.z) + f.z * plane(i.z + 1);
  }
  T on_line(const LatticeLine& line, double t) const {
    return interpolate(line.origin + t * line.direction);
  }
  // Integral over a part of the line inside one cell.
  T piece(const LatticeLine& line, double a, double b) const {
    const double half = 0.5 * (b - a), middle = 0.5 * (a + b);
    const double offset = half * 0.57735026918962576451;
    return static_cast<float>(half) *
           (on_line(line, middle - offset) + on_line(line, middle + offset));
  }
  // Newton's method inside a bracket: the integral from `a` grows with t.
  template <typename Component>
  double solve(const LatticeLine& line, double a, double b, float target,
               const Component& component) const {
    double low = a, high = b;
    double t = a + (b - a) * 0.5;
    for (int i = 0; i < 24 && high - low > 1e-7 * high; ++i) {
      const float excess = component(piece(line, a, t)) - target;
      (excess < 0.f ? low : high) = t;
      const float slope = component(on_line(line, t));
      const double next = t - static_cast<double>(excess / slope);
      const bool inside = next > low && next < high;
      if (inside && std::abs(next - t) <= 1e-7 * (b - a)) return next;
      t = inside ? next : 0.5 * (low + high);
    }
    return t;
  }

  LatticeSpace space_;
  std::vector<T> values_;
};

}  // namespace pssmlt
