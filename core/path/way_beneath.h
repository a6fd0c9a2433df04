// Ways beneath surfaces: light that enters at one point of a body leaves it at another, drawn by a
// diffusion profile (core/diffusion).
//
// Source: King, Kulla, Conty and Fajardo 2013, BSSRDF Importance Sampling: points of a disk around
// the entry are projected onto the body along one of three axes, and all axes and components that
// could have drawn the point count (balance heuristic).
#pragma once

#include "core/path/numbers.h"
#include "core/path/surface.h"

namespace pssmlt {

// Makes `to` the point where light leaves that went beneath at `from` (they may be the same
// object), with the probability `entered` and by these numbers; what they have not decided decides
// here. Returns the factor of the throughput [1]; black if the way ends nowhere.
Rgb go_beneath(const Scene& scene, const Surface& from, const DiffusionProfile& profile,
               const ScatterNumbers& n, float entered, Surface& to);

}  // namespace pssmlt
