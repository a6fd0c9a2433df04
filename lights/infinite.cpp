// Light from all around: the same radiance from everywhere, or an image that surrounds the scene.
//
// Images are square equal-area maps of the sphere (Clarberg 2008, Fast Equal-Area Mapping of the
// (Hemi)Sphere Using SIMD), looked up without interpolation and sampled exactly in proportion to
// their luminance (Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.5).
// "illuminance" is what a horizontal surface (normal +z of the light's space) receives of constant
// light. Weak where a small part of the map is all that a closed room sees: no portals.
#include <vector>

#include "core/base/distribution.h"
#include "core/base/log.h"
#include "core/image/image.h"
#include "core/light_infinite.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// The direction of a point of the unit square (Clarberg 2008).
dvec3 square_to_sphere(const dvec2& uv) {
  const double x = 2.0 * uv.x - 1.0, y = 2.0 * uv.y - 1.0;
  const double signed_distance = 1.0 - (std::abs(x) + std::abs(y));
  const double r = 1.0 - std::abs(signed_distance);
  const double phi =
      r == 0.0 ? 0.0 : ((std::abs(y) - std::abs(x)) / r + 1.0) * (0.25 * std::numbers::pi);
  const double radial = r * std::sqrt(std::max(0.0, 2.0 - r * r));
  return {std::copysign(std::cos(phi), x) * radial, std::copysign(std::sin(phi), y) * radial,
          std::copysign(1.0 - r * r, signed_distance)};
}

// Its inverse, for unit directions.
dvec2 sphere_to_square(const dvec3& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  // sqrt(1 - z) without cancellation near the poles.
  const double r = std::sqrt((x * x + y * y) / (1.0 + z));
  const double phi = std::atan2(y, x) * (2.0 / std::numbers::pi);
  dvec2 q{r - phi * r, phi * r};
  if (d.z < 0.0) q = {1.0 - q.y, 1.0 - q.x};
  return 0.5 * (dvec2(std::copysign(q.x, d.x), std::copysign(q.y, d.y)) + 1.0);
}

class InfiniteLight final : public Light {
 public:
  static constexpr const char* summary = "Light from all around, constant or an image";

  explicit InfiniteLight(Parameters& p) {
    const bool has_radiance = p.has("L");
    radiance_ = p.rgb("L", Rgb(1.f), SpectrumUse::Illuminant, "W/(m^2 sr)", "Constant radiance.");
    const float scale = p.number("scale", 1.f, "", "Factor of the radiance.");
    const std::string file = p.file("filename", "Image of radiance, a square equal-area map.");
    const float illuminance = p.number("illuminance", -1.f, "W/m^2",
                                       "What the horizon's upper side gives; negative: as is.");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (p.has("portal")) p.fail("portal", "portals are not supported yet");
    if (p.describing()) return;
    if (has_radiance && !file.empty())
      p.fail("filename", "\"filename\" cannot be given together with \"L\"");
    const glm::dmat3 m(p.transform().matrix());
    to_render_ = m;
    to_light_ = glm::inverse(m);
    determinant_ = std::abs(glm::determinant(to_light_));
    if (!file.empty()) load(p, file);
    radiance_ *= scale;
    if (illuminance > 0.f) radiance_ *= illuminance / natural_illuminance(p);
  }

  EndpointTraits traits() const override { return {.infinite = true}; }
  void prepare(const SceneBounds& bounds) override { disk_.set(bounds); }
  float power() const override {
    return 4.f * pi * disk_.area() * luminance(radiance_) * mean_luminance_;
  }

  std::optional<Emission> emit(const vec2& u_position, const dvec2& u_direction) const override {
    const auto d = sample_direction(u_direction);
    if (!d) return std::nullopt;
    Emission e;
    e.direction = -d->toward;
    e.from = disk_.sample(e.direction, u_position);
    e.value = background(d->toward);
    e.pdf_position = disk_.pdf();
    e.pdf_direction = d->pdf;
    return e;
  }
  std::optional<Toward> toward(const vec3&, const vec2& u) const override {
    const auto d = sample_direction(dvec2(u));
    if (!d) return std::nullopt;
    Toward t;
    t.at.normal = -d->toward;
    t.wi = d->toward;
    t.distance = infinity;
    t.value = background(d->toward);
    t.pdf_toward = t.pdf_direction = d->pdf;
    t.pdf_position = disk_.pdf();
    return t;
  }
  EmissionValue evaluate(const EndpointPoint&, const vec3& direction) const override {
    return {background(-direction), 1.f, disk_.pdf(), pdf(-direction)};
  }
  float pdf_toward(const vec3&, const EndpointPoint& at) const override { return pdf(-at.normal); }

