#include "core/vertex_data.h"

#include "core/scene/scene.h"

namespace pssmlt {
namespace {

template <typename T>
T interpolated(const Hit& hit, std::vector<T> TriangleMesh::*values, const T& fallback) {
  const TriangleMesh* const mesh = hit.primitive ? hit.primitive->shape->mesh() : nullptr;
  if (!mesh || (mesh->*values).empty()) return fallback;
  const std::vector<T>& v = mesh->*values;
  const glm::uvec3& t = mesh->triangles[hit.element];
  const float first = 1.f - hit.where.x - hit.where.y;
  return first * v[t.x] + hit.where.x * v[t.y] + hit.where.y * v[t.z];
}

}  // namespace

vec2 second_uv(const Hit& hit) { return interpolated(hit, &TriangleMesh::second_uvs, hit.uv); }
Rgb vertex_color(const Hit& hit) { return interpolated(hit, &TriangleMesh::colors, Rgb(1.f)); }
float vertex_opacity(const Hit& hit) { return interpolated(hit, &TriangleMesh::opacities, 1.f); }

}  // namespace pssmlt
