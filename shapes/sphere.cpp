// A sphere around the origin, whole or cut by two planes of constant z and a sweep about the z
// axis.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 6.2; the intersection
// uses the distance from the centre to the ray, which does not cancel for distant spheres (Haines
// et al. 2019, Precision Improvements for Ray/Sphere Intersection, in Ray Tracing Gems). Whole
// spheres that no transform distorts are sampled over the cone in which they are seen from outside.
#include <algorithm>

#include "core/base/frame.h"
#include "core/plugin/plugin.h"
#include "core/shapes/quadric.h"

namespace pssmlt {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

class Sphere final : public QuadricShape {
 public:
  static constexpr const char* summary = "Sphere, whole or cut";

  explicit Sphere(Parameters& p) : QuadricShape(p) {
    const float radius = p.number("radius", 1.f, "m", "Radius.");
    const float zmin = p.number("zmin", -radius, "m", "Lower cut; default: none.");
    const float zmax = p.number("zmax", radius, "m", "Upper cut; default: none.");
    const float phimax = p.number("phimax", 360.f, "degrees", "Sweep about the z axis.");
    if (!(radius > 0.f)) p.fail("radius", "\"radius\" must be positive");
    if (!(phimax > 0.f)) p.fail("phimax", "\"phimax\" must be positive");
    r_ = static_cast<double>(radius);
    zmin_ = std::clamp(static_cast<double>(std::min(zmin, zmax)), -r_, r_);
    zmax_ = std::clamp(static_cast<double>(std::max(zmin, zmax)), -r_, r_);
    if (!(zmin_ < zmax_)) p.fail("zmin", "nothing is left between \"zmin\" and \"zmax\"");
    phimax_ = two_pi * std::min(static_cast<double>(phimax), 360.0) / 360.0;
    theta_zmin_ = std::acos(zmin_ / r_);
    theta_zmax_ = std::acos(zmax_ / r_);
  }

  std::optional<SurfaceSample> sample_toward(const vec3& reference, const vec2& u) const override;
  float pdf_toward(const vec3& reference, const SurfaceSample& at) const override;

 protected:
  Local at(const dvec2& uv) const override;
  std::optional<Root> intersect_local(const dvec3& o, const dvec3& d, double t_min,
                                      double t_max) const override;
  dvec2 sample_uv(const dvec2& u) const override {
    const double z = zmin_ + u.x * (zmax_ - zmin_);
    return {u.y, (std::acos(z / r_) - theta_zmin_) / (theta_zmax_ - theta_zmin_)};
  }
  double local_area() const override { return phimax_ * r_ * (zmax_ - zmin_); }
  void local_box(dvec3& low, dvec3& high) const override {
    low = {-r_, -r_, zmin_};
    high = {r_, r_, zmax_};
  }

 private:
  // The cone in which the sphere is seen.
  struct Cone {
    dvec3 to_center;                                                  // from the reference
    double distance2;                                                 // squared, to the centre
    double one_minus_cosine;                                          // of half its angle
    double pdf() const { return 1.0 / (two_pi * one_minus_cosine); }  // [1/sr]
  };
  // nullopt for parts of spheres, distorted ones, and from inside.
  std::optional<Cone> cone(const vec3& reference) const;
  double render_radius() const { return r_ * similarity(); }
  // Nothing is at a pole that was not cut, where rounding may leave z beyond the radius.
  bool cut_off(double z) const { return (zmin_ > -r_ && z < zmin_) || (zmax_ < r_ && z > zmax_); }
  bool whole() const { return zmin_ == -r_ && zmax_ == r_ && phimax_ == two_pi; }

