// What a mesh carries a vertex besides its shape, interpolated at a hit. Meshes that do not carry
// it, other shapes and points without a primitive (samples of area lights) have the default.
#pragma once

#include "core/base/rgb.h"
#include "core/hit.h"

namespace pssmlt {

vec2 second_uv(const Hit& hit);        // default: the first set
Rgb vertex_color(const Hit& hit);      // default: white
float vertex_opacity(const Hit& hit);  // default: 1

}  // namespace pssmlt
