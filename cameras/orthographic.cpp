// Orthographic camera: all rays are parallel, objects keep their size at any distance.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 5.2.1. As an endpoint
// it is the mirror image of a distant light: the direction is a delta, positions lie on the film,
// and pdf_position is (pixels per m^2) / (pixels in the window). A lens is refused: in the format's
// own renderer it gathers all rays at one point, which is a perspective camera.
#include <glm/matrix.hpp>

#include "core/camera_screen.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Orthographic final : public Camera {
 public:
  static constexpr const char* summary = "Parallel view";

  Orthographic(Parameters& p, const RasterFrame& frame) : screen_(p, frame) {
    const float lens_radius = p.number("lensradius", 0.f, "m", "Must be 0.");
    const float focus = p.number("focaldistance", 1e6f, "m", "Without a lens all is in focus.");
    if (lens_radius != 0.f) p.fail("lensradius", "a lens is not supported yet");
    if (!(focus > 0.f)) p.fail("focaldistance", "\"focaldistance\" must be positive");
    if (!p.describing()) place(p.transform());
  }

  EndpointTraits traits() const override { return {.delta_direction = true}; }
  vec3 center() const override { return vec3(center_); }
  float pixel_spread() const override { return static_cast<float>(std::sqrt(pixel_area_)); }
  bool parallel() const override { return true; }

  std::optional<Emission> emit(const vec2&, const dvec2& u_direction) const override {
    Emission e;
    e.from.position = vec3(center_ + to_render_ * dvec3(screen_.screen(u_direction), 0.0));
    e.from.normal = normal_;
    e.direction = direction_;
    e.value = Rgb(pdf_position_ / cosine_);
    e.cosine = cosine_;
    e.pdf_position = pdf_position_;
    e.pdf_direction = 1.f;
    return e;
  }

  // The one point of the film that sees the reference.
  std::optional<Toward> toward(const vec3& reference, const vec2&) const override {
    const double depth =
        glm::dot(dvec3(reference) - center_, dvec3(normal_)) / static_cast<double>(cosine_);
    if (!(depth > 0.0)) return std::nullopt;
    Toward t;
    t.at.position = vec3(dvec3(reference) - depth * exact_direction_);
    t.at.normal = normal_;
    const auto raster_position = raster(reference, direction_);
    if (!raster_position) return std::nullopt;
    t.raster = *raster_position;
    t.wi = -direction_;
    t.distance = static_cast<float>(depth);
    t.value = Rgb(pdf_position_ / cosine_);
    t.pdf_toward = 1.f;
    t.cosine = cosine_;
    t.pdf_position = pdf_position_;
    t.pdf_direction = 1.f;
    return t;
  }

  EmissionValue evaluate(const EndpointPoint& at, const vec3& direction) const override {
    if (!raster(at.position, direction)) return {Rgb(0.f), cosine_, pdf_position_, 1.f};
    return {Rgb(pdf_position_ / cosine_), cosine_, pdf_position_, 1.f};
  }
  float pdf_toward(const vec3&, const EndpointPoint& at) const override {
    return raster(at.position, direction_) ? 1.f : 0.f;
  }

  // Any point along the ray serves as its start.
  std::optional<dvec2> raster(const vec3& at, const vec3& direction) const override {
    if (!(glm::dot(direction, normal_) > 0.f)) return std::nullopt;
    const dvec3 on_film = to_camera_ * (dvec3(at) - center_);
    const dvec2 r = screen_.raster(dvec2(on_film));
    if (!screen_.shows(r)) return std::nullopt;
    return r;
  }

 private:
  void place(const Transform& transform) {
    to_render_ = glm::dmat3(transform.matrix());
    to_camera_ = glm::inverse(to_render_);
    center_ = transform.point(dvec3(0.0));
    exact_direction_ = glm::normalize(to_render_[2]);
    const dvec3 n = glm::cross(to_render_[0], to_render_[1]);
    const dvec3 unit = glm::normalize(glm::dot(n, exact_direction_) < 0.0 ? -n : n);
    direction_ = vec3(exact_direction_);
    normal_ = vec3(unit);
    cosine_ = static_cast<float>(glm::dot(unit, exact_direction_));
    pixel_area_ = std::abs(screen_.pixel().x * screen_.pixel().y) * glm::length(n);
    pdf_position_ = static_cast<float>(1.0 / (pixel_area_ * screen_.pixels()));
  }

  ScreenMap screen_;
  glm::dmat3 to_render_{1.0}, to_camera_{1.0};
  dvec3 center_{0.0}, exact_direction_{0.0, 0.0, 1.0};
  vec3 direction_{0.f, 0.f, 1.f}, normal_{0.f, 0.f, 1.f};
  float cosine_ = 1.f;        // between the two: 1 but for sheared transforms
  double pixel_area_ = 1.0;   // on the film [m^2]
  float pdf_position_ = 1.f;  // [1/m^2]
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Camera, "orthographic", pssmlt::Orthographic)
