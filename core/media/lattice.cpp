#include "core/media/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pssmlt {

LatticeSpace::LatticeSpace(const LatticeFrame& frame) : size_(frame.size) {
  const dvec3 low(frame.low), extent = dvec3(frame.high) - low;
  const dvec3 n(frame.size);
  to_cells_ = Transform::translate(dvec3(-0.5)) * Transform::scale(n / extent) *
              Transform::translate(-low) * frame.to_render.inverse();
}

LatticeLine LatticeSpace::line(const Ray& ray) const {
  return {to_cells_.point(dvec3(ray.origin)), to_cells_.vector(dvec3(ray.direction))};
}

// A digital differential analyser (Amanatides and Woo 1987). Every boundary is computed from its
// number, so that errors do not add up along the way.
bool LatticeSpace::walk(const LatticeLine& line, double t_max,
                        const std::function<bool(double, double)>& visit) const {
  const dvec3& o = line.origin;
  const dvec3& d = line.direction;
  double begin = 0.0, end = t_max;
  for (int i = 0; i < 3; ++i) {
    const double low = -1.0, high = static_cast<double>(size_[i]);
    if (d[i] == 0.0) {
      if (!(o[i] > low && o[i] < high)) return false;
      continue;
    }
    const double a = (low - o[i]) / d[i], b = (high - o[i]) / d[i];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(begin < end)) return false;
  dvec3 boundary, next;  // number of the next boundary along each axis, and where it is crossed
  const auto cross = [&](int i) {
    next[i] = d[i] == 0.0 ? std::numeric_limits<double>::infinity() : (boundary[i] - o[i]) / d[i];
  };
  for (int i = 0; i < 3; ++i) {
    const double at = o[i] + begin * d[i];
    boundary[i] = d[i] > 0.0 ? std::floor(at) + 1.0 : std::ceil(at) - 1.0;
    cross(i);
  }
  for (double t = begin; t < end;) {
    const int axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const double to = std::min(next[axis], end);
    if (to > t && visit(t, to)) return true;
    t = std::max(t, to);
    boundary[axis] += d[axis] > 0.0 ? 1.0 : -1.0;
    cross(axis);
  }
  return false;
}

}  // namespace pssmlt
