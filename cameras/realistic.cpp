// Camera with a lens system: rays go from the film through every surface of a table of lenses, so
// that depth of field, vignetting, distortion and the shape of the stop are those of the system.
//
// Source: Kolb, Mitchell and Hanrahan 1995, "A Realistic Camera Model for Computer Graphics";
// Pharr, Jakob and Humphreys 2016, Physically Based Rendering, third edition, section 6.4. Pixels
// hold the irradiance at the film. A connection from the scene aims at the disk in front of the
// lenses and is followed to the film. Film and scene lie in air, where dA cos(theta) d(omega) of a
// beam is the same before and behind the lenses (conservation of etendue): that gives the densities
// in front from those at the film. Blind to reflections inside the lenses and to dispersion.
#include <glm/matrix.hpp>

#include "core/base/log.h"
#include "core/base/warp.h"
#include "core/camera_screen.h"
#include "core/lens/exit_pupil.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Realistic final : public Camera {
 public:
  static constexpr const char* summary = "Film behind the lenses of a photographic lens system";

  Realistic(Parameters& p, const RasterFrame& frame);

  EndpointTraits traits() const override { return {}; }
  vec3 center() const override { return to_render({0.0, 0.0, front_}); }
  float pixel_spread() const override {
    return static_cast<float>(std::sqrt(pixel_.x * pixel_.y) / image_distance_);
  }
  bool measures_irradiance() const override { return true; }

  std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const override {
    const dvec2 film = half_ * dvec2(1.0, -1.0) + pixel_ * dvec2(-u_direction.x, u_direction.y);
    if (pupil_->area(film) == 0.0) return std::nullopt;
    LensRay ray;
    ray.origin = dvec3(film, 0.0);
    const dvec3 pupil(pupil_->sample(film, dvec2(u_position)), lens_->rear().z);
    ray.direction = glm::normalize(pupil - ray.origin);
    Beam beam{ray.direction.z, pupil_->area(film), lens_->from_film(ray)};
    if (!(beam.through > 0.0)) return std::nullopt;
    const dvec3 front = ray.at_height(front_);
    if (glm::length(dvec2(front)) > pupil_->front_radius()) return std::nullopt;
    Emission e;
    e.from.position = to_render(front);
    e.from.normal = normal_;
    e.direction = vec3(glm::normalize(matrix_ * ray.direction));
    const EmissionValue v = importance(beam, ray.direction);
    e.value = v.value;
    e.cosine = v.cosine;
    e.pdf_position = v.pdf_position;
    e.pdf_direction = v.pdf_direction;
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2& u) const override {
    const dvec2 disk = pupil_->front_radius() * concentric_disk(dvec2(u));
    Toward t;
    t.at.position = to_render({disk, front_});
    t.at.normal = normal_;
    const vec3 d = t.at.position - reference;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f)) return std::nullopt;
    t.distance = std::sqrt(distance2);
    t.wi = d / t.distance;
    const auto seen = follow(t.at.position, -t.wi);
    if (!seen) return std::nullopt;
    t.raster = seen->raster;
    const EmissionValue v = importance(seen->beam, seen->direction);
    t.value = v.value;
    t.cosine = v.cosine;
    t.pdf_position = v.pdf_position;
    t.pdf_direction = v.pdf_direction;
    t.pdf_toward = pdf_position_ * distance2 / v.cosine;
    return t;
  }

  EmissionValue evaluate(const EndpointPoint& at, const vec3& direction) const override {
    const auto seen = follow(at.position, direction);
    if (seen) return importance(seen->beam, seen->direction);
    return {Rgb(0.f), std::abs(glm::dot(normal_, direction)), pdf_position_, 0.f};
  }

  float pdf_toward(const vec3& reference, const EndpointPoint& at) const override {
    const vec3 d = reference - at.position;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f)) return 0.f;
    const vec3 direction = d / std::sqrt(distance2);
    if (!follow(at.position, direction)) return 0.f;
    return pdf_position_ * distance2 / std::abs(glm::dot(normal_, direction));
  }

  std::optional<dvec2> raster(const vec3& at, const vec3& direction) const override {
    const auto seen = follow(at, direction);
    return seen ? std::optional(seen->raster) : std::nullopt;
  }

 private:
  // A ray between film and last surface.
  struct Beam {
    double cosine = 1.0;      // at the film
    double pupil_area = 0.0;  // of the exit pupil's box for the film point [m^2]
    double through = 0.0;     // what the stops let through [1]
  };
  struct Seen {
    dvec2 raster{0.0};
    dvec3 direction{0.0};  // away from the camera, in its space
    Beam beam;
  };
  void read_lens(Parameters& p);
  void place(const Transform& transform);
  vec3 to_render(const dvec3& p) const { return vec3(origin_ + matrix_ * p); }

  // Follows what arrives at a point of the front disk from `direction` to the film; nullopt if it
  // does not get there or lands outside of the window.
  std::optional<Seen> follow(const vec3& at, const vec3& direction) const {
    Seen seen;
    seen.direction = glm::normalize(inverse_ * dvec3(direction));
    if (!(seen.direction.z > 0.0)) return std::nullopt;
    LensRay ray;
    ray.origin = inverse_ * (dvec3(at) - origin_);
    ray.direction = -seen.direction;
    seen.beam.through = lens_->from_scene(ray);
    if (!(seen.beam.through > 0.0)) return std::nullopt;
    const dvec2 film(ray.at_height(0.0));
    if (!pupil_->contains(film, dvec2(ray.at_height(lens_->rear().z)))) return std::nullopt;
    seen.raster = (film - half_ * dvec2(1.0, -1.0)) / pixel_ * dvec2(-1.0, 1.0);
    if (!frame_.shows(seen.raster)) return std::nullopt;
    seen.beam.cosine = -ray.direction.z;
    seen.beam.pupil_area = pupil_->area(film);
    return seen;
  }

  // Importance and densities in front of the lenses, of a ray along `d` (unit, the camera's space).
  // At the film importance is that of irradiance: 1 / (area of the window), where light gets
  // through. Rays have there the density 1 / (area of the window, area of the pupil's box), which
  // is z^2 / cos^3 as much by solid angle.
  EmissionValue importance(const Beam& beam, const dvec3& d) const {
    const double per_area = 1.0 / (pixel_.x * pixel_.y * frame_.pixels());
    const double z = lens_->rear().z, c = beam.cosine;
    const double at_film = per_area * z * z / (c * c * c * beam.pupil_area);
    // Any affine map: areas of the front plane grow by area_scale_, solid angles by the rest.
    const double length = glm::length(matrix_ * d);
    const double angle_scale = determinant_ / (length * length * length);
    const double scale = area_scale_ * angle_scale;
    const double cosine = determinant_ * d.z / (area_scale_ * length);
    EmissionValue v;
    v.cosine = static_cast<float>(cosine);
    v.pdf_position = pdf_position_;
    v.pdf_direction =
        static_cast<float>(at_film * d.z / (c * scale * static_cast<double>(pdf_position_)));
    v.value = Rgb(static_cast<float>(per_area * beam.through * d.z / (scale * cosine)));
    return v;
  }

  RasterFrame frame_;
  dvec2 pixel_{1.0}, half_{0.5};  // of a pixel, and half the film [m]
  std::unique_ptr<LensSystem> lens_;
  std::unique_ptr<const ExitPupil> pupil_;
  double front_ = 0.0;           // z of the plane where rays start [m]
  double image_distance_ = 1.0;  // from the thick lens to the film [m]
  glm::dmat3 matrix_{1.0}, inverse_{1.0};
  dvec3 origin_{0.0};           // centre of the film
  vec3 normal_{0.f, 0.f, 1.f};  // of the front plane, toward the scene
  double determinant_ = 1.0, area_scale_ = 1.0;
  float pdf_position_ = 1.f;  // of the disk in the front plane [1/m^2]
};

