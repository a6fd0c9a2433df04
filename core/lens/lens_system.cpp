#include "core/lens/lens_system.h"

#include <cmath>

namespace pssmlt {
namespace {

// Where the ray meets the cap of the sphere around the surface's vertex; negative: nowhere ahead.
double distance_to(const LensSurface& s, const LensRay& ray) {
  if (s.is_stop()) return (s.z - ray.origin.z) / ray.direction.z;
  const dvec3 o = ray.origin - dvec3(0.0, 0.0, s.z - s.radius);
  const double b = glm::dot(o, ray.direction);
  const double root = b * b - glm::dot(o, o) + s.radius * s.radius;
  if (!(root >= 0.0)) return -1.0;
  const bool far = (ray.direction.z > 0.0) == (s.radius > 0.0);
  return far ? -b + std::sqrt(root) : -b - std::sqrt(root);
}

// Snell's law; `eta`: index behind over index before. False if all is reflected.
bool refract(const dvec3& normal, double eta, dvec3& direction) {
  const dvec3 n = glm::dot(normal, direction) < 0.0 ? normal : -normal;
  const double cos_i = -glm::dot(n, direction);
  const double sin2_t = (1.0 - cos_i * cos_i) / (eta * eta);
  if (!(sin2_t < 1.0)) return false;
  direction = glm::normalize(direction / eta + n * (cos_i / eta - std::sqrt(1.0 - sin2_t)));
  return true;
}

}  // namespace

LensSystem::LensSystem(std::vector<LensSurface> surfaces, double film_distance, Aperture openings)
    : surfaces_(std::move(surfaces)), aperture_(std::move(openings)) {
  const double shift = film_distance - surfaces_.back().z;
  for (LensSurface& s : surfaces_) s.z += shift;
}

double LensSystem::pass(const LensSurface& s, double eta, LensRay& ray) const {
  const double t = distance_to(s, ray);
  if (!(t >= 0.0)) return 0.0;
  ray.origin += t * ray.direction;
  const dvec2 off_axis(ray.origin);
  if (s.is_stop()) return aperture_.value(off_axis / s.opening);
  if (!(glm::dot(off_axis, off_axis) <= s.opening * s.opening)) return 0.0;
  const dvec3 normal = (ray.origin - dvec3(0.0, 0.0, s.z - s.radius)) / s.radius;
  return eta == 1.0 || refract(normal, eta, ray.direction) ? 1.0 : 0.0;
}

double LensSystem::from_film(LensRay& ray) const {
  double through = 1.0;
  for (size_t i = surfaces_.size(); i-- > 0 && through > 0.0;)
    through *= pass(surfaces_[i], index_before(i) / surfaces_[i].index, ray);
  return ray.direction.z > 0.0 ? through : 0.0;
}

double LensSystem::from_scene(LensRay& ray) const {
  double through = 1.0;
  for (size_t i = 0; i < surfaces_.size() && through > 0.0; ++i)
    through *= pass(surfaces_[i], surfaces_[i].index / index_before(i), ray);
  return ray.direction.z < 0.0 ? through : 0.0;
}

// Rays parallel to the axis, from either side, in the limit of small heights and angles.
ThickLens LensSystem::thick_lens() const {
  struct Paraxial {
    double height = 1.0, slope = 0.0;
    void pass(double power, double before, double behind) {
      slope = (before * slope - height * power) / behind;
    }
  };
  const size_t n = surfaces_.size();
  const auto power = [&](size_t i) {
    const LensSurface& s = surfaces_[i];
    return s.is_stop() ? 0.0 : (s.index - index_before(i)) / s.radius;
  };
  Paraxial in, out;
  for (size_t i = 0; i < n; ++i) {
    in.pass(power(i), index_before(i), surfaces_[i].index);
    if (i + 1 < n) in.height += in.slope * (surfaces_[i].z - surfaces_[i + 1].z);
  }
  for (size_t i = n; i-- > 0;) {
    out.pass(power(i), surfaces_[i].index, index_before(i));
    if (i > 0) out.height += out.slope * (surfaces_[i - 1].z - surfaces_[i].z);
  }
  ThickLens lens;
  lens.focal_length = -1.0 / in.slope;
  lens.film_plane = rear().z + in.height / in.slope + lens.focal_length;
  lens.scene_plane = front().z - out.height / out.slope - lens.focal_length;
  return lens;
}

bool LensSystem::focus(double distance) {
  const ThickLens lens = thick_lens();
  const double f = lens.focal_length;
  if (!(std::isfinite(f) && f > 0.0)) return false;
  // Of image and object distance i and o the sum is known, and 1 / i + 1 / o = 1 / f.
  const double sum = distance - (lens.scene_plane - lens.film_plane);
  const double root = sum * (sum - 4.0 * f);
  if (!(sum > 0.0 && root >= 0.0)) return false;
  const double image = 2.0 * f * sum / (sum + std::sqrt(root));
  const double shift = image - lens.film_plane;
  for (LensSurface& s : surfaces_) s.z += shift;
  return rear().z > 0.0;
}

LensSystem LensSystem::with_round_stops() const {
  LensSystem round = *this;
  round.aperture_ = Aperture();
  for (LensSurface& s : round.surfaces_)
    if (s.is_stop()) s.opening *= aperture_.reach();
  return round;
}

double LensSystem::front_plane() const {
  const LensSurface& s = front();
  if (s.radius >= 0.0) return s.z;
  const double r = -s.radius, a = std::min(s.opening, r);
  return s.z + a * a / (r + std::sqrt(r * r - a * a));  // the rim
}

}  // namespace pssmlt