  Rgb background(const vec3& direction) const override {
    if (size_ == 0) return radiance_;
    const dvec2 uv = sphere_to_square(glm::normalize(to_light_ * dvec3(direction)));
    const int x = std::clamp(static_cast<int>(uv.x * size_), 0, size_ - 1);
    const int y = std::clamp(static_cast<int>(uv.y * size_), 0, size_ - 1);
    return radiance_ *
           pixels_[static_cast<size_t>(y) * static_cast<size_t>(size_) + static_cast<size_t>(x)];
  }

 private:
  struct Direction {
    vec3 toward;  // the light, unit
    float pdf;    // [1/sr]
  };

  static Image read(const Parameters& p, const std::string& file) {
    try {
      return read_image(file, "");
    } catch (const Error& e) {
      p.fail("filename", e.what());
    }
  }
  void load(const Parameters& p, const std::string& file) {
    const Image image = read(p, file);
    if (image.width != image.height)
      p.fail("filename", "'" + file + "' has " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) +
                             " pixels: environment maps must be square equal-area maps (maps of "
                             "latitude and longitude have to be converted first)");
    if (image.width == 0) p.fail("filename", "'" + file + "' is empty");
    size_ = image.width;
    const size_t count = static_cast<size_t>(size_) * static_cast<size_t>(size_);
    const size_t channels = static_cast<size_t>(image.channels);
    pixels_.resize(count);
    std::vector<float> weights(count);
    size_t clipped = 0;
    for (size_t i = 0; i < count; ++i) {
      const float* const c = &image.data[i * channels];
      const Rgb value = channels < 3 ? Rgb(c[0]) : Rgb(c[0], c[1], c[2]);
      if (!is_finite(value))
        p.fail("filename", "'" + file + "' has pixels that are not finite numbers");
      pixels_[i] = glm::max(value, Rgb(0.f));
      clipped += pixels_[i] != value;
      weights[i] = luminance(pixels_[i]);
    }
    if (clipped != 0)
      log_warning("'" + file + "': " + std::to_string(clipped) +
                  " pixels with negative components were clipped to 0");
    distribution_ = Distribution2D(weights, size_, size_);
    mean_luminance_ = static_cast<float>(distribution_.sum() / static_cast<double>(count));
  }

  // Illuminance [W/m^2] of the light of scale 1. For images pbrt-v4 sums the upper hemisphere with
  // half the solid angle of each pixel; scenes made for it count on that.
  float natural_illuminance(const Parameters& p) const {
    if (size_ == 0) return pi;
    double sum = 0.0;
    for (int y = 0; y < size_; ++y)
      for (int x = 0; x < size_; ++x) {
        const double z = square_to_sphere({(x + 0.5) / size_, (y + 0.5) / size_}).z;
        const size_t i =
            static_cast<size_t>(y) * static_cast<size_t>(size_) + static_cast<size_t>(x);
        if (z > 0.0) sum += z * static_cast<double>(luminance(pixels_[i]));
      }
    if (!(sum > 0.0)) p.fail("illuminance", "the image's upper hemisphere is black");
    return static_cast<float>(sum * 2.0 * std::numbers::pi / size_ / size_);
  }

  // Proportional to luminance; over the whole sphere for constant light.
  std::optional<Direction> sample_direction(const dvec2& u) const {
    if (size_ == 0) return Direction{uniform_sphere(to_float_below_one(u)), 0.25f * inv_pi};
    if (!(distribution_.sum() > 0.0)) return std::nullopt;
    const auto point = distribution_.sample(u);
    const vec3 toward(glm::normalize(to_render_ * square_to_sphere(point.uv)));
    // Rounding may have moved the direction into the next pixel: value and density are those there.
    const float density = pdf(toward);
    if (!(density > 0.f)) return std::nullopt;
    return Direction{toward, density};
  }
  // Density of sample_direction [1/sr].
  float pdf(const vec3& toward) const {
    if (size_ == 0) return 0.25f * inv_pi;
    const dvec3 d = to_light_ * dvec3(toward);
    const double length = glm::length(d);
    // Solid angle in the light's space over that in render space: 1 for rotations.
    const double stretch = determinant_ / (length * length * length);
    return static_cast<float>(distribution_.pdf(sphere_to_square(d / length)) * stretch *
                              (0.25 * std::numbers::inv_pi));
  }

  EntryDisk disk_;
  glm::dmat3 to_render_{1.0}, to_light_{1.0};
  double determinant_ = 1.0;  // of to_light_
  Rgb radiance_{1.f};         // [W/(m^2 sr)], or the image's factor
  int size_ = 0;              // of the image [pixels]; 0: constant
  std::vector<Rgb> pixels_;
  Distribution2D distribution_;
  float mean_luminance_ = 1.f;  // of the image
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "infinite", pssmlt::InfiniteLight)
