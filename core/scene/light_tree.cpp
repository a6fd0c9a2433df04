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
[[gnu::always_inline]] inline Four LightTree::importances(const Half& half,
                                                          const LightReceiver& at) {
  const Four dx = half.center[0] - at.position.x, dy = half.center[1] - at.position.y,
             dz = half.center[2] - at.position.z;
  const Four zero = four(0.f), one = four(1.f), tiny = four(1e-30f), least = four(least_cosine);
  const Four d2 = dx * dx + dy * dy + dz * dz;
  const Four inverse2 = 1.f / larger(d2, tiny), inverse = root(inverse2);
  // The spheres are seen under these half angles.
  const Four sine2 = smaller(half.radius2 * inverse2, one), sine = root(sine2),
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
  Four shown = -(half.axis[0] * dx + half.axis[1] * dy + half.axis[2] * dz) * inverse;
  shown = half.two_sided != 0 ? magnitude(shown) : shown;
  // Off the cones by an angle, of which the spheres take their half angles.
  const Four sine_shown = root(larger(zero, 1.f - shown * shown));
  const Four off = shown * half.cos_cone + sine_shown * half.sin_cone;
  const Four rest = off * cosine + (sine_shown * half.cos_cone - shown * half.sin_cone) * sine;
  const Four dimmed = rest < half.cos_spread - slack ? zero : larger(rest, least);
  const auto aside = (shown < half.cos_cone) & (off < cosine);
  factor = aside ? factor * dimmed : factor;
  // Inside a bounding sphere there is light from everywhere.
  const Four inside = 1.f / larger(half.radius2, tiny);
  return half.intensity * (d2 > half.radius2 ? factor * inverse2 : inside);
}

// False unless the sum is positive and finite.
[[gnu::always_inline]] inline bool LightTree::Weights::add(const std::array<Four, 2>& guess) {
  double sum = 0.0;
  for (uint32_t i = 0; i < width; ++i) up_to[i] = sum += static_cast<double>(guess[i / 4][i % 4]);
  return sum > 0.0 && std::isfinite(sum);
}

[[gnu::always_inline]] inline LightTree::Weights LightTree::weights(const Fan& fan,
                                                                    const LightReceiver& at) {
  Weights w;
  if (w.add({importances(fan.half[0], at), importances(fan.half[1], at)})) return w;
  // None shines here, or nothing is known: any choice will do, but it has to be made.
  if (w.add({fan.half[0].intensity, fan.half[1].intensity})) return w;
  for (uint32_t i = 0; i < width; ++i) w.up_to[i] = std::min(i + 1, fan.count);
  return w;
}

LightTree::Choice LightTree::choose(const LightReceiver& at, double u) const {
  double p = 1.0;
  for (const Fan* fan = fans_.data();;) {
    const Weights w = weights(*fan, at);
    const double target = u * w.sum();
    uint32_t i = 0;
    for (uint32_t k = 0; k + 1 < width; ++k) i += w.up_to[k] <= target;
    // Past all of them by rounding: the last one.
    while (!(w.of(i) > 0.0)) --i;
    u = std::min((target - w.before(i)) / w.of(i), 1.0 - 0x1p-53);
    p *= w.of(i) / w.sum();
    if (fan->leaf[i]) return {fan->next[i], p};
    fan = &fans_[fan->next[i]];
  }
}

// From the light up: where to look does not wait for what is found.
double LightTree::probability(const LightReceiver& at, uint32_t light) const {
  double p = 1.0;
  for (Place place = lights_[light];; place = fans_[place.fan].at) {
    const Weights w = weights(fans_[place.fan], at);
    p *= w.of(place.lane) / w.sum();
    if (place.fan == 0 || !(p > 0.0)) return p;
  }
}

double LightTree::irradiance(const LightReceiver& at) const {
  Weights w;
  w.add({importances(fans_[0].half[0], at), importances(fans_[0].half[1], at)});
  return intensity_ * w.sum();
}

}  // namespace pssmlt
