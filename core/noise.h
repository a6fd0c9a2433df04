// Perlin's noise and sums of it, as solid textures use them. Nothing here is random: the table of
// 2002 is the same everywhere, so that a scene looks the same everywhere.
//
// Source: Perlin 2002, Improving Noise, with the permutation that he published; of his 16 gradients
// the last four, which repeat others, are pbrt-v4's choice. Sums of octaves: Ebert, Musgrave,
// Peachey, Perlin, Worley 2003, Texturing and Modeling, chapter 2.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

// In [-1, 1], 0 at points with three integer coordinates, with period 256 in each; features are
// about 1 wide. NaN where a coordinate is NaN or infinite.
float noise(const vec3& p);

// What a sum of octaves is made of. The k-th octave has features 1.99^-k wide and the weight
// roughness^k; octaves whose features are smaller than two pixels are left out.
struct Octaves {
  int count = 8;           // at most [1]
  float roughness = 0.5f;  // weight of an octave over that of the one before [1]
  float footprint = 0.f;   // diameter of a pixel, in the coordinates of p; 0: all octaves count
  // The same where a pixel is this wide.
  Octaves seen(float width) const { return {count, roughness, width}; }
};

// Fractional Brownian motion: sum of octaves of noise.
float fbm(const vec3& p, const Octaves& octaves);
// Sum of octaves of |noise|; octaves left out count with their mean, 0.2.
float turbulence(const vec3& p, const Octaves& octaves);

}  // namespace pssmlt
