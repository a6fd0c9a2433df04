// Whether floats can hold where shapes lie.
#include <fmt/format.h>

#include <algorithm>

#include "core/scene/scene_builder.h"

namespace pssmlt {
namespace {

Bounds bounds_of(const Shape& shape) {
  const TriangleMesh* const mesh = shape.mesh();
  if (mesh == nullptr) return shape.bounds();
  Bounds bounds;
  for (const vec3& p : mesh->positions) bounds.add(p);
  return bounds;
}

// Embree would leave out silently what its arithmetic cannot reach.
void refuse_beyond_reach(const Bounds& bounds, const Location& where) {
  const vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  if (bounds.min.x <= bounds.max.x && !(max_component(farthest) <= Accel::max_reach)) {
    throw Error(where, fmt::format("this shape reaches further than {:g} from the camera: that is "
                                   "too far",
                                   Accel::max_reach));
  }
}

}  // namespace

void SceneBuilder::check_place(const Shape& shape, const Transform& placed, const Location& where) {
  const Bounds bounds = bounds_of(shape);
  refuse_beyond_reach(bounds, where);
  note_coarse_grid(bounds, placed, where);
}

// Coordinates in files are floats, rounded to 2^-24 of their size: far from the origin that is much
// for a small shape. Transformations are composed in double and cost nothing.
void SceneBuilder::note_coarse_grid(const Bounds& box, const Transform& placed,
                                    const Location& where) {
  constexpr double rounding = 0x1p-24, much = 1e-3;
  if (!(box.min.x <= box.max.x)) return;
  dvec3 low(infinity), high(-infinity);  // of the box's corners, as the shape is written
  const Transform back = placed.inverse();
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                  corner & 4 ? box.max.z : box.min.z);
    const dvec3 given = back.point(p);
    low = glm::min(low, given);
    high = glm::max(high, given);
  }
  const dvec3 farthest = glm::max(glm::abs(low), glm::abs(high)), size = high - low;
  const double reach = std::max({farthest.x, farthest.y, farthest.z});
  const double share = rounding * reach / std::max({size.x, size.y, size.z, 1e-300});
  if (!(share > much)) return;
  if (coarse_shapes_++ == 0) first_coarse_ = where;
  coarsest_ = std::max(coarsest_, share);
}

void SceneBuilder::tell_coarse_grid() {
  if (coarse_shapes_ == 0) return;
  const std::string place = to_string(first_coarse_);
  built_.log.push_back(fmt::format(
      "warning: {}{} shapes have coordinates so far from the origin that rounding them to floats "
      "moves vertices by up to {:.2g} of the shape's size: write them near the origin and place "
      "them by Translate",
      place.empty() ? "" : place + ": ", coarse_shapes_, std::min(coarsest_, 1.0)));
}

}  // namespace pssmlt
