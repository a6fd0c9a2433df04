// Irradiance camera: no lens, only the points of a surface, which see the hemisphere above them.
// A pixel holds the mean irradiance [W/m^2] of its part of the surface; of a point, all pixels hold
// that point's.
//
// Source: irradiance and its Monte Carlo estimate, Pharr, Jakob, Humphreys 2023, Physically Based
// Rendering, sections 4.1 and 13.3 (cosine-weighted directions); as an endpoint it is the mirror
// image of a diffuse area light. The surface stands in the camera's space; the camera's transform
// may be any affine map. Wide filters reach beyond the picture: flat surfaces go on there, a sphere
// begins again. Blind to what stands behind the surface.
#include <array>
#include <glm/matrix.hpp>

#include "core/base/frame.h"
#include "core/base/warp.h"
#include "core/camera_screen.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 4> surfaces = {"point", "rectangle", "disk", "sphere"};

class Irradiance final : public Camera {
 public:
  static constexpr const char* summary = "Irradiance [W/m^2] at a point or over a surface";

  Irradiance(Parameters& p, const RasterFrame& frame) : frame_(frame), size_(frame.resolution) {
    surface_ = p.choice("surface", surfaces[0], surfaces,
                        "point; rectangle or disk around it; or a sphere, seen from outside, with "
                        "longitude across and height down the picture");
    position_ = dvec3(p.point("position", vec3(0.f), "m", "The point, or the surface's centre."));
    const vec3 normal = p.vector("normal", {0.f, 0.f, 1.f}, "Normal of the surface there.");
    const float width = p.number("width", 1.f, "m", "Of the rectangle, across the picture.");
    const float height = p.number("height", 1.f, "m", "Of the rectangle.");
    const float radius = p.number("radius", 1.f, "m", "Of the disk or the sphere.");
    read_shutter(p);
    if (!(length_squared(normal) > 0.f)) p.fail("normal", "\"normal\" must not be zero");
    check_extent(p, "width", width, surface_ == "rectangle");
    check_extent(p, "height", height, surface_ == "rectangle");
    check_extent(p, "radius", radius, surface_ == "disk" || surface_ == "sphere");
    if (p.describing()) return;
    extent_ = surface_ == "rectangle" ? dvec2(width, height) : dvec2(radius);
    place(p.transform(), glm::normalize(dvec3(normal)));
  }

  EndpointTraits traits() const override { return {.delta_position = is_point()}; }
  vec3 center() const override { return vec3(origin_ + matrix_ * position_); }
  // Directions are drawn, none is a pixel's: textures are seen unfiltered.
  float pixel_spread() const override { return 0.f; }
  bool measures_irradiance() const override { return true; }
  bool bare() const override { return true; }

  std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const override {
    const Point at = point(u_direction);
    const vec3 local = cosine_hemisphere(u_position);
    if (!(local.z > 0.f)) return std::nullopt;
    Emission e;
    e.from = at.endpoint();
    e.error = at.error();
    const Frame frame(e.from.normal);
    e.direction = glm::normalize(local.x * frame.s + local.y * frame.t + local.z * frame.n);
    const EmissionValue v = importance(at.density, local.z);
    e.value = v.value;
    e.cosine = v.cosine;
    e.pdf_position = v.pdf_position;
    e.pdf_direction = v.pdf_direction;
    return e;
  }

