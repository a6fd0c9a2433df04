// Triangle meshes: what all shapes that end as triangles share.
#pragma once

#include <atomic>
#include <mutex>

#include "core/base/distribution.h"
#include "core/scene/parameters.h"
#include "core/shape.h"
#include "core/shapes/facing_plane.h"

namespace pssmlt {

// A mesh in its own space, as files and formulas give it. Normals of length 0 stand for "none
// here".
struct MeshData {
  TriangleMesh mesh;
  std::vector<vec3> tangents;  // empty or one a vertex
};

class MeshShape : public Shape {
 public:
  // Takes `data` to render space by p's transform. Throws Error at p's place on indices out of
  // range, per-vertex arrays of the wrong length and values that are not finite. Triangles without
  // area are left out.
  MeshShape(MeshData data, const Parameters& p);

  const TriangleMesh* mesh() const final { return &mesh_; }
  Bounds bounds() const final;
  void fill(const vec2& where, Hit& hit) const final;
  float grain() const final { return grain_; }
  void refine(const dvec3& origin, const dvec3& direction, Hit& hit) const final;
  float area() const final { return area_; }
  float pdf_area(const SurfaceSample&) const final { return inverse_area_; }
  // Uniform over the surface: a triangle by its area, then a point in it.
  SurfaceSample sample_area(const vec2& u) const final;
  bool may_face(const vec3& reference) const final { return plane_.may_face(reference); }
  DirectionCone normals() const final;

 private:
  struct Corners {
    vec3 p0, p1, p2;
  };
  Corners corners(uint32_t triangle) const;
  // Geometric normal, unit; on the side of the shading normal `ns` where that is not zero.
  vec3 outside(uint32_t triangle, const vec3& ns) const;
  // Interpolated vertex normal, not normalised; zero if there is none.
  vec3 shading_normal(uint32_t triangle, const vec3& b) const;
  vec2 interpolated_uv(uint32_t triangle, const vec3& b) const;
  void set_derivatives(uint32_t triangle, const Corners& c, Hit& hit) const;
  void set_tangent(uint32_t triangle, const vec3& b, Hit& hit) const;
  void check(const MeshData& data, const Parameters& p) const;
  void transform(const Parameters& p);
  // Normals and areas of the triangles; leaves out those without area and returns their number.
  size_t measure();
  void find_plane();
  // Made when first asked for: only lights need it.
  const Distribution1D& areas() const;
  void make_areas() const;

  TriangleMesh mesh_;
  std::vector<vec3> tangents_;
  // Unit, one a triangle, outside by the order of the indices: kept because every hit needs one,
  // and slivers lose their direction unless it is found in double precision.
  std::vector<vec3> face_normals_;
  std::vector<float> sliver_errors_;  // [m], by triangle; empty if there are no slivers
  FacingPlane plane_;
  float area_ = 0.f, inverse_area_ = 0.f;  // [m^2], [1/m^2]; both 0 without triangles
  float grain_ = 0.f;                      // [m]
  bool flip_ = false;                      // the index order gives the inside
  mutable std::atomic<bool> areas_made_{false};
  mutable std::once_flag areas_once_;
  mutable Distribution1D areas_;
};

// Triangles of a list of indices, three each. Throws Error at the parameter `indices` if their
// number is not a multiple of three or one of them is negative.
std::vector<glm::uvec3> triangles_of(const std::vector<int>& indices, const Parameters& p);

}  // namespace pssmlt
