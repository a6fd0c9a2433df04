// What scenes say about the coat of a layered material.
#pragma once

#include "core/layered/layer_walk.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// Reads "thickness", "albedo", "g", "maxdepth" and "nsamples" as pbrt-v4 has them.
LayerMedium read_layer_medium(Parameters& p, float eta);

}  // namespace pssmlt
