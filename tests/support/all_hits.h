// Every intersection of a ray with a shape, without the ray tracer.
#pragma once

#include <algorithm>
#include <vector>

#include "core/shape.h"

namespace pssmlt::test {

// Hits in ascending order of distance, completed by fill().
inline std::vector<Hit> all_hits(const Shape& shape, const Ray& ray) {
  std::vector<Hit> hits;
  const auto add = [&](const vec2& where, uint32_t element) {
    Hit hit;
    hit.element = element;
    shape.fill(where, hit);
    hit.distance = glm::distance(hit.position, ray.origin);
    hits.push_back(hit);
  };
  if (const TriangleMesh* const mesh = shape.mesh()) {
    const dvec3 o(ray.origin), d(ray.direction);
    for (uint32_t i = 0; i < mesh->triangles.size(); ++i) {
      const glm::uvec3& t = mesh->triangles[i];
      const dvec3 p0(mesh->positions[t.x]), e1 = dvec3(mesh->positions[t.y]) - p0;
      const dvec3 e2 = dvec3(mesh->positions[t.z]) - p0;
      const dvec3 n = glm::cross(d, e2);
      const double determinant = glm::dot(e1, n);
      if (determinant == 0.0) continue;
      const double u = glm::dot(o - p0, n) / determinant;
      const dvec3 q = glm::cross(o - p0, e1);
      const double v = glm::dot(d, q) / determinant;
      if (u < 0.0 || v < 0.0 || u + v > 1.0 || glm::dot(e2, q) / determinant <= 0.0) continue;
      add({static_cast<float>(u), static_cast<float>(v)}, i);
    }
  } else {
    float t_min = 0.f;
    while (const auto hit = shape.intersect(ray, t_min)) {
      add(hit->uv, hit->element);
      t_min = hit->t * (1.f + 1e-5f);
    }
  }
  std::ranges::sort(hits, {}, &Hit::distance);
  return hits;
}

// The point of a hit as densities want it.
inline SurfaceSample point_of(const Hit& hit) {
  return {.position = hit.position, .normal = hit.ng, .uv = hit.uv, .element = hit.element};
}

}  // namespace pssmlt::test
