// A point that emits the same intensity in all directions.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.2. "power" is the
// luminous flux of the light's white [lm] (or the radiant one [W], whichever the scene counts in)
// and replaces the magnitude of I. Blind spot: rays never meet it, so only connections find it.
#include "core/base/warp.h"
#include "core/light.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class PointLight final : public Light {
 public:
  static constexpr const char* summary = "Point with the same intensity in all directions";

  explicit PointLight(Parameters& p) {
    intensity_ = p.rgb("I", Rgb(1.f), SpectrumUse::Illuminant, "W/sr", "Intensity.");
    const float scale = p.number("scale", 1.f, "", "Factor of the intensity.");
    const float power = p.number("power", -1.f, "W", "Total emitted power; negative: from I.");
    const vec3 from = p.point("from", vec3(0.f), "m", "Position.");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (p.describing()) return;
    intensity_ *= scale;
    if (power > 0.f) intensity_ *= power / (4.f * pi);
    position_ = p.transform().point(from);
  }

  EndpointTraits traits() const override { return {.delta_position = true}; }
  float power() const override { return 4.f * pi * luminance(intensity_); }
  std::optional<LightBounds> bounds() const override {
    LightBounds b;
    b.box.add(position_);
    b.intensity = luminance(intensity_);
    return b;
  }

  std::optional<Emission> emit(const vec2&, const dvec2& u_direction) const override {
    Emission e;
    e.from.position = position_;
    e.direction = uniform_sphere(to_float_below_one(u_direction));
    e.value = intensity_;
    e.pdf_position = 1.f;
    e.pdf_direction = pdf_direction;
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2&) const override {
    const vec3 d = position_ - reference;
    Toward t;
    t.pdf_toward = length_squared(d);
    if (!(t.pdf_toward > 0.f)) return std::nullopt;
    t.at.position = position_;
    t.distance = std::sqrt(t.pdf_toward);
    t.wi = d / t.distance;
    t.value = intensity_;
    t.pdf_position = 1.f;
    t.pdf_direction = pdf_direction;
    return t;
  }

  EmissionValue evaluate(const EndpointPoint&, const vec3&) const override {
    return {intensity_, 1.f, 1.f, pdf_direction};
  }
  float pdf_toward(const vec3& reference, const EndpointPoint&) const override {
    return length_squared(position_ - reference);
  }

 private:
  static constexpr float pdf_direction = 0.25f * inv_pi;  // [1/sr]
  vec3 position_{0.f};
  Rgb intensity_{0.f};  // [W/sr]
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "point", pssmlt::PointLight)
