#include "core/diffusion/diffusion_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/math.h"

namespace pssmlt {
namespace {

constexpr int knots = 160;
constexpr double first_knot = 1e-3;  // free paths; less than a thousandth of the power is nearer

// Where the profile is cut [m]: by absorption less than e^-16 is left; without it the tail falls
// off as 1 / r^2 and 2000 free paths leave out less than a thousandth.
double cut(const DiffusingMedium& m) {
  const double path = 1.0 / m.reduced_extinction();
  const double far = m.attenuation() > 0.0 ? 16.0 / m.attenuation() : infinity;
  return std::min(std::max(far, 16.0 * path), 2000.0 * path);
}

}  // namespace

DiffusionProfile::Channel DiffusionProfile::tabulate(const DiffusingMedium& medium) {
  Channel c;
  c.radius = {0.f};
  c.ring = {0.f};
  c.below = {0.f};
  if (!(medium.scattering > 0.0)) return c;
  const double end = cut(medium), begin = first_knot / medium.extinction();
  const double ratio = std::pow(end / begin, 1.0 / (knots - 1));
  const BeamDiffusion leaves(medium);
  double r = begin;
  for (int i = 0; i < knots; ++i, r *= ratio) {
    const double ring = 2.0 * std::numbers::pi * r * std::max(leaves(r), 0.0);
    c.radius.push_back(static_cast<float>(r));
    c.ring.push_back(static_cast<float>(ring));
  }
  // Close to the beam Sp grows as 1 / r: the ring's power does not change.
  c.ring[0] = c.ring[1];
  for (size_t i = 1; i < c.radius.size(); ++i) {
    const float mean_ring = 0.5f * (c.ring[i] + c.ring[i - 1]);
    c.below.push_back(c.below[i - 1] + mean_ring * (c.radius[i] - c.radius[i - 1]));
  }
  // Diffusion gains light where the boundary holds back much and the medium absorbs nothing.
  const float gain = std::max(c.below.back(), 1.f);
  for (float& x : c.ring) x /= gain;
  for (float& x : c.below) x /= gain;
  return c;
}

DiffusionProfile::DiffusionProfile(const std::array<DiffusingMedium, 3>& media)
    : eta_(static_cast<float>(media[0].eta)) {
  leaving_ = pi * static_cast<float>(1.0 - 2.0 * fresnel_moment(1, media[0].eta, false));
  for (int i = 0; i < 3; ++i) {
    channels_[index(i)] = tabulate(media[index(i)]);
    albedo_[i] = channels_[index(i)].below.back();
  }
  const float sum = albedo_.x + albedo_.y + albedo_.z;
  for (int i = 0; i < 3; ++i) share_[index(i)] = sum > 0.f ? albedo_[i] / sum : 0.f;
}

float DiffusionProfile::Channel::ring_at(float r) const {
  if (!(r < radius.back())) return 0.f;
  const auto above = static_cast<size_t>(std::ranges::upper_bound(radius, r) - radius.begin());
  const float t = (r - radius[above - 1]) / (radius[above] - radius[above - 1]);
  return ring[above - 1] + t * (ring[above] - ring[above - 1]);
}

Rgb DiffusionProfile::value(float r) const {
  Rgb v(0.f);
  if (!(r > 0.f)) return v;
  for (int i = 0; i < 3; ++i) v[i] = channels_[index(i)].ring_at(r) / (2.f * pi * r);
  return v;
}

float DiffusionProfile::density(int component, float r) const {
  const Channel& c = channels_[index(component)];
  if (!(r > 0.f) || !(c.below.back() > 0.f)) return 0.f;
  return c.ring_at(r) / (2.f * pi * r * c.below.back());
}

float DiffusionProfile::sample_radius(int component, float u) const {
  const Channel& c = channels_[index(component)];
  if (c.radius.size() < 2) return 0.f;
  const float power = u * c.below.back();
  const auto found =
      static_cast<size_t>(std::ranges::upper_bound(c.below, power) - c.below.begin());
  const size_t above = std::clamp<size_t>(found, 1, c.below.size() - 1);
  const float width = c.radius[above] - c.radius[above - 1];
  const float a = c.ring[above - 1], slope = c.ring[above] - a;
  // a t + slope t^2 / 2 = rest, in the form that does not cancel.
  const float rest = (power - c.below[above - 1]) / width;
  const float root = std::sqrt(std::max(a * a + 2.f * slope * rest, 0.f));
  const float t = a + root > 0.f ? 2.f * rest / (a + root) : 0.f;
  return c.radius[above - 1] + std::clamp(t, 0.f, 1.f) * width;
}

double diffusing_albedo(double seen, double g, double eta) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 16; ++i) {
    const double middle = 0.5 * (low + high);
    const DiffusingMedium m{middle, 1.0 - middle, g, eta};
    const double back = static_cast<double>(DiffusionProfile({m, {}, {}}).albedo().x);
    (back < seen ? low : high) = middle;
  }
  return low;
}

}  // namespace pssmlt
