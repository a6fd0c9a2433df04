// Perspective camera, through a pinhole or a thin lens.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, sections 5.2.2 and 5.2.3; the
// importance is Veach 1997, section 8.3.2, relative to the rendered window. The camera's transform
// may be any affine map: a pixel's solid angle is the determinant of the rays through its sides.
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "core/base/warp.h"
#include "core/camera_screen.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Perspective final : public Camera {
 public:
  static constexpr const char* summary = "Perspective view through a pinhole or a thin lens";

  Perspective(Parameters& p, const RasterFrame& frame) : screen_(p, frame) {
    const double fov = static_cast<double>(
        p.number("fov", 90.f, "degrees", "Angle of view along the shorter axis."));
    lens_radius_ =
        static_cast<double>(p.number("lensradius", 0.f, "m", "Radius of the lens; 0: pinhole."));
    focus_ = static_cast<double>(
        p.number("focaldistance", 1e6f, "m", "Distance of the plane in focus."));
    if (!(fov > 0.0 && fov < 180.0)) p.fail("fov", "\"fov\" must lie between 0 and 180 degrees");
    if (lens_radius_ < 0.0) p.fail("lensradius", "\"lensradius\" must not be negative");
    if (!(focus_ > 0.0)) p.fail("focaldistance", "\"focaldistance\" must be positive");
    if (p.describing()) return;
    tangent_ = std::tan(glm::radians(0.5 * fov));
    place(p.transform());
  }

  EndpointTraits traits() const override { return {.delta_position = lens_radius_ == 0.0}; }
  vec3 center() const override { return vec3(center_); }
  float pixel_spread() const override {
    const dvec3 c(tangent_ * screen_.center(), 1.0);
    const double length = glm::length(to_render_ * c);
    return static_cast<float>(std::sqrt(pixel_volume_ / (length * length * length)));
  }

  std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const override {
    const dvec2 lens = lens_position(u_position);
    const dvec2 at_focus = tangent_ * screen_.screen(u_direction) - lens / focus_;
    Emission e;
    e.from = lens_point(lens);
    e.direction = vec3(glm::normalize(to_render_ * dvec3(at_focus, 1.0)));
    const EmissionValue v = importance(to_camera_ * dvec3(e.direction), e.direction);
    e.value = v.value;
    e.cosine = v.cosine;
    e.pdf_position = v.pdf_position;
    e.pdf_direction = v.pdf_direction;
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2& u) const override {
    Toward t;
    t.at = lens_point(lens_position(u));
    const vec3 d = t.at.position - reference;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f)) return std::nullopt;
    t.distance = std::sqrt(distance2);
    t.wi = d / t.distance;
    const auto raster_position = raster(t.at.position, -t.wi);
    if (!raster_position) return std::nullopt;
    t.raster = *raster_position;
    const EmissionValue v = importance(to_camera_ * dvec3(-t.wi), -t.wi);
    t.value = v.value;
    t.cosine = v.cosine;
    t.pdf_position = v.pdf_position;
    t.pdf_direction = v.pdf_direction;
    t.pdf_toward = pdf_position_ * distance2 / v.cosine;
    return t;
  }

  EmissionValue evaluate(const EndpointPoint& at, const vec3& direction) const override {
    if (!raster(at.position, direction)) return {Rgb(0.f), cosine(direction), pdf_position_, 0.f};
    return importance(to_camera_ * dvec3(direction), direction);
  }

  float pdf_toward(const vec3& reference, const EndpointPoint& at) const override {
    const vec3 d = reference - at.position;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f) || !raster(at.position, d / std::sqrt(distance2))) return 0.f;
    return pdf_position_ * distance2 / cosine(d / std::sqrt(distance2));
  }

  std::optional<dvec2> raster(const vec3& at, const vec3& direction) const override {
    const dvec3 d = to_camera_ * dvec3(direction);
    if (!(d.z > 0.0)) return std::nullopt;
    dvec2 focus_point = dvec2(d) / d.z;
    if (lens_radius_ > 0.0) focus_point += dvec2(to_camera_ * (dvec3(at) - center_)) / focus_;
    const dvec2 r = screen_.raster(focus_point / tangent_);
    if (!screen_.shows(r)) return std::nullopt;
    return r;
  }

 private:
  void place(const Transform& transform) {
    to_render_ = glm::dmat3(transform.matrix());
    to_camera_ = glm::inverse(to_render_);
    center_ = transform.point(dvec3(0.0));
    const dvec3 n = glm::cross(to_render_[0], to_render_[1]);
    normal_ = vec3(glm::normalize(glm::dot(n, to_render_[2]) < 0.0 ? -n : n));
    const dvec2 pixel = tangent_ * screen_.pixel();
    pixel_volume_ = std::abs(pixel.x * pixel.y * glm::determinant(to_render_));
    if (lens_radius_ > 0.0)
      pdf_position_ = static_cast<float>(
          1.0 / (std::numbers::pi * lens_radius_ * lens_radius_ * glm::length(n)));
  }

  // In the camera's units, from the centre of the lens.
  dvec2 lens_position(const vec2& u) const {
    return lens_radius_ > 0.0 ? lens_radius_ * concentric_disk(dvec2(u)) : dvec2(0.0);
  }
  EndpointPoint lens_point(const dvec2& lens) const {
    EndpointPoint at;
    at.position = vec3(center_ + to_render_ * dvec3(lens, 0.0));
    if (lens_radius_ > 0.0) at.normal = normal_;
    return at;
  }
  float cosine(const vec3& direction) const {
    return lens_radius_ > 0.0 ? std::abs(glm::dot(normal_, direction)) : 1.f;
  }

  // Value and densities of a ray along `direction`, unit in render space, `d` in the camera's.
  // A ray through the screen at depth 1 has length 1 / d.z in render space, so that a pixel seen
  // along it has the solid angle pixel_volume_ d.z^3, wherever on the lens the ray starts.
  EmissionValue importance(const dvec3& d, const vec3& direction) const {
    EmissionValue v;
    v.cosine = cosine(direction);
    v.pdf_position = pdf_position_;
    v.pdf_direction =
        static_cast<float>(1.0 / (pixel_volume_ * d.z * d.z * d.z * screen_.pixels()));
    v.value = Rgb(v.pdf_position * v.pdf_direction / v.cosine);
    return v;
  }

  ScreenMap screen_;
  double lens_radius_ = 0.0, focus_ = 1e6, tangent_ = 1.0;  // of half the angle of view
  glm::dmat3 to_render_{1.0}, to_camera_{1.0};
  dvec3 center_{0.0};
  vec3 normal_{0.f, 0.f, 1.f};  // of the lens, toward the scene
  double pixel_volume_ = 1.0;   // determinant of the rays along a pixel's sides and through it
  float pdf_position_ = 1.f;    // [1/m^2]; 1 for the pinhole
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Camera, "perspective", pssmlt::Perspective)
