// The refractive index of dielectric materials, as scenes give it.
#pragma once

#include "core/scene/parameters.h"

namespace pssmlt {

// Reads "eta": a number, or a spectrum of which the value at 587.6 nm (the d line of helium, where
// glasses are specified) is taken, with a log line if it varies: dispersion is not rendered yet.
// Positive; throws Error otherwise.
float read_dielectric_index(Parameters& p);

}  // namespace pssmlt
