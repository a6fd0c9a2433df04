// Where the numbers of a path vertex live (core/sampling/primary_sample.h), read by name.
#pragma once

#include "core/material.h"
#include "core/sampling/primary_sample.h"
#include "core/scene/features.h"

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
  if (!features.material_numbers) return {};
  Numbers n = u.numbers(stream, vertex, 1);
  MaterialNumbers m;
  m.first = n.next();
  m.second = n.next();
  return m;
}

// Third of block 1: decides cut-outs along the ray that leaves the vertex.
inline float alpha_number(PrimarySample& u, Stream stream, int vertex,
                          const SceneFeatures& features) {
  if (!features.alpha) return 0.f;
  Numbers n = u.numbers(stream, vertex, 1);
  n.next2();
  return n.next();
}

// Position on the lens: third and fourth number of the camera's block 0.
inline vec2 lens_numbers(PrimarySample& u) {
  Numbers n = u.numbers(Stream::camera, 0, 0);
  n.next2();
  return n.next2();
}

// Connections of vertex `vertex`. Block 0: to a light; block 1: to the lens.
struct LightNumbers {
  float choice = 0.f;
  vec2 position{0.f};
  float pick = 0.f;  // which far vertex, past the depth where all pairs are connected
};
inline LightNumbers light_numbers(PrimarySample& u, int vertex) {
  Numbers n = u.numbers(Stream::connection, vertex, 0);
  LightNumbers l;
  l.choice = n.next();
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
  float choice = 0.f;
};
inline EmissionNumbers emission_numbers(PrimarySample& u) {
  Numbers n = u.numbers(Stream::light, 0, 0);
  EmissionNumbers e;
  e.position = n.next2();
  e.direction = n.next2();
  e.choice = u.numbers(Stream::light, 0, 1).next();
  return e;
}

// Probability to go on after a scattering event, given the largest component of the throughput
// (relative to its start, squared index ratios undone). As pbrt: sure for the first bounce.
inline float survival(int bounces, float throughput) {
  return bounces > 1 && throughput < 1.f ? throughput : 1.f;
}

}  // namespace pssmlt
