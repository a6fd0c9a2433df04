// Where the numbers of a path vertex live (core/sampling/primary_sample.h), read by name.
#pragma once

#include "core/material.h"
#include "core/sampling/primary_sample.h"
#include "core/scene/scene.h"

namespace pssmlt {

// Block 0 of a surface vertex: how it scatters.
struct ScatterNumbers {
  vec2 direction{0.f};
  float lobe = 0.f, roulette = 0.f;
};
inline ScatterNumbers scatter_numbers(PrimarySample& u, Stream stream, int vertex) {
  Numbers n = u.numbers(stream, vertex, 0);
  ScatterNumbers s;
  s.direction = n.next2();
  s.lobe = n.next();
  s.roulette = n.next();
  return s;
}

// First half of block 1: what the material draws; not read in scenes where none draws.
inline MaterialNumbers material_numbers(PrimarySample& u, Stream stream, int vertex,
                                        const SceneFeatures& features) {
  if (!features.material_numbers && !features.dispersion) return {};
  MaterialNumbers m;
  m.sample = &u;
  if (!features.material_numbers) return m;
  Numbers n = u.numbers(stream, vertex, 1);
  m.first = n.next();
  m.second = n.next();
  // Behind vertex 0, camera and light vertices in turn.
  m.walk = 1 + (2 * vertex + (stream == Stream::light ? 1 : 0)) * walk_vertices;
  return m;
}

// Second half of block 1: the edge that leaves the vertex. Not read in scenes without cut-outs and
// media.
struct EdgeNumbers {
  float alpha = 0.f;     // decides cut-outs
  float distance = 0.f;  // where in media the edge ends
};
inline EdgeNumbers edge_numbers(PrimarySample& u, Stream stream, int vertex,
                                const SceneFeatures& features) {
  if (!features.alpha && !features.media) return {};
  Numbers n = u.numbers(stream, vertex, 1);
  n.next2();
  EdgeNumbers e;
  e.alpha = n.next();
  e.distance = n.next();
  return e;
}

// When the path is followed (Ray::time); shared by both ends. Not read where nothing moves.
inline float time_number(PrimarySample& u, const Scene& scene) {
  if (!scene.features().motion) return 0.f;
  return scene.time(u.numbers(Stream::shared, 0, 0).next());
}

// Which of several techniques makes the path: second half of the same block.
struct TechniqueNumbers {
  double length = 0.0;
  float strategy = 0.f;
};
inline TechniqueNumbers technique_numbers(PrimarySample& u) {
  Numbers n = u.numbers(Stream::shared, 0, 0);
  n.next2();
  TechniqueNumbers t;
  t.length = n.next_double();
  t.strategy = n.next();
  return t;
}

// Position on the lens: third and fourth number of the camera's block 0.
inline vec2 lens_numbers(PrimarySample& u) {
  Numbers n = u.numbers(Stream::camera, 0, 0);
  n.next2();
  return n.next2();
}

// Connections of vertex `vertex`. Block 0: to a light; block 1: to the lens.
struct LightNumbers {
  double choice = 0.0;
  vec2 position{0.f};
  float pick = 0.f;  // which far vertex, past the depth where all pairs are connected
};
inline LightNumbers light_numbers(PrimarySample& u, int vertex) {
  Numbers n = u.numbers(Stream::connection, vertex, 0);
  LightNumbers l;
  l.choice = n.next_double();
  l.position = n.next2();
  l.pick = n.next();
  return l;
}
inline vec2 lens_connection_numbers(PrimarySample& u, int vertex) {
  return u.numbers(Stream::connection, vertex, 1).next2();
}

// The start of a light subpath: vertex 0 of the light stream.
struct EmissionNumbers {
  vec2 position{0.f}, direction{0.f};
  double choice = 0.0;
};
inline EmissionNumbers emission_numbers(PrimarySample& u) {
  Numbers n = u.numbers(Stream::light, 0, 0);
  EmissionNumbers e;
  e.position = n.next2();
  e.direction = n.next2();
  e.choice = u.numbers(Stream::light, 0, 1).next_double();
  return e;
}

// Probability to go on after a scattering event, given the largest component of the throughput
// (relative to its start, squared index ratios undone). As pbrt: sure for the first bounce.
inline float survival(int bounces, float throughput) {
  return bounces > 1 && throughput < 1.f ? throughput : 1.f;
}

}  // namespace pssmlt
