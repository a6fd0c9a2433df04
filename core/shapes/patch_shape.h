// Bilinear patches as they are, curved or planar.
//
// Source: A. Reshetov 2019, Cool Patches: A Geometric Approach to Ray/Bilinear Patch Intersections,
// in Ray Tracing Gems; Pharr, Jakob, Humphreys 2023, section 6.6.
#pragma once

#include <array>
#include <vector>

#include "core/base/distribution.h"
#include "core/scene/parameters.h"
#include "core/shape.h"
#include "core/shapes/box_tree.h"

namespace pssmlt {

// Corners in the order (u,v) = (0,0), (1,0), (0,1), (1,1).
using Quad = std::array<uint32_t, 4>;

struct PatchData {
  std::vector<vec3> positions;
  std::vector<vec3> normals;  // empty or one a vertex
  std::vector<vec2> uvs;      // empty or one a vertex
  std::vector<Quad> quads;    // indices in range
  // Where points are sampled on each patch, by (u, 1 - v), a tenth of them everywhere; empty:
  // uniformly. For lamps that show an image.
  Distribution2D emission;
};

class PatchShape final : public Shape {
 public:
  // `data` is in object space.
  PatchShape(PatchData data, const Parameters& p);

  Bounds bounds() const override { return tree_.bounds(); }
  std::optional<UserHit> intersect(const Ray& ray, float t_min) const override;
  void fill(const vec2& where, Hit& hit) const override;
  float grain() const override { return grain_; }
  void refine(const dvec3& origin, const dvec3& direction, Hit& hit) const override;
  float area() const override { return static_cast<float>(choice_.sum()); }
  // A patch by its area, then uniform in its parameters or by its emission.
  SurfaceSample sample_area(const vec2& u) const override;
  float pdf_area(const SurfaceSample& at) const override;
  // The normal's direction is bilinear in those of the corners; shading normals may turn it over.
  DirectionCone normals() const override;

 private:
  struct Patch {
    dvec3 p00, p10, p01, p11;
    dvec3 at(const dvec2& uv) const;
    dvec3 du(double v) const { return (1.0 - v) * (p10 - p00) + v * (p11 - p01); }
    dvec3 dv(double u) const { return (1.0 - u) * (p01 - p00) + u * (p11 - p10); }
    dvec3 cross(const dvec2& uv) const { return glm::cross(du(uv.y), dv(uv.x)); }
    // Calls accept(t, uv) for the points of the patch on a line; uv within [-margin, 1 + margin].
    template <typename Accept>
    void roots(const dvec3& o, const dvec3& d, double margin, const Accept& accept) const;
  };
  Patch patch(uint32_t element) const;
  double patch_area(uint32_t element) const;
  // Normal on the side that the orientation and the shading normal ask for.
  dvec3 outside(uint32_t element, const dvec2& uv, const vec3& ns) const;
  vec3 shading_normal(uint32_t element, const dvec2& uv) const;
  vec2 texture_uv(uint32_t element, const dvec2& uv) const;
  void set_texture_derivatives(uint32_t element, const dvec2& uv, Hit& hit) const;
  // A point of the parameters from two numbers, and the density with which it is drawn [1].
  dvec2 sample_parameters(const dvec2& u) const;
  double pdf_parameters(const dvec2& uv) const;
  // Parameters of a point of the surface.
  dvec2 parameters(const SurfaceSample& at) const;

  PatchData data_;
  bool flip_ = false;
  BoxTree tree_;
  float grain_ = 0.f;  // [m]
  Distribution1D choice_;
};

}  // namespace pssmlt
