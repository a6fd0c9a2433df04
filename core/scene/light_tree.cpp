#include "core/scene/light_tree.h"

#include <algorithm>

namespace pssmlt {
namespace {

// What bounds say is certain up to the rounding of cones [cosine].
constexpr float slack = 1e-3f;
// Where a direction is nearly edge-on the guess stays above this part of that for one straight on:
// scattering that is not diffuse, and cones that are not filled, may have more there.
constexpr float least_cosine = .05f;

float sine_of(float cosine) { return safe_sqrt(1.f - cosine * cosine); }

}  // namespace

// Angles are compared and subtracted by their cosines and sines; roots are drawn where needed,
// since this is most of what the hierarchy costs.
float LightTree::importance(const Node& node, const LightReceiver& at) {
  const vec3 d = node.center - at.position;
  const float d2 = length_squared(d);
  // Inside the bounding sphere there is light from everywhere.
  if (!(d2 > node.radius2)) return node.intensity / std::max(node.radius2, 1e-30f);
  const float inverse2 = 1.f / std::max(d2, 1e-30f);
  const float inverse = std::sqrt(inverse2);
  // The sphere is seen under this half angle.
  const float sine2 = node.radius2 * inverse2, cosine = safe_sqrt(1.f - sine2);
  float factor = 1.f;
  if (at.normal != vec3(0.f)) {
    float height = glm::dot(at.normal, d) * inverse;
    if (at.transmits) height = std::abs(height);
    if (height < cosine) {
      const float highest = height * cosine + sine_of(height) * std::sqrt(sine2);
      if (highest < -slack) return 0.f;
      factor = std::max(highest, least_cosine);
    }
  }
  float shown = -glm::dot(node.axis, d) * inverse;
  if (node.two_sided) shown = std::abs(shown);
  if (shown < node.cos_cone) {
    // Off the cone by an angle, of which the sphere takes its half angle.
    const float sine = sine_of(shown), sine_cone = sine_of(node.cos_cone);
    const float off = shown * node.cos_cone + sine * sine_cone;
    if (off < cosine) {
      const float least =
          off * cosine + (sine * node.cos_cone - shown * sine_cone) * std::sqrt(sine2);
      if (least < node.cos_spread - slack) return 0.f;
      factor *= std::max(least, least_cosine);
    }
  }
  return factor * node.intensity * inverse2;
}

double LightTree::first_share(uint32_t first, const LightReceiver& at) const {
  const Node &a = nodes_[first], &b = nodes_[first + 1];
  double x = static_cast<double>(importance(a, at)), y = static_cast<double>(importance(b, at));
  if (!(x + y > 0.0) || !std::isfinite(x + y)) {
    // Neither shines here, or nothing is known: any choice will do, but it has to be made.
    x = static_cast<double>(a.intensity);
    y = static_cast<double>(b.intensity);
    if (!(x + y > 0.0)) x = y = 1.0;
  }
  return x / (x + y);
}

LightTree::Choice LightTree::choose(const LightReceiver& at, double u) const {
  double p = 1.0;
  const Node* node = nodes_.data();
  while (!node->leaf) {
    const double first = first_share(node->next, at);
    const bool second = u >= first;
    const double share = second ? 1.0 - first : first;
    u = std::min((second ? u - first : u) / share, 1.0 - 0x1p-53);
    p *= share;
    node = &nodes_[node->next + (second ? 1u : 0u)];
  }
  return {node->next, p};
}

double LightTree::probability(const LightReceiver& at, uint32_t light) const {
  double p = 1.0;
  const Node* node = nodes_.data();
  for (uint64_t trail = trails_[light]; !node->leaf && p > 0.0; trail >>= 1) {
    const bool second = (trail & 1) != 0;
    const double first = first_share(node->next, at);
    p *= second ? 1.0 - first : first;
    node = &nodes_[node->next + (second ? 1u : 0u)];
  }
  return p;
}

double LightTree::irradiance(const LightReceiver& at) const {
  const uint32_t first = nodes_[0].next;
  return intensity_ * (static_cast<double>(importance(nodes_[first], at)) +
                       static_cast<double>(importance(nodes_[first + 1], at)));
}

}  // namespace pssmlt
