// Surfaces given by a formula over two parameters in [0,1]^2: sphere, disk, cylinder. All
// arithmetic is in double and in the shape's own space, so that hits far away and transforms that
// stretch stay exact to the rounding of the result; points are recomputed from their parameters.
#pragma once

#include <mutex>

#include "core/scene/parameters.h"
#include "core/shape.h"

namespace pssmlt {

class QuadricShape : public Shape {
 public:
  Bounds bounds() const final;
  std::optional<UserHit> intersect(const Ray& ray, float t_min) const final;
  void fill(const vec2& where, Hit& hit) const final;
  float grain() const final;
  void refine(const dvec3& origin, const dvec3& direction, Hit& hit) const final;
  float area() const final;
  // Uniform in the shape's own space; .pdf follows what the transform does to areas.
  SurfaceSample sample_area(const vec2& u) const final;
  float pdf_area(const SurfaceSample& at) const final;

 protected:
  // A point in object space; normal: unit, outside.
  struct Local {
    dvec3 position, normal, dpdu, dpdv, dndu, dndv;
  };
  struct Root {
    double t = 0.0;
    dvec2 uv{0.0};
  };
  explicit QuadricShape(const Parameters& p);

  virtual Local at(const dvec2& uv) const = 0;
  // Nearest t in (t_min, t_max) along a ray in object space; direction of any length.
  virtual std::optional<Root> intersect_local(const dvec3& origin, const dvec3& direction,
                                              double t_min, double t_max) const = 0;
  // Parameters of a point distributed uniformly over the area, and that area, in object space.
  virtual dvec2 sample_uv(const dvec2& u) const = 0;
  virtual double local_area() const = 0;
  // Opposite corners of a box in object space.
  virtual void local_box(dvec3& low, dvec3& high) const = 0;

  // Position, error, normal and uv of a surface point, without density.
  SurfaceSample surface_point(const dvec2& uv) const;
  const Transform& to_render() const { return to_render_; }
  // The factor of lengths where the transform keeps shapes; 0 where it distorts them.
  double similarity() const { return similarity_; }
  bool reversed() const { return side_ < 0.0; }

 private:
  vec3 render_normal(const dvec3& normal) const;
  void fill_at(const dvec2& uv, Hit& hit) const;

  Transform to_render_;
  glm::dmat3 linear_;
  double side_ = 1.0;  // -1: ReverseOrientation
  double determinant_ = 1.0;
  double similarity_ = 0.0;
  mutable std::once_flag area_once_;
  mutable float area_ = 0.f;
};

// Angle of (x, y) about the z axis in [0, 2 pi).
double azimuth(double x, double y);
// Nearest of two ascending roots in (t_min, t_max) that `accept(t) -> optional` takes.
template <typename Accept>
auto first_root(double t0, double t1, double t_min, double t_max, const Accept& accept)
    -> decltype(accept(t0)) {
  for (const double t : {t0, t1})
    if (t > t_min && t < t_max)
      if (auto found = accept(t)) return found;
  return std::nullopt;
}

}  // namespace pssmlt
