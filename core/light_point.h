// What lights at a point share whose intensity depends on the direction.
#pragma once

#include "core/light.h"

namespace pssmlt {

class PointEmitter : public Light {
 public:
  EndpointTraits traits() const final { return {.delta_position = true}; }

  std::optional<Emission> emit(const vec2&, const dvec2& u_direction) const final {
    const auto direction = sample_direction(u_direction);
    if (!direction) return std::nullopt;
    Emission e;
    e.from.position = position_;
    e.direction = *direction;
    e.value = intensity(e.direction);
    e.pdf_position = 1.f;
    e.pdf_direction = pdf_direction(e.direction);
    // Rounding may have moved the direction to where it is dark.
    if (!(e.pdf_direction > 0.f)) return std::nullopt;
    return e;
  }

  std::optional<Toward> toward(const vec3& reference, const vec2&) const final {
    const vec3 d = position_ - reference;
    Toward t;
    t.pdf_toward = length_squared(d);
    if (!(t.pdf_toward > 0.f)) return std::nullopt;
    t.distance = std::sqrt(t.pdf_toward);
    t.wi = d / t.distance;
    t.pdf_direction = pdf_direction(-t.wi);
    if (!(t.pdf_direction > 0.f)) return std::nullopt;
    t.at.position = position_;
    t.value = intensity(-t.wi);
    t.pdf_position = 1.f;
    return t;
  }

  std::optional<LightBounds> bounds() const final {
    LightBounds b;
    b.box.add(position_);
    b.normals = directions();
    b.cos_spread = 1.f;
    b.intensity = power() / (2.f * pi * (1.f - b.normals.cosine));
    return b;
  }

  EmissionValue evaluate(const EndpointPoint&, const vec3& direction) const final {
    return {intensity(direction), 1.f, 1.f, pdf_direction(direction)};
  }
  float pdf_toward(const vec3& reference, const EndpointPoint&) const final {
    const vec3 d = reference - position_;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0.f)) return 0.f;
    return pdf_direction(d / std::sqrt(distance2)) > 0.f ? distance2 : 0.f;
  }

 protected:
  // A direction away from the light, unit, in render space; nullopt if the light is black.
  virtual std::optional<vec3> sample_direction(const dvec2& u) const = 0;
  // Density of sample_direction [1/sr]; positive wherever the intensity is.
  virtual float pdf_direction(const vec3& direction) const = 0;
  virtual Rgb intensity(const vec3& direction) const = 0;  // [W/sr]
  // A cone around all directions that it shines in.
  virtual DirectionCone directions() const { return {}; }

  vec3 position_{0.f};  // in render space [m]
};

}  // namespace pssmlt
