// Which classes of paths bring light into a picture, and whether an integrator finds all of them:
// told from what integrators say themselves, never from a list.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/features.h"

namespace pssmlt {

// All classes with up to `bounces` scattering vertices, e.g. "ADSE".
std::vector<std::string> all_path_classes(int bounces);

// Paths that match both expressions; & of whole expressions is part of the language.
inline std::string both_expressions(const std::string& a, const std::string& b) {
  return a + "&" + b;
}

// The first class that belongs to `classes`, has light in a scene with these features and is not
// found by an integrator that sees `sees`; nullopt if it finds all of them. Classes of up to
// max_depth scattering vertices, at most five: longer ones are made of the same letters.
std::optional<std::string> unseen_class(const std::string& sees, const std::string& classes,
                                        const SceneFeatures& features, int max_depth);

}  // namespace pssmlt
