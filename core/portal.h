// Portals: a rectangle that light from infinity comes through, as a guide to where a point of a
// room sees the sky. It changes how directions are drawn, never what light there is.
//
// Source: Bitterli, Novak, Jarosz 2015, Portal-Masked Environment Map Sampling. The sky is laid out
// so that the rectangle is a window with straight edges wherever it is seen from; windows are
// sampled exactly by sums over rectangles.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/math.h"

namespace pssmlt {

// A piecewise-constant function on a grid over the unit square, sampled within windows.
class WindowDistribution {
 public:
  struct Window {
    dvec2 low{0.0}, high{1.0};
    bool contains(const dvec2& p) const {
      return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
    }
  };
  WindowDistribution() = default;
  // size x size values, finite and not negative, row by row.
  WindowDistribution(const std::vector<float>& values, int size);
  // Integral over the window.
  double integral(const Window& w) const;
  // A point with density value / integral(w) in the window. Precondition: integral(w) > 0.
  dvec2 sample(const dvec2& u, const Window& w) const;
  double value(const dvec2& p) const;

 private:
  // Of the rectangle from (0, 0) to p, in cells.
  double sum_to(const dvec2& p) const;
  double corner(int x, int y) const { return sums_[static_cast<size_t>(y * (size_ + 1) + x)]; }

  int size_ = 0;
  std::vector<double> sums_;  // over the cells left of and above each corner of the grid
};

class Portal {
 public:
  // The corners in order, in render space; the sky is on the side of cross(p3 - p0, p1 - p0).
  // nullopt if they make no rectangle. `sky`: luminance by direction (unit), looked up on a grid of
  // size x size.
  static std::optional<Portal> make(const std::array<dvec3, 4>& corners,
                                    const std::function<float(const vec3&)>& sky, int size);

  // What a point sees through the portal.
  struct View {
    WindowDistribution::Window window;
    double integral = 0.0;  // of luminance over the window's solid angle
  };
  // nullopt where the point is not inside, or all it sees of the sky there is black.
  std::optional<View> view(const vec3& from) const;
  // A direction through the portal, unit, by luminance; and its density [1/sr].
  vec3 sample(const View& view, const vec2& u) const;
  float pdf(const View& view, const vec3& direction) const;

 private:
  // Sides and outward normal, unit, and two opposite corners.
  Portal(const dvec3& x, const dvec3& y, const dvec3& low, const dvec3& high);
  dvec3 to_local(const dvec3& d) const {
    return {glm::dot(d, x_), glm::dot(d, y_), glm::dot(d, z_)};
  }

  dvec3 x_, y_, z_, low_, high_;
  WindowDistribution distribution_;
  double total_ = 0.0;  // integral over all of the sky on that side
};

}  // namespace pssmlt
