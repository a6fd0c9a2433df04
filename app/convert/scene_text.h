// A scene description as text in the format that the parser reads, which gives the same
// description again: the same names and parameters to the bit, the same transformations by the
// same steps. What was inlined stays inlined (Include, attributes, coordinate systems).
#pragma once

#include <filesystem>
#include <string>

#include "core/scene/description.h"

namespace pssmlt {

// folder: of the new file; names of files are written as seen from there. The description must
// have been read with ParseOptions::keep_steps. Throws Error at what the text cannot say.
std::string scene_text(const SceneDescription& scene, const std::filesystem::path& folder);

}  // namespace pssmlt
