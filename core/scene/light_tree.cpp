#include "core/scene/light_tree.h"

#include <algorithm>

namespace pssmlt {
namespace {

// What bounds say is certain up to the rounding of cones [cosine].
constexpr float slack = 1e-3f;
// Where a direction is nearly edge-on the guess stays above this part of that for one straight on:
// scattering that is not diffuse, and cones that are not filled, may have more there.
constexpr float least_cosine = .05f;

}  // namespace

// Angles are compared and subtracted by their cosines and sines.
Four LightTree::importances(const Fan& fan, const LightReceiver& at) {
  const Four dx = fan.center[0] - at.position.x, dy = fan.center[1] - at.position.y,
             dz = fan.center[2] - at.position.z;
  const Four zero = four(0.f), one = four(1.f), tiny = four(1e-30f), least = four(least_cosine);
  const Four d2 = dx * dx + dy * dy + dz * dz;
  const Four inverse2 = 1.f / larger(d2, tiny), inverse = root(inverse2);
  // The spheres are seen under these half angles.
  const Four sine2 = smaller(fan.radius2 * inverse2, one), sine = root(sine2),
             cosine = root(1.f - sine2);
  Four factor = one;
  if (at.normal != vec3(0.f)) {
    // How high over the receiver's horizon the spheres reach.
    Four height = (at.normal.x * dx + at.normal.y * dy + at.normal.z * dz) * inverse;
    if (at.transmits) height = magnitude(height);
    const Four highest = height * cosine + root(larger(zero, 1.f - height * height)) * sine;
    const Four lit = highest < -slack ? zero : larger(highest, least);
    factor = height < cosine ? lit : one;
  }
  Four shown = -(fan.axis[0] * dx + fan.axis[1] * dy + fan.axis[2] * dz) * inverse;
  shown = fan.two_sided != 0 ? magnitude(shown) : shown;
  // Off the cones by an angle, of which the spheres take their half angles.
  const Four sine_shown = root(larger(zero, 1.f - shown * shown));
  const Four off = shown * fan.cos_cone + sine_shown * fan.sin_cone;
  const Four rest = off * cosine + (sine_shown * fan.cos_cone - shown * fan.sin_cone) * sine;
  const Four dimmed = rest < fan.cos_spread - slack ? zero : larger(rest, least);
  const auto aside = (shown < fan.cos_cone) & (off < cosine);
  factor = aside ? factor * dimmed : factor;
  // Inside a bounding sphere there is light from everywhere.
  const Four inside = 1.f / larger(fan.radius2, tiny);
  return fan.intensity * (d2 > fan.radius2 ? factor * inverse2 : inside);
}

LightTree::Weights LightTree::weights(const Fan& fan, const LightReceiver& at) {
  const Four guess = importances(fan, at);
  Weights w;
  for (uint32_t i = 0; i < width; ++i) w.sum += w.of[i] = static_cast<double>(guess[i]);
  if (w.sum > 0.0 && std::isfinite(w.sum)) return w;
  // None shines here, or nothing is known: any choice will do, but it has to be made.
  w.sum = 0.0;
  for (uint32_t i = 0; i < width; ++i) w.sum += w.of[i] = static_cast<double>(fan.intensity[i]);
  if (w.sum > 0.0) return w;
  for (uint32_t i = 0; i < fan.count; ++i) w.sum += w.of[i] = 1.0;
  return w;
}

LightTree::Choice LightTree::choose(const LightReceiver& at, double u) const {
  double p = 1.0;
  for (const Fan* fan = fans_.data();;) {
    const Weights w = weights(*fan, at);
    double rest = u * w.sum;
    uint32_t i = 0, last = 0;
    for (; i < width; ++i) {
      if (!(w.of[i] > 0.0)) continue;
      last = i;
      if (rest < w.of[i]) break;
      rest -= w.of[i];
    }
    // Past all of them by rounding: the last one's end.
    u = i == width ? 1.0 - 0x1p-53 : std::min(rest / w.of[last], 1.0 - 0x1p-53);
    p *= w.of[last] / w.sum;
    if (fan->leaf[last]) return {fan->next[last], p};
    fan = &fans_[fan->next[last]];
  }
}

double LightTree::probability(const LightReceiver& at, uint32_t light) const {
  double p = 1.0;
  const Fan* fan = fans_.data();
  for (uint64_t trail = trails_[light];; trail >>= 2) {
    const auto i = static_cast<uint32_t>(trail & 3);
    const Weights w = weights(*fan, at);
    p *= w.of[i] / w.sum;
    if (fan->leaf[i] || !(p > 0.0)) return p;
    fan = &fans_[fan->next[i]];
  }
}

double LightTree::irradiance(const LightReceiver& at) const {
  const Four guess = importances(fans_[0], at);
  double sum = 0.0;
  for (uint32_t i = 0; i < width; ++i) sum += static_cast<double>(guess[i]);
  return intensity_ * sum;
}

}  // namespace pssmlt
