// Parameters that kinds of media share.
#pragma once

#include "core/medium.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// Absorption and scattering where the density is 1, and the phase function.
struct ScatteringParameters {
  // Reads "sigma_a", "sigma_s", "scale" and "g"; with `presets` also "preset".
  ScatteringParameters(Parameters& p, bool presets, const Rgb& absorption_fallback,
                       const Rgb& scattering_fallback);
  Rgb absorption{0.f}, scattering{0.f};  // [1/m], scale included
  float g = 0.f;
  Rgb extinction() const { return absorption + scattering; }
};

// "g", checked to lie in (-1, 1).
float read_anisotropy(Parameters& p);
// "Le" and "Lescale": radiance that absorption is worth in emission [W/(m^2 sr)]; 0 if not given.
Rgb read_emitted_radiance(Parameters& p);

}  // namespace pssmlt
