// The exit pupil: where, as points of the film see it, light leaves a lens system.
//
// Source: Pharr, Jakob and Humphreys 2016, Physically Based Rendering, third edition,
// section 6.4.5: boxes around the part of the last surface's plane that rays get through, by
// distance from the axis. Rays outside of the boxes count as blocked, so that both directions agree
// on what is seen.
#pragma once

#include <optional>
#include <vector>

#include "core/lens/lens_system.h"

namespace pssmlt {

class ExitPupil {
 public:
  // For points of the film up to `film_radius` [m] from the axis; further out as at that distance.
  ExitPupil(const LensSystem& system, double film_radius);
  // True if no light gets through at all.
  bool empty() const { return boxes_.empty() || boxes_.front().empty(); }

  // Area [m^2] of the box for a point of the film; 0 if no light gets there.
  double area(const dvec2& film) const { return box(film).area(); }
  // A point of the box [m], in the plane of the last surface.
  dvec2 sample(const dvec2& film, const dvec2& u) const;
  bool contains(const dvec2& film, const dvec2& point) const;
  // Radius of a disk in the lens's front plane through which all rays pass [m].
  double front_radius() const { return front_radius_; }

 private:
  struct Box {
    dvec2 low{0.0}, high{0.0};
    bool empty() const { return !(high.x > low.x && high.y > low.y); }
    double area() const { return empty() ? 0.0 : (high.x - low.x) * (high.y - low.y); }
    void include(const Box& other);
    Box grown(const dvec2& by) const { return {low - by, high + by}; }
  };
  const Box& box(const dvec2& film) const;
  Box on_axis(const LensSystem& lens);
  Box search(const LensSystem& lens, double film, const Box& region, int cells);
  bool passes(const LensSystem& lens, double film, const dvec2& point);

  std::vector<Box> boxes_;  // x along the film point's direction from the axis
  double film_radius_;
  double front_radius_ = 0.0;
};

}  // namespace pssmlt
