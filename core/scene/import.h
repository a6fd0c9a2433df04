// Scenes in formats other than the text format: modules ("import_gltf") that fill a description
// through the state that the text's directives fill it through. Which module reads a file follows
// from its ending.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_state.h"

namespace pssmlt {

// What a module gets.
struct ImportedFile {
  std::string path;
  Location where;     // of the directive Import; no file: the file is the whole scene
  std::string label;  // different for every imported file of a scene, for names
  // Also gives options (film, camera), ends them by WorldBegin, and lights what has no light.
  bool whole_scene = false;
};
struct ImportTarget {
  SceneState& state;  // the graphics state in force applies, as to directives
  SceneDescription& scene;
  std::vector<std::string>& log;  // lines for the user
};
// Throws Error, as a rule with the file and the place in it.
inline constexpr const char* import_symbol = "pssmlt_import";
using ImportFunction = void(const ImportedFile& file, const ImportTarget& target);

// By the file's ending.
bool is_importable(const std::string& path);
// Loads the module and reads the file; `log` may be null. Throws Error.
void import_file(const ImportedFile& file, SceneState& state, SceneDescription& scene,
                 std::vector<std::string>* log);
// The file as a scene by itself.
SceneDescription import_scene(const std::string& path, std::vector<std::string>* log);

}  // namespace pssmlt
