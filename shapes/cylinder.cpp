// The side of a cylinder about the z axis, from zmin to zmax, swept by phimax; open at its ends.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 6.3; the intersection
// uses the distance from the axis to the ray, which does not cancel for distant cylinders.
#include <algorithm>

#include "core/plugin/plugin.h"
#include "core/shapes/quadric.h"

namespace pssmlt {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

class Cylinder final : public QuadricShape {
 public:
  static constexpr const char* summary = "Side of a cylinder about the z axis";

  explicit Cylinder(Parameters& p) : QuadricShape(p) {
    const float radius = p.number("radius", 1.f, "m", "Radius.");
    const float zmin = p.number("zmin", -1.f, "m", "One end.");
    const float zmax = p.number("zmax", 1.f, "m", "The other end.");
    const float phimax = p.number("phimax", 360.f, "degrees", "Sweep about the z axis.");
    if (!(radius > 0.f)) p.fail("radius", "\"radius\" must be positive");
    if (!(phimax > 0.f)) p.fail("phimax", "\"phimax\" must be positive");
    if (zmin == zmax) p.fail("zmin", "\"zmin\" must differ from \"zmax\"");
    r_ = static_cast<double>(radius);
    zmin_ = static_cast<double>(std::min(zmin, zmax));
    zmax_ = static_cast<double>(std::max(zmin, zmax));
    phimax_ = two_pi * std::min(static_cast<double>(phimax), 360.0) / 360.0;
  }

 protected:
  Local at(const dvec2& uv) const override {
    const double phi = uv.x * phimax_, z = zmin_ + uv.y * (zmax_ - zmin_);
    Local l;
    l.normal = {std::cos(phi), std::sin(phi), 0.0};
    l.position = {r_ * l.normal.x, r_ * l.normal.y, z};
    l.dndu = phimax_ * dvec3(-l.normal.y, l.normal.x, 0.0);
    l.dndv = dvec3(0.0);
    l.dpdu = r_ * l.dndu;
    l.dpdv = {0.0, 0.0, zmax_ - zmin_};
    return l;
  }

  std::optional<Root> intersect_local(const dvec3& o, const dvec3& d, double t_min,
                                      double t_max) const override {
    const dvec2 o2(o), d2(d);
    const double a = glm::dot(d2, d2);
    if (!(a > 0.0)) return std::nullopt;  // parallel to the axis
    const double middle = -glm::dot(o2, d2) / a;
    const dvec2 nearest = o2 + middle * d2;
    const double discriminant = (r_ * r_ - glm::dot(nearest, nearest)) / a;
    if (!(discriminant >= 0.0)) return std::nullopt;
    const double half = std::sqrt(discriminant);
    return first_root(middle - half, middle + half, t_min, t_max,
                      [&](double t) -> std::optional<Root> {
                        const dvec3 p = o + t * d;
                        const double phi = azimuth(p.x, p.y);
                        if (p.z < zmin_ || p.z > zmax_ || phi > phimax_) return std::nullopt;
                        return Root{t, {phi / phimax_, (p.z - zmin_) / (zmax_ - zmin_)}};
                      });
  }

  dvec2 sample_uv(const dvec2& u) const override { return {u.y, u.x}; }
  double local_area() const override { return phimax_ * r_ * (zmax_ - zmin_); }
  void local_box(dvec3& low, dvec3& high) const override {
    low = {-r_, -r_, zmin_};
    high = {r_, r_, zmax_};
  }

 private:
  double r_ = 1.0, zmin_ = -1.0, zmax_ = 1.0, phimax_ = two_pi;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "cylinder", pssmlt::Cylinder)
