#include "core/lens/exit_pupil.h"

#include <algorithm>
#include <cmath>

namespace pssmlt {
namespace {

constexpr int intervals = 64;  // of the distance from the axis
constexpr int coarse = 40;     // cells a side, of a search

// The coordinate axes turned so that x points from the axis to the film point.
dvec2 direction_of(const dvec2& film) {
  const double r = glm::length(film);
  return r > 0.0 ? film / r : dvec2(1.0, 0.0);
}

}  // namespace

void ExitPupil::Box::include(const Box& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  low = glm::min(low, other.low);
  high = glm::max(high, other.high);
}

// From the axis outward the pupil is followed from radius to radius: it moves and shrinks slowly,
// so that each search starts around the last pupil found, however small that is.
ExitPupil::ExitPupil(const LensSystem& system, double film_radius) : film_radius_(film_radius) {
  const LensSystem lens = system.with_round_stops();
  std::vector<Box> at;
  Box last = on_axis(lens);
  if (last.empty()) return;
  const double step = film_radius / (2 * intervals);
  for (int i = 0; i <= 2 * intervals; ++i) {
    if (!last.empty()) {
      const dvec2 size = last.high - last.low;
      const Box region = last.grown(0.5 * size + dvec2(2.0 * step, 0.0));
      const double most = std::max((region.high.x - region.low.x) / size.x,
                                   (region.high.y - region.low.y) / size.y);
      const int cells = std::clamp(static_cast<int>(16.0 * most), coarse, 512);
      last = search(lens, i * step, region, cells);
      if (!last.empty()) last = search(lens, i * step, last, coarse);
    }
    at.push_back(last);
  }
  boxes_.resize(intervals);
  for (size_t i = 0; i < intervals; ++i)
    for (size_t k = 0; k <= 2; ++k) boxes_[i].include(at[2 * i + k]);
  front_radius_ *= 1.03;  // between the rays that were followed
}

bool ExitPupil::passes(const LensSystem& lens, double film, const dvec2& point) {
  LensRay ray;
  ray.origin = {film, 0.0, 0.0};
  ray.direction = glm::normalize(dvec3(point, lens.rear().z) - ray.origin);
  if (!(lens.from_film(ray) > 0.0)) return false;
  const dvec3 front = ray.at_height(lens.front_plane());
  front_radius_ = std::max(front_radius_, glm::length(dvec2(front)));
  return true;
}

// Lens and stops are round: one radius says all.
ExitPupil::Box ExitPupil::on_axis(const LensSystem& lens) {
  constexpr int steps = 4096;
  const double step = 1.5 * lens.rear().opening / steps;
  double reach = 0.0;
  for (int i = 0; i < steps; ++i)
    if (passes(lens, 0.0, {(i + 0.5) * step, 0.0})) reach = (i + 1.5) * step;
  return {dvec2(-reach), dvec2(reach)};
}

ExitPupil::Box ExitPupil::search(const LensSystem& lens, double film, const Box& region,
                                 int cells) {
  const dvec2 cell = (region.high - region.low) / static_cast<double>(cells);
  Box found;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const dvec2 p = region.low + (dvec2(i, j) + 0.5) * cell;
      const Box one{p - cell, p + cell};
      const bool known = !found.empty() && glm::all(glm::greaterThanEqual(one.low, found.low)) &&
                         glm::all(glm::lessThanEqual(one.high, found.high));
      if (!known && passes(lens, film, p)) found.include(one);
    }
  }
  return found;
}

const ExitPupil::Box& ExitPupil::box(const dvec2& film) const {
  const double r = glm::length(film) / film_radius_ * intervals;
  return boxes_[static_cast<size_t>(std::clamp(r, 0.0, intervals - 1.0))];
}

dvec2 ExitPupil::sample(const dvec2& film, const dvec2& u) const {
  const Box& b = box(film);
  const dvec2 p = glm::mix(b.low, b.high, u), x = direction_of(film);
  return {x.x * p.x - x.y * p.y, x.y * p.x + x.x * p.y};
}

bool ExitPupil::contains(const dvec2& film, const dvec2& point) const {
  const Box& b = box(film);
  const dvec2 x = direction_of(film);
  const dvec2 p(x.x * point.x + x.y * point.y, x.x * point.y - x.y * point.x);
  return !b.empty() && glm::all(glm::greaterThanEqual(p, b.low)) &&
         glm::all(glm::lessThanEqual(p, b.high));
}

}  // namespace pssmlt
