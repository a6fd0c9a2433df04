#include "core/path/way_beneath.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/diffusion/diffusion_profile.h"

namespace pssmlt {
namespace {

// Surfaces along a probe that can be drawn; more lie along one only in foam.
constexpr int most_hits = 24;
constexpr std::array<float, 3> axis_share = {0.25f, 0.25f, 0.5f};  // tangents and normal

// The index that the number chooses by the shares, and the number made uniform again.
template <typename Share>
int choose(Share share, float& u) {
  int i = 0;
  for (; i < 2 && u >= share(i); ++i) u -= share(i);
  // Rounding may get to what has no share; nothing can be drawn from that.
  u = share(i) > 0.f ? std::clamp(u / share(i), 0.f, one_minus_epsilon) : 0.f;
  return i;
}

class Probe {
 public:
  Probe(const Scene& scene, const Surface& from, const DiffusionProfile& profile)
      : scene_(scene), from_(from), profile_(profile) {}

  // A point of the body near `from`; false if there is none. factor: value over density.
  bool draw(const vec2& u, float pick, Hit& hit, Rgb& factor) const {
    const int axis = choose([](int i) { return axis_share[static_cast<size_t>(i)]; }, pick);
    const int component = choose([&](int i) { return profile_.share(i); }, pick);
    const float reach = profile_.reach(component), r = profile_.sample_radius(component, u.x);
    if (!(r < reach)) return false;
    std::array<Hit, most_hits> hits;
    const int count = find(axis, r, 2.f * pi * u.y, std::sqrt(reach * reach - r * r), hits);
    if (count == 0) return false;
    const int drawn = std::min(static_cast<int>(pick * static_cast<float>(count)), count - 1);
    hit = hits[static_cast<size_t>(drawn)];
    const float density = density_of(hit);
    if (!(density > 0.f)) return false;
    factor = profile_.value(distance(hit)) * (static_cast<float>(count) / density);
    return true;
  }

 private:
  vec3 along(int axis) const {
    const Frame& f = from_.frame();
    return axis == 0 ? f.s : axis == 1 ? f.t : f.n;
  }
  float distance(const Hit& hit) const { return glm::distance(hit.position, from_.hit.position); }
  // The body's surfaces along the axis, around the point at r and phi of the disk.
  int find(int axis, float r, float phi, float half, std::array<Hit, most_hits>& hits) const {
    const vec3 direction = along(axis), a = along((axis + 1) % 3), b = along((axis + 2) % 3);
    const vec3 middle = from_.hit.position + r * (std::cos(phi) * a + std::sin(phi) * b);
    const vec3 end = middle + half * direction;
    Ray ray{middle - half * direction, direction, 2.f * half, from_.time};
    int count = 0;
    for (Hit next; count < most_hits && scene_.intersect(ray, 0.f, next);) {
      if (next.primitive->material == from_.hit.primitive->material)
        hits[static_cast<size_t>(count++)] = next;
      ray.origin = offset_origin(next.position, next.error, next.ng, direction);
      ray.t_max = glm::dot(end - ray.origin, direction);
      if (!(ray.t_max > 0.f)) break;
    }
    return count;
  }
  // Of all the ways to draw the point, but for the choice among the surfaces along the probe
  // [1/m^2].
  float density_of(const Hit& hit) const {
    const vec3 offset = hit.position - from_.hit.position;
    const float d = distance(hit);
    float density = 0.f;
    for (int axis = 0; axis < 3; ++axis) {
      const vec3 n = along(axis);
      const float r = glm::length(offset - glm::dot(offset, n) * n);
      const float shown = axis_share[static_cast<size_t>(axis)] * std::abs(glm::dot(hit.ng, n));
      for (int c = 0; c < 3; ++c)
        if (d < profile_.reach(c)) density += shown * profile_.share(c) * profile_.density(c, r);
    }
    return density;
  }

  const Scene& scene_;
  const Surface& from_;
  const DiffusionProfile& profile_;
};

}  // namespace

Rgb go_beneath(const Scene& scene, const Surface& from, const DiffusionProfile& profile,
               const ScatterNumbers& n, float entered, Surface& to) {
  if (!profile.shines()) return Rgb(0.f);
  // Of the lobe's number only that it lies above the reflectance was used.
  const float pick = std::clamp((n.lobe - (1.f - entered)) / entered, 0.f, one_minus_epsilon);
  Hit hit;
  Rgb factor(0.f);
  if (!Probe(scene, from, profile).draw(n.direction, pick, hit, factor)) return Rgb(0.f);
  const float side = from.side();
  to.time = from.time;
  to.medium = from.medium;
  to.emerge(scene, hit, profile, side);
  return factor;
}

}  // namespace pssmlt
