// Whether floats can hold where shapes lie.
#include <fmt/format.h>

#include <algorithm>

#include "core/fibre.h"
#include "core/scene/accel.h"
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

// Hair crosses hair everywhere, and its sheets have no two sides that could be mixed up.
bool refracts(const Primitive& p) {
  return p.transmits && !p.bounds_medium && !is_of_fibres(*p.material);
}

// Another surface that light crosses, so close to this point that a ray leaving one starts beyond
// the other; null if there is none.
const Primitive* too_close(const Accel& accel, const Primitive& own, const SurfaceSample& at) {
  constexpr float margin = 4.f;  // offsets of rays, which start at an error bound's distance
  const float far = margin * glm::dot(glm::abs(at.normal), at.error);
  for (const float side : {1.f, -1.f}) {
    const Ray ray{.origin = at.position + side * far * at.normal,
                  .direction = -side * at.normal,
                  .t_max = 2.f * far};
    RawHit hit;
    if (!accel.intersect(ray, hit) || hit.primitive == &own) continue;
    if (refracts(*hit.primitive)) return hit.primitive;
  }
  return nullptr;
}

}  // namespace

// Between two surfaces that floats cannot tell apart light would cross one only: glass upon glass
// would seem to be entered twice, or left twice. Some points of every refracting surface are looked
// at; shapes inside of objects are not.
void SceneBuilder::tell_touching_interfaces() {
  constexpr size_t most_points = 8192, points_a_shape = 64;
  std::vector<const Primitive*> found;
  for (const auto& p : scene_->primitives_) {
    if (refracts(*p) && p->shape->area() > 0.f) found.push_back(p.get());
  }
  if (found.size() < 2) return;
  const size_t points = std::min(points_a_shape, most_points / found.size() + 1);
  for (const Primitive* const p : found) {
    for (size_t i = 0; i < points; ++i) {
      // The R2 sequence, additive recurrence by the plastic number, from no special point.
      const vec2 u(glm::fract(.2718281828 + .7548776662466927 * static_cast<double>(i)),
                   glm::fract(.1414213562 + .5698402909980532 * static_cast<double>(i)));
      const Primitive* const other = too_close(*scene_->accel_, *p, p->shape->sample_area(u));
      if (other == nullptr) continue;
      built_.warnings.push_back(
          p->name + " and " + other->name +
          " lie so close to each other that rays pass one of them only: light "
          "that is refracted there is wrong; leave a gap, or one surface out");
      return;
    }
  }
}

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
  built_.warnings.push_back(fmt::format(
      "{}{} shapes have coordinates so far from the origin that rounding them to floats "
      "moves vertices by up to {:.2g} of the shape's size: write them near the origin and place "
      "them by Translate",
      place.empty() ? "" : place + ": ", coarse_shapes_, std::min(coarsest_, 1.0)));
}

}  // namespace pssmlt