  double r_ = 1.0, zmin_ = -1.0, zmax_ = 1.0, phimax_ = two_pi;
  double theta_zmin_ = 0.0, theta_zmax_ = 0.0;
};

Sphere::Local Sphere::at(const dvec2& uv) const {
  const double phi = uv.x * phimax_, theta = theta_zmin_ + uv.y * (theta_zmax_ - theta_zmin_);
  const double sin_theta = std::sin(theta), cos_theta = std::cos(theta);
  const double sin_phi = std::sin(phi), cos_phi = std::cos(phi);
  Local l;
  l.normal = {sin_theta * cos_phi, sin_theta * sin_phi, cos_theta};
  l.position = r_ * l.normal;
  l.dndu = phimax_ * dvec3(-l.normal.y, l.normal.x, 0.0);
  l.dndv =
      (theta_zmax_ - theta_zmin_) * dvec3(cos_theta * cos_phi, cos_theta * sin_phi, -sin_theta);
  l.dpdu = r_ * l.dndu;
  l.dpdv = r_ * l.dndv;
  return l;
}

std::optional<Sphere::Root> Sphere::intersect_local(const dvec3& o, const dvec3& d, double t_min,
                                                    double t_max) const {
  const double a = glm::dot(d, d), middle = -glm::dot(o, d) / a;
  const dvec3 nearest = o + middle * d;
  const double discriminant = (r_ * r_ - glm::dot(nearest, nearest)) / a;
  if (!(discriminant >= 0.0)) return std::nullopt;
  const double half = std::sqrt(discriminant);
  return first_root(
      middle - half, middle + half, t_min, t_max, [&](double t) -> std::optional<Root> {
        dvec3 p = o + t * d;
        p *= r_ / glm::length(p);
        const double phi = azimuth(p.x, p.y);
        if (cut_off(p.z) || phi > phimax_) return std::nullopt;
        const double theta = std::atan2(std::hypot(p.x, p.y), p.z);
        return Root{t, {phi / phimax_, (theta - theta_zmin_) / (theta_zmax_ - theta_zmin_)}};
      });
}

std::optional<Sphere::Cone> Sphere::cone(const vec3& reference) const {
  if (!whole() || similarity() == 0.0) return std::nullopt;
  Cone c;
  c.to_center = to_render().point(dvec3(0.0)) - dvec3(reference);
  c.distance2 = glm::dot(c.to_center, c.to_center);
  const double sin2 = sqr(render_radius()) / c.distance2;
  // A margin for points on the sphere itself, whose rounding may put them on either side.
  if (!(sin2 < 1.0 - 1e-6)) return std::nullopt;
  c.one_minus_cosine = sin2 / (1.0 + std::sqrt(1.0 - sin2));
  return c;
}

std::optional<SurfaceSample> Sphere::sample_toward(const vec3& reference, const vec2& u) const {
  const auto c = cone(reference);
  if (!c) return Shape::sample_toward(reference, u);
  const double distance = std::sqrt(c->distance2);
  const double x = static_cast<double>(u.x) * c->one_minus_cosine;  // 1 - cos theta
  const double sin2 = x * (2.0 - x), phi = two_pi * static_cast<double>(u.y);
  // Along the ray to the near side of the sphere.
  const double r2 = sqr(render_radius());
  const double t = distance * (1.0 - x) - std::sqrt(std::max(0.0, r2 - c->distance2 * sin2));
  const Frame frame(vec3(c->to_center / distance));
  const dvec3 s(frame.s), across(frame.t);
  const dvec3 direction = (1.0 - x) * c->to_center / distance +
                          std::sqrt(sin2) * (std::cos(phi) * s + std::sin(phi) * across);
  const dvec3 p = to_render().inverse().point(dvec3(reference) + t * direction);
  const double theta = std::atan2(std::hypot(p.x, p.y), p.z);
  SurfaceSample sample = surface_point(
      {azimuth(p.x, p.y) / phimax_, (theta - theta_zmin_) / (theta_zmax_ - theta_zmin_)});
  sample.pdf = static_cast<float>(c->pdf());
  return sample;
}

float Sphere::pdf_toward(const vec3& reference, const SurfaceSample& at) const {
  const auto c = cone(reference);
  if (!c) return Shape::pdf_toward(reference, at);
  const float outside = reversed() ? -1.f : 1.f;
  const bool near_side = outside * glm::dot(at.normal, reference - at.position) > 0.f;
  return near_side ? static_cast<float>(c->pdf()) : 0.f;
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "sphere", pssmlt::Sphere)
