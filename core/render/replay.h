// Looking at single samples: what --pixel and --replay print.
#pragma once

#include <functional>
#include <string>

#include "core/scene/builder.h"

namespace pssmlt {

using LineListener = std::function<void(const std::string&)>;

// Evaluates `samples` points of every layer in a pixel of the full picture and tells their rays,
// connections and splats line by line. Throws Error if the pixel is outside the rendered window.
void trace_pixel(const BuiltScene& scene, const ivec2& pixel, int samples, uint64_t seed,
                 const LineListener& line);
// Evaluates the sample that a key names ("sobol:seed:pixel:index" or "u:" and numbers) again, bit
// for bit, and tells the same with full precision. `seed` is the render's. Throws Error if the key
// is not understood or belongs to another seed.
void replay_sample(const BuiltScene& scene, const std::string& key, uint64_t seed,
                   const LineListener& line);

}  // namespace pssmlt
