// Spherical camera: a picture of all directions around a point, y up, whatever the film's shape.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 5.3; the equal-area map
// is Clarberg 2008 (core/base/equal_area.h), as environment maps have it. Rays through the filter's
// border beyond the picture's edges look to where the map continues, so that a direction near an
// edge is seen at several places; light that comes along it lands on one of them, chosen at random
// and counted for all. The camera's transform may be any affine map.
#include <array>
#include <glm/matrix.hpp>

#include "core/base/equal_area.h"
#include "core/camera_screen.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Directions here have z up; (0, 0) is the corner of the upper row.
struct EqualArea {
  static dvec3 direction(const dvec2& uv) { return square_to_sphere(wrap_to_square(uv)); }
  static dvec2 point(const dvec3& d) { return sphere_to_square(d); }
  static double solid_angle(const dvec3&) { return 2.0 * two_pi; }  // [sr] per unit of uv
  // Where the tile (i, j) of the plane shows what the picture shows at uv.
  static dvec2 image(const dvec2& uv, int i, int j) {
    return ((i + j) % 2 == 0 ? uv : 1.0 - uv) + dvec2(i, j);
  }
};

// Latitude and longitude. Beyond the poles the meridian continues on the other side.
struct EquiRectangular {
  static dvec3 direction(const dvec2& uv) {
    const double theta = std::numbers::pi * uv.y, phi = two_pi * uv.x;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  }
  static dvec2 point(const dvec3& d) {
    const double turn = std::atan2(d.y, d.x) / two_pi;
    return {turn < 0.0 ? turn + 1.0 : turn,
            std::atan2(std::hypot(d.x, d.y), d.z) * std::numbers::inv_pi};
  }
  static double solid_angle(const dvec3& d) {
    return two_pi * std::numbers::pi * std::hypot(d.x, d.y);
  }
  static dvec2 image(const dvec2& uv, int i, int j) {
    return j % 2 == 0 ? uv + dvec2(i, j) : dvec2(uv.x + 0.5 + i, 1.0 - uv.y + j);
  }
};

class Spherical final : public Camera {
 public:
  static constexpr const char* summary = "All directions around a point";

  Spherical(Parameters& p, const RasterFrame& frame) : frame_(frame), size_(frame.resolution) {
    constexpr std::array<std::string_view, 2> mappings = {"equalarea", "equirectangular"};
    equal_area_ =
        p.choice("mapping", mappings[0], mappings,
                 "equalarea: as environment maps; or longitude by latitude") == mappings[0];
    read_shutter(p);
    constexpr const char* unused = "Without effect: the picture is the whole sphere.";
    p.number("frameaspectratio", 1.f, "", unused);
    p.numbers("screenwindow", "", unused);
    p.number("lensradius", 0.f, "m", "Without effect: the camera is a point.");
    p.number("focaldistance", 1e30f, "m", "Without effect: all is in focus.");
    if (p.describing()) return;
    to_render_ = glm::dmat3(p.transform().matrix());
    to_camera_ = glm::inverse(to_render_);
    determinant_ = std::abs(glm::determinant(to_render_));
    center_ = p.transform().point(dvec3(0.0));
  }

  EndpointTraits traits() const override { return {.delta_position = true}; }
  vec3 center() const override { return vec3(center_); }
  // At the horizon.
  float pixel_spread() const override {
    return static_cast<float>(std::sqrt(solid_angle({1.0, 0.0, 0.0}) / (size_.x * size_.y)));
  }

