// What tells one render from another: hashes for checkpoints, averages and caches.
#pragma once

#include <string>

#include "core/scene/builder.h"

namespace pssmlt {

// Fills in scene_hash, settings_hash and picture_hash. `settings`: of the layers, as build_layers()
// collects them.
void set_hashes(BuiltScene& built, const SceneDescription& description, const BuildOptions& options,
                std::string settings);

}  // namespace pssmlt
