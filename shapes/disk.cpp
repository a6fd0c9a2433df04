// A disk at a constant z, with an optional hole, swept by phimax. Its outside is toward +z.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 6.4.
#include <algorithm>

#include "core/plugin/plugin.h"
#include "core/shapes/facing_plane.h"
#include "core/shapes/quadric.h"

namespace pssmlt {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

class Disk final : public QuadricShape {
 public:
  static constexpr const char* summary = "Disk or ring at a constant z";

  explicit Disk(Parameters& p) : QuadricShape(p) {
    height_ = static_cast<double>(p.number("height", 0.f, "m", "Its z."));
    const float radius = p.number("radius", 1.f, "m", "Outer radius.");
    const float inner = p.number("innerradius", 0.f, "m", "Radius of the hole.");
    const float phimax = p.number("phimax", 360.f, "degrees", "Sweep about the z axis.");
    if (!(radius > 0.f)) p.fail("radius", "\"radius\" must be positive");
    if (!(inner >= 0.f && inner < radius))
      p.fail("innerradius", "\"innerradius\" must lie in [0, radius)");
    if (!(phimax > 0.f)) p.fail("phimax", "\"phimax\" must be positive");
    r_ = static_cast<double>(radius);
    inner_ = static_cast<double>(inner);
    phimax_ = two_pi * std::min(static_cast<double>(phimax), 360.0) / 360.0;
    if (p.describing()) return;
    Hit hit;
    fill(vec2(0.f), hit);
    plane_ = {hit.position, hit.ng};
    for (const float u : {.25f, .5f, .75f, 1.f}) {
      fill(vec2(u, 0.f), hit);
      plane_.slack = std::max(plane_.slack, 2.f * plane_.slack_of(hit.position));
    }
  }
  bool may_face(const vec3& reference) const override { return plane_.may_face(reference); }
  DirectionCone normals() const override { return {plane_.normal, 1.f}; }

 protected:
  Local at(const dvec2& uv) const override {
    const double phi = uv.x * phimax_, r = r_ - uv.y * (r_ - inner_);
    const dvec3 radial(std::cos(phi), std::sin(phi), 0.0), along(-radial.y, radial.x, 0.0);
    Local l;
    l.position = r * radial + dvec3(0.0, 0.0, height_);
    l.normal = {0.0, 0.0, 1.0};
    // The centre has no direction of u of its own: it keeps that of its surroundings.
    l.dpdu = phimax_ * std::max(r, 1e-6 * r_) * along;
    l.dpdv = (inner_ - r_) * radial;
    l.dndu = l.dndv = dvec3(0.0);
    return l;
  }

  std::optional<Root> intersect_local(const dvec3& o, const dvec3& d, double t_min,
                                      double t_max) const override {
    if (d.z == 0.0) return std::nullopt;
    const double t = (height_ - o.z) / d.z;
    if (!(t > t_min && t < t_max)) return std::nullopt;
    const dvec3 p = o + t * d;
    const double r = std::hypot(p.x, p.y), phi = azimuth(p.x, p.y);
    if (r > r_ || r < inner_ || phi > phimax_) return std::nullopt;
    return Root{t, {phi / phimax_, (r_ - r) / (r_ - inner_)}};
  }

  dvec2 sample_uv(const dvec2& u) const override {
    const double r = std::sqrt(inner_ * inner_ + u.x * (r_ * r_ - inner_ * inner_));
    return {u.y, (r_ - r) / (r_ - inner_)};
  }
  double local_area() const override { return 0.5 * phimax_ * (r_ * r_ - inner_ * inner_); }
  void local_box(dvec3& low, dvec3& high) const override {
    low = {-r_, -r_, height_};
    high = {r_, r_, height_};
  }

 private:
  FacingPlane plane_;
  double height_ = 0.0, r_ = 1.0, inner_ = 0.0, phimax_ = two_pi;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "disk", pssmlt::Disk)