  // A point of the surface, uniformly by raster position, up to where filters reach.
  std::optional<Toward> toward(const vec3& reference, const vec2& u) const override {
    Toward t;
    t.raster = glm::mix(frame_.low(), frame_.high(), dvec2(u));
    const Point at = point(t.raster);
    t.at = at.endpoint();
    t.error = at.error();
    const vec3 d = t.at.position - reference;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f)) return std::nullopt;
    t.distance = std::sqrt(distance2);
    t.wi = d / t.distance;
    const float cosine = -glm::dot(t.at.normal, t.wi);
    if (!(cosine > 0.f)) return std::nullopt;
    const EmissionValue v = importance(at.density, cosine);
    t.value = v.value;
    t.cosine = v.cosine;
    t.pdf_position = v.pdf_position;
    t.pdf_direction = v.pdf_direction;
    t.pdf_toward = v.pdf_position * in_window() * distance2 / cosine;
    return t;
  }

  EmissionValue evaluate(const EndpointPoint& at, const vec3& direction) const override {
    const float cosine = glm::dot(at.normal, direction);
    EmissionValue v = importance(density(at.normal), std::abs(cosine));
    if (!(cosine > 0.f)) v.value = Rgb(v.pdf_direction = 0.f);
    return v;
  }

  float pdf_toward(const vec3& reference, const EndpointPoint& at) const override {
    const vec3 d = reference - at.position;
    const float distance2 = length_squared(d), cosine = glm::dot(at.normal, d);
    if (!(distance2 > 0.f && cosine > 0.f)) return 0.f;
    return density(at.normal) * in_window() * distance2 * std::sqrt(distance2) / cosine;
  }

  // Of a point, which is all over the picture, the window's centre.
  std::optional<dvec2> raster(const vec3& at, const vec3& direction) const override {
    const dvec3 local = glm::transpose(axes_) * (to_camera_ * (dvec3(at) - origin_) - position_);
    dvec3 normal(0.0, 0.0, 1.0);
    if (surface_ == "sphere") normal = glm::normalize(local);
    if (!(glm::dot(to_render_normal(normal), direction) > 0.f)) return std::nullopt;
    const dvec2 r = raster_of(local);
    return frame_.shows(r) ? std::optional(r) : std::nullopt;
  }

 private:
  struct Point {
    vec3 position{0.f}, normal{0.f};
    float density = 0.f;  // pdf_position
    EndpointPoint endpoint() const {
      EndpointPoint e;
      e.position = position;
      e.normal = normal;
      return e;
    }
    vec3 error() const { return glm::abs(position) * 0x1p-22f; }
  };
  static void check_extent(const Parameters& p, const char* name, float value, bool used) {
    if (!(value > 0.f)) p.fail(name, std::string("\"") + name + "\" must be positive");
    if (!used && p.has(name))
      p.fail(name, std::string("\"") + name + "\" is none of this surface's measures");
  }
  bool is_point() const { return surface_ == "point"; }

  void place(const Transform& transform, const dvec3& normal) {
    matrix_ = glm::dmat3(transform.matrix());
    to_camera_ = glm::inverse(matrix_);
    origin_ = transform.point(dvec3(0.0));
    determinant_ = std::abs(glm::determinant(matrix_));
    // x across the picture as far as the normal allows, y up.
    const dvec3 up = std::abs(normal.y) < 0.999 ? dvec3(0.0, 1.0, 0.0) : dvec3(0.0, 0.0, -1.0);
    const dvec3 x = glm::normalize(glm::cross(up, normal));
    axes_ = {x, glm::cross(normal, x), normal};
    if (surface_ == "rectangle") area_ = extent_.x * extent_.y;
    if (surface_ == "disk") area_ = std::numbers::pi * sqr(extent_.x);
    if (surface_ == "sphere") area_ = 4.0 * std::numbers::pi * sqr(extent_.x);
  }

  // The surface in its own axes: every map keeps areas.
  Point point(const dvec2& raster) const {
    const dvec2 uv = raster / size_;
    dvec3 local(0.0), normal(0.0, 0.0, 1.0);
    if (surface_ == "rectangle")
      local = dvec3((uv.x - 0.5) * extent_.x, (0.5 - uv.y) * extent_.y, 0.0);
    if (surface_ == "disk")
      local = dvec3(extent_.x * concentric_disk(dvec2(uv.x, 1.0 - uv.y)), 0.0);
    if (surface_ == "sphere") {
      normal = sphere_direction(uv);
      local = extent_.x * normal;
    }
    Point p;
    p.position = vec3(origin_ + matrix_ * (position_ + axes_ * local));
    p.normal = to_render_normal(normal);
    p.density = density(p.normal);
    return p;
  }
  // Beyond the poles the meridian goes on on the other side.
  static dvec3 sphere_direction(const dvec2& uv) {
    const double tile = std::floor(uv.y), v = uv.y - tile;
    const bool odd = std::fmod(std::abs(tile), 2.0) == 1.0;
    const double z = odd ? 2.0 * v - 1.0 : 1.0 - 2.0 * v;
    const double phi = 2.0 * std::numbers::pi * (uv.x + (odd ? 0.5 : 0.0));
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  dvec2 raster_of(const dvec3& local) const {
    if (surface_ == "rectangle")
      return dvec2(local.x / extent_.x + 0.5, 0.5 - local.y / extent_.y) * size_;
    if (surface_ == "disk") {
      const dvec2 square = disk_to_square(dvec2(local) / extent_.x);
      return dvec2(square.x, 1.0 - square.y) * size_;
    }
    if (surface_ == "sphere") {
      const dvec3 n = glm::normalize(local);
      const double turn = std::atan2(n.y, n.x) / (2.0 * std::numbers::pi);
      return dvec2(turn < 0.0 ? turn + 1.0 : turn, 0.5 - 0.5 * n.z) * size_;
    }
    return 0.5 * dvec2(frame_.crop_min + frame_.crop_max);
  }
  // The inverse of concentric_disk().
  static dvec2 disk_to_square(const dvec2& p) {
    const double r = glm::length(p), quarter = 0.25 * std::numbers::pi;
    if (r == 0.0) return dvec2(0.5);
    dvec2 q;
    if (std::abs(p.x) > std::abs(p.y)) {
      q.x = std::copysign(r, p.x);
      q.y = q.x * std::atan(p.y / p.x) / quarter;
    } else {
      q.y = std::copysign(r, p.y);
      q.x = q.y * std::atan(p.x / p.y) / quarter;
    }
    return 0.5 * (q + 1.0);
  }

  vec3 to_render_normal(const dvec3& n) const {
    return vec3(glm::normalize(glm::transpose(to_camera_) * (axes_ * n)));
  }
  // Of points by area [1/m^2], in render space at a point with this normal; a point's formal 1.
  // Areas grow by the determinant over the stretch of the normal.
  float density(const vec3& normal) const {
    if (is_point()) return 1.f;
    const double stretch = glm::length(glm::transpose(matrix_) * dvec3(normal));
    const double per_pixel = area_ * determinant_ / (stretch * size_.x * size_.y);
    return static_cast<float>(1.0 / (per_pixel * frame_.pixels()));
  }
  // Part of the raster positions that toward() draws from which lies in the window.
  float in_window() const {
    const dvec2 drawn = frame_.high() - frame_.low();
    return static_cast<float>(frame_.pixels() / (drawn.x * drawn.y));
  }
  static EmissionValue importance(float density, float cosine) {
    return {Rgb(density), cosine, density, cosine * inv_pi};
  }

  RasterFrame frame_;
  dvec2 size_;
  std::string surface_;
  dvec3 position_{0.0};
  dvec2 extent_{1.0};     // width and height, or the radius [m]
  double area_ = 1.0;     // [m^2], in the camera's space
  glm::dmat3 axes_{1.0};  // the surface's, in the camera's space
  glm::dmat3 matrix_{1.0}, to_camera_{1.0};
  double determinant_ = 1.0;
  dvec3 origin_{0.0};
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Camera, "irradiance", pssmlt::Irradiance)
