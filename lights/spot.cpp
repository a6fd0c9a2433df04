// A point that emits into a cone: full intensity inside, a smooth step down to nothing at its edge.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.2.1. Directions are
// sampled exactly in proportion to the intensity. "power" is what the whole cone emits and replaces
// the magnitude of I. Blind spot: rays never meet it, so only connections find it.
#include <glm/trigonometric.hpp>

#include "core/base/frame.h"
#include "core/base/warp.h"
#include "core/light.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

// 3 t^2 - 2 t^3 for t in [0,1], clamped outside.
float smooth_step(float t) {
  t = std::fmin(std::fmax(t, 0.f), 1.f);
  return t * t * (3.f - 2.f * t);
}

// Inverse of 2 t^3 - t^4, the distribution function of the density 2 smooth_step(t) on [0,1], by
// Newton's method kept inside a shrinking bracket.
double invert_smooth_step(double u) {
  double low = 0.0, high = 1.0, t = std::cbrt(0.5 * u);
  for (int i = 0; i < 32; ++i) {
    const double f = t * t * t * (2.0 - t) - u;
    if (std::abs(f) < 1e-14) break;
    (f < 0.0 ? low : high) = t;
    const double slope = t * t * (6.0 - 4.0 * t);
    const double next = slope > 0.0 ? t - f / slope : low;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

class SpotLight final : public Light {
 public:
  static constexpr const char* summary = "Point that emits into a cone with a soft edge";

  explicit SpotLight(Parameters& p) {
    intensity_ = p.rgb("I", Rgb(1.f), SpectrumUse::Illuminant, "W/sr", "Intensity in the centre.");
    const float scale = p.number("scale", 1.f, "", "Factor of the intensity.");
    const float power = p.number("power", -1.f, "W", "Total emitted power; negative: from I.");
    const vec3 from = p.point("from", vec3(0.f), "m", "Position.");
    const vec3 to = p.point("to", vec3(0.f, 0.f, 1.f), "m", "A point on the axis.");
    const float angle = p.number("coneangle", 30.f, "degrees", "From the axis to the dark.");
    const float delta = p.number("conedeltaangle", 5.f, "degrees", "Width of the soft edge.");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (!(angle > 0.f && angle <= 180.f))
      p.fail("coneangle", "\"coneangle\" must be in (0, 180] degrees");
    if (!(delta >= 0.f && delta <= angle))
      p.fail("conedeltaangle", "\"conedeltaangle\" must lie between 0 and coneangle");
    if (p.describing()) return;
    cos_end_ = std::cos(glm::radians(static_cast<double>(angle)));
    cos_start_ = std::cos(glm::radians(static_cast<double>(angle) - static_cast<double>(delta)));
    place(p, from, to);
    intensity_ *= scale;
    if (power > 0.f) intensity_ *= power / solid_angle();
  }

  EndpointTraits traits() const override { return {.delta_position = true}; }
  float power() const override { return solid_angle() * luminance(intensity_); }
  std::optional<LightBounds> bounds() const override {
    LightBounds b;
    b.box.add(position_);
    b.normals = {frame_.n, static_cast<float>(cos_end_)};
    b.cos_spread = 1.f;
    b.intensity = luminance(intensity_);
    return b;
  }

  std::optional<Emission> emit(const vec2&, const dvec2& u_direction) const override {
    const float z = sample_height(u_direction.x);
    const vec3 local = direction_at_height(z, static_cast<float>(u_direction.y));
    Emission e;
    e.from.position = position_;
    e.direction = glm::normalize(frame_.to_world(local));
    const float f = falloff(glm::dot(e.direction, frame_.n));
    if (!(f > 0.f)) return std::nullopt;
    e.value = f * intensity_;
    e.pdf_position = 1.f;
    e.pdf_direction = f / solid_angle();
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2&) const override {
    const vec3 d = position_ - reference;
    Toward t;
    t.pdf_toward = length_squared(d);
    if (!(t.pdf_toward > 0.f)) return std::nullopt;
    t.distance = std::sqrt(t.pdf_toward);
    t.wi = d / t.distance;
    const float f = falloff(-glm::dot(t.wi, frame_.n));
    if (!(f > 0.f)) return std::nullopt;
    t.at.position = position_;
    t.value = f * intensity_;
    t.pdf_position = 1.f;
    t.pdf_direction = f / solid_angle();
    return t;
  }

  EmissionValue evaluate(const EndpointPoint&, const vec3& direction) const override {
    const float f = falloff(glm::dot(direction, frame_.n));
    return {f * intensity_, 1.f, 1.f, f / solid_angle()};
  }
  float pdf_toward(const vec3& reference, const EndpointPoint&) const override {
    const vec3 d = position_ - reference;
    return falloff(-glm::dot(glm::normalize(d), frame_.n)) > 0.f ? length_squared(d) : 0.f;
  }

 private:
  void place(const Parameters& p, const vec3& from, const vec3& to) {
    const dvec3 position = p.transform().point(dvec3(from));
    const dvec3 axis = p.transform().point(dvec3(to)) - position;
    if (!(glm::length(axis) > 0.0)) p.fail("to", "\"to\" must differ from the light's position");
    position_ = vec3(position);
    frame_ = Frame(vec3(glm::normalize(axis)));
  }
  // Intensity relative to the axis.
  float falloff(float cosine) const {
    if (!(cosine > static_cast<float>(cos_end_))) return 0.f;
    if (cosine >= static_cast<float>(cos_start_)) return 1.f;
    return smooth_step(
        static_cast<float>((static_cast<double>(cosine) - cos_end_) / (cos_start_ - cos_end_)));
  }
  // Integral of falloff over the sphere [sr].
  float solid_angle() const {
    return static_cast<float>(2.0 * std::numbers::pi * (core() + edge()));
  }
  double core() const { return 1.0 - cos_start_; }
  double edge() const { return 0.5 * (cos_start_ - cos_end_); }
  // Cosine with the axis, density proportional to falloff.
  float sample_height(double u) const {
    const double x = u * (core() + edge());
    if (x < edge())
      return static_cast<float>(cos_end_ +
                                (cos_start_ - cos_end_) * invert_smooth_step(x / edge()));
    return static_cast<float>(cos_start_ + (x - edge()));
  }

  vec3 position_{0.f};
  Frame frame_;         // n: axis
  Rgb intensity_{0.f};  // on the axis [W/sr]
  double cos_end_ = 0.0, cos_start_ = 0.0;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "spot", pssmlt::SpotLight)
