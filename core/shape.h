// Shapes: geometry for the ray tracer and area sampling for lights. All in the space that the
// constructor's transform leads to (render space, or an object's own space for instances).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/bounds.h"
#include "core/base/cone.h"
#include "core/base/ray.h"
#include "core/base/rgb.h"
#include "core/hit.h"

namespace pssmlt {

// Triangles with optional per-vertex data; index order gives the outside (right hand rule).
struct TriangleMesh {
  std::vector<vec3> positions;  // [m]
  std::vector<vec3> normals;    // empty or one a vertex, unit
  std::vector<vec2> uvs;        // empty or one a vertex
  std::vector<glm::uvec3> triangles;
  // What textures may ask for (core/vertex_data.h); each empty or one a vertex.
  std::vector<vec2> second_uvs;
  std::vector<Rgb> colors;
  std::vector<float> opacities;
};

// Where a ray meets a user geometry: distance, the shape's own two coordinates there (`where` of
// fill) and hit.element.
struct UserHit {
  float t = 0.f;
  vec2 uv{0.f};
  uint32_t element = 0;
};

// A sampled point of the surface.
struct SurfaceSample {
  vec3 position{0.f}, error{0.f}, normal{0.f};  // normal: unit, geometric, outside
  vec2 uv{0.f};
  uint32_t element = 0;
  float pdf = 0.f;  // sample_area: [1/m^2]; sample_toward: [1/sr] at the reference
};

class Shape {
 public:
  virtual ~Shape() = default;
  // The mesh if the shape is one; then intersection is the ray tracer's own and `fill` gets the
  // triangle and its barycentric coordinates (weights of the second and third vertex).
  virtual const TriangleMesh* mesh() const { return nullptr; }
  virtual Bounds bounds() const = 0;
  // User geometry only: nearest intersection with t in (t_min, ray.t_max).
  virtual std::optional<UserHit> intersect(const Ray& ray, float t_min) const {
    (void)ray, (void)t_min;
    return std::nullopt;
  }
  // Completes position, error, ng, ns, dpdu, dpdv, dndu, dndv, uv of hit.element at `where`; the
  // derivatives only if hit.with_derivatives, else they may be left zero.
  // Positions are recomputed from the surface's own parameters, not from the ray. Sides (ng, ns)
  // already follow ReverseOrientation and mirroring transforms.
  virtual void fill(const vec2& where, Hit& hit) const = 0;
  // How far the rounding of `where` may move a point along the surface [m]; 0 if it does not.
  virtual float grain() const { return 0.f; }
  // Called after fill() where rays are so short that the grain matters: finds position, distance,
  // where and uv of hit.element anew from the ray, in double precision. origin and direction: in
  // the shape's space; distances are in units of direction's length.
  virtual void refine(const dvec3& origin, const dvec3& direction, Hit& hit) const {
    (void)origin, (void)direction, (void)hit;
  }

  // Surface area [m^2].
  virtual float area() const = 0;
  // A point of the surface, density 1/area unless said otherwise in .pdf [1/m^2].
  virtual SurfaceSample sample_area(const vec2& u) const = 0;
  // A point as seen from a reference, .pdf in [1/sr]; the default converts sample_area. nullopt
  // where the point is seen edge-on or from inside its own plane.
  virtual std::optional<SurfaceSample> sample_toward(const vec3& reference, const vec2& u) const;
  // False only if the outside of no point faces `reference`, so that a lamp that is dark inside
  // need not draw a point in vain.
  virtual bool may_face(const vec3& reference) const {
    (void)reference;
    return true;
  }
  // A cone around the geometric normals of all its points; all directions unless better is known.
  virtual DirectionCone normals() const { return {}; }
  // Densities of sample_area [1/m^2] and of sample_toward [1/sr at the reference] at a point of
  // this surface, of which position, normal, uv and element are read. The defaults: 1 / area, and
  // its conversion.
  virtual float pdf_area(const SurfaceSample& at) const;
  virtual float pdf_toward(const vec3& reference, const SurfaceSample& at) const;
};

// Density per area to density per solid angle at `reference` [1/m^2 -> 1/sr]; 0 if edge-on.
float area_to_solid_angle(float pdf_area, const vec3& reference, const vec3& position,
                          const vec3& normal);

}  // namespace pssmlt
