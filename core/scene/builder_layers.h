// Layers: which sampler runs which integrator, from the scene and the command line.
#pragma once

#include "core/scene/builder.h"

namespace pssmlt {

// Makes every layer's sampler and integrator. `settings` collects a text of all that decides the
// picture, for the settings hash.
std::vector<Layer> build_layers(const SceneDescription& scene, const BuildOptions& options,
                                std::string& settings, std::vector<std::string>& log);

// Applies the assignments "owner.name=value" of one owner ("integrator", "sampler" or
// "camera") to a directive; the types come from the parameters that `docs` documents. Throws Error
// on unknown names and values that do not fit.
void apply_assignments(const std::vector<std::string>& set, const std::string& owner,
                       const std::vector<ParameterDoc>& docs, Directive& directive);

}  // namespace pssmlt
