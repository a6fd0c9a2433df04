// Edges of paths: what a ray meets next, and what light passes on its way between two points. With
// media a ray may end between surfaces, and surfaces that cannot be seen only bound media.
//
// An edge takes one number for all the media it crosses: the first third of it chooses the channel
// whose optical depth is inverted, so that the density of ending at a distance is the mean over
// the channels, a function of the edge alone (the balance heuristic over channels).
#pragma once

#include "core/path/numbers.h"
#include "core/path/surface.h"

namespace pssmlt {

// The ray that an endpoint emits.
inline Ray leaving(const Emission& e, float time) {
  return {offset_origin(e.from.position, e.error, e.from.normal, e.direction), e.direction,
          infinity, time};
}

enum class Arrival : uint8_t {
  nothing,  // the ray left the scene
  surface,
  medium,   // light scatters inside a medium
  absorbed  // nothing can come of the edge
};

// How an edge was sampled.
struct Flight {
  Rgb transmittance{1.f};  // of the media along the edge [1]
  // Mean over channels of transmittance [1], times extinction [1/m] if the edge ends in a medium.
  float density = 1.f;
  // What the edge contributes to the throughput.
  Rgb weight() const { return transmittance / density; }
};

// Follows the ray, which starts in `medium`. Fills at.hit and at.medium; in a medium `at` is a
// point of it.
Arrival fly_through_media(const Scene& scene, const Ray& ray, const Medium* medium,
                          const EdgeNumbers& u, Surface& at, Flight& flight);
inline Arrival fly(const Scene& scene, const Ray& ray, const Medium* medium, const EdgeNumbers& u,
                   Surface& at, Flight& flight) {
  at.arrive(ray.time);
  if (scene.features().media) return fly_through_media(scene, ray, medium, u, at, flight);
  return scene.intersect(ray, u.alpha, at.hit) ? Arrival::surface : Arrival::nothing;
}

// What a connection passes.
struct Passage {
  float visibility = 1.f;  // of surfaces: 0, 1 or the product of (1 - alpha)
  Rgb transmittance{1.f};  // of media [1]
  Rgb light() const { return visibility * transmittance; }
};

// Along a ray up to its t_max, starting in `medium`.
Passage pass_media(const Scene& scene, const Ray& ray, const Medium* medium);
inline Passage passage(const Scene& scene, const Ray& ray, const Medium* medium) {
  if (scene.features().media) return pass_media(scene, ray, medium);
  Passage p;
  p.visibility = scene.visibility(ray);
  return p;
}

}  // namespace pssmlt