  std::optional<Emission> emit(const vec2&, const dvec2& u_direction) const override {
    const dvec2 uv = u_direction / size_;
    const dvec3 d = equal_area_ ? EqualArea::direction(uv) : EquiRectangular::direction(uv);
    Emission e;
    e.from.position = vec3(center_);
    e.direction = vec3(glm::normalize(to_render_ * dvec3(d.x, d.z, d.y)));
    const EmissionValue v = importance(local(e.direction));
    // A pole of longitudes, where pixels have no solid angle.
    if (!(v.pdf_direction > 0.f)) return std::nullopt;
    e.value = v.value;
    e.pdf_position = v.pdf_position;
    e.pdf_direction = v.pdf_direction;
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2& u) const override {
    Toward t;
    t.at.position = vec3(center_);
    const vec3 d = t.at.position - reference;
    t.pdf_toward = length_squared(d);
    if (!(t.pdf_toward > 0.f)) return std::nullopt;
    t.distance = std::sqrt(t.pdf_toward);
    t.wi = d / t.distance;
    const Local l = local(-t.wi);
    const int places = seen_at(l.direction, -1, t.raster);
    if (places == 0) return std::nullopt;
    seen_at(l.direction, static_cast<int>(u.x * static_cast<float>(places)), t.raster);
    const EmissionValue v = importance(l);
    if (!(v.pdf_direction > 0.f)) return std::nullopt;
    t.value = static_cast<float>(places) * v.value;
    t.pdf_position = v.pdf_position;
    t.pdf_direction = v.pdf_direction;
    return t;
  }

  EmissionValue evaluate(const EndpointPoint&, const vec3& direction) const override {
    dvec2 ignored;
    const Local l = local(direction);
    return seen_at(l.direction, -1, ignored) == 0 ? EmissionValue{Rgb(0.f), 1.f, 1.f, 0.f}
                                                  : importance(l);
  }
  float pdf_toward(const vec3& reference, const EndpointPoint& at) const override {
    const vec3 d = reference - at.position;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f)) return 0.f;
    return evaluate(at, d / std::sqrt(distance2)).pdf_direction > 0.f ? distance2 : 0.f;
  }
  // The first of several places.
  std::optional<dvec2> raster(const vec3&, const vec3& direction) const override {
    dvec2 place;
    if (seen_at(local(direction).direction, 0, place) == 0) return std::nullopt;
    return place;
  }

 private:
  // A direction in the camera's space, unit, z up, and its length there before.
  struct Local {
    dvec3 direction;
    double length;
  };
  Local local(const vec3& direction) const {
    const dvec3 d = to_camera_ * dvec3(direction);
    const double length = glm::length(d);
    return {dvec3(d.x, d.z, d.y) / length, length};
  }
  // [sr] in the camera's space per unit of the picture's area.
  double solid_angle(const dvec3& d) const {
    return equal_area_ ? EqualArea::solid_angle(d) : EquiRectangular::solid_angle(d);
  }
  // Value and densities where it is seen once. Solid angles of render space are determinant
  // length^3 times the camera's.
  EmissionValue importance(const Local& l) const {
    const double pixel = solid_angle(l.direction) / (size_.x * size_.y) * determinant_ * l.length *
                         l.length * l.length;
    EmissionValue v{Rgb(0.f), 1.f, 1.f, 0.f};
    if (!(pixel > 0.0)) return v;
    v.pdf_direction = static_cast<float>(1.0 / (pixel * frame_.pixels()));
    v.value = Rgb(v.pdf_direction);
    return v;
  }

  // At how many places in the window and the filter's radius around it a direction is seen; writes
  // the place with this index, if there is one, to `raster`.
  int seen_at(const dvec3& d, int index, dvec2& raster) const {
    const dvec2 uv = equal_area_ ? EqualArea::point(d) : EquiRectangular::point(d);
    const ivec2 first = ivec2(glm::floor(frame_.low() / size_)) - ivec2(1, 0);
    const ivec2 last = ivec2(glm::floor(frame_.high() / size_));
    int found = 0;
    for (int j = first.y; j <= last.y; ++j)
      for (int i = first.x; i <= last.x; ++i) {
        const dvec2 image =
            size_ * (equal_area_ ? EqualArea::image(uv, i, j) : EquiRectangular::image(uv, i, j));
        if (!frame_.shows(image)) continue;
        if (found == index) raster = image;
        ++found;
      }
    return found;
  }

  RasterFrame frame_;
  dvec2 size_;  // of the full picture [pixels]
  bool equal_area_ = true;
  glm::dmat3 to_render_{1.0}, to_camera_{1.0};
  double determinant_ = 1.0;  // of to_render_
  dvec3 center_{0.0};
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Camera, "spherical", pssmlt::Spherical)