Realistic::Realistic(Parameters& p, const RasterFrame& frame) : frame_(frame) {
  read_shutter(p);
  read_lens(p);
  if (p.describing()) return;
  const dvec2 resolution(frame.resolution);
  const double diagonal = 1e-3 * static_cast<double>(frame.diagonal);
  half_ = 0.5 * diagonal * resolution / glm::length(resolution);
  pixel_ = 2.0 * half_ / resolution;
  pupil_ = std::make_unique<const ExitPupil>(*lens_, 0.5 * diagonal);
  if (pupil_->empty()) p.fail("lensfile", "no light gets through the lenses to the film's centre");
  front_ = lens_->front_plane();
  image_distance_ = lens_->thick_lens().film_plane;
  place(p.transform());
}

void Realistic::read_lens(Parameters& p) {
  const std::string file = p.file(
      "lensfile",
      "Rows from the scene to the film: radius of curvature [mm; 0: stop], distance to the next "
      "surface [mm], refractive index behind it, diameter [mm].");
  const double diameter = static_cast<double>(
      p.number("aperturediameter", 1.f, "mm", "Diameter of the stop, at most the file's."));
  const double distance = static_cast<double>(
      p.number("focusdistance", 10.f, "m", "From the film to the plane in focus."));
  const std::string shape =
      p.text("aperture", "circular",
             "Shape of the stop: circular, gaussian, square, pentagon, star, or an image file.");
  if (p.describing()) return;
  if (file.empty()) p.fail("camera \"realistic\" needs a \"lensfile\"");
  if (!(diameter > 0.0)) p.fail("aperturediameter", "\"aperturediameter\" must be positive");
  if (!(distance > 0.0)) p.fail("focusdistance", "\"focusdistance\" must be positive");
  LensFile table = read_lens_file(file);
  for (const char* name : {"aperturediameter", "aperture"})
    if (p.has(name) && !table.has_stop)
      p.fail(name, "the lens file has no stop (a row of radius 0)");
  for (LensSurface& s : table.surfaces) {
    if (!s.is_stop()) continue;
    if (diameter > 2e3 * s.opening)
      log_warning("camera \"realistic\": the stop opens to the lens file's diameter only");
    s.opening = std::min(s.opening, 0.5e-3 * diameter);
  }
  const auto built_in = Aperture::built_in(shape);
  const Aperture aperture =
      built_in ? *built_in
               : Aperture::from_image(p.file("aperture", "An image, by its mean colour."));
  lens_ = std::make_unique<LensSystem>(std::move(table.surfaces), table.film_distance, aperture);
  if (!lens_->focus(distance))
    p.fail("focusdistance", "the lenses cannot be focused at this distance");
}

void Realistic::place(const Transform& transform) {
  matrix_ = glm::dmat3(transform.matrix());
  inverse_ = glm::inverse(matrix_);
  origin_ = transform.point(dvec3(0.0));
  determinant_ = std::abs(glm::determinant(matrix_));
  const dvec3 n = glm::cross(matrix_[0], matrix_[1]);
  area_scale_ = glm::length(n);
  normal_ = vec3(glm::normalize(glm::dot(n, matrix_[2]) < 0.0 ? -n : n));
  const double radius = pupil_->front_radius();
  pdf_position_ = static_cast<float>(1.0 / (std::numbers::pi * radius * radius * area_scale_));
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Camera, "realistic", pssmlt::Realistic)
