#include "core/shape.h"

namespace pssmlt {

float area_to_solid_angle(float pdf_area, const vec3& reference, const vec3& position,
                          const vec3& normal) {
  const vec3 d = position - reference;
  const float distance2 = length_squared(d);
  if (!(distance2 > 0.f)) return 0.f;
  const float cosine = std::abs(glm::dot(normal, d)) / std::sqrt(distance2);
  if (!(cosine > 0.f)) return 0.f;
  const float pdf = pdf_area * distance2 / cosine;
  return std::isfinite(pdf) ? pdf : 0.f;
}

std::optional<SurfaceSample> Shape::sample_toward(const vec3& reference, const vec2& u) const {
  SurfaceSample s = sample_area(u);
  s.pdf = area_to_solid_angle(s.pdf, reference, s.position, s.normal);
  if (!(s.pdf > 0.f)) return std::nullopt;
  return s;
}

float Shape::pdf_area(const SurfaceSample&) const {
  const float a = area();
  return a > 0.f ? 1.f / a : 0.f;
}

float Shape::pdf_toward(const vec3& reference, const SurfaceSample& at) const {
  return area_to_solid_angle(pdf_area(at), reference, at.position, at.normal);
}

}  // namespace pssmlt
