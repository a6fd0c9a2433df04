// A scene of a comparison: what the user asked for, and the scene as loaded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/compare/technique.h"
#include "core/scene/description.h"

namespace pssmlt::compare {

// A scene with options of its own: a line of a suite file, or a positional argument.
struct SceneRequest {
  std::string file;
  std::string name;       // in tables and file names
  BuildOptions build;     // size, crop, scale and --set
  std::string reference;  // file; "": made
};

// Scenes of a suite file, one a line, with optional options after the name, by blanks:
//   door-ajar.txt size=480x270 name=door reference=door.exr set=integrator.maxdepth=8
// (also scale=0.5, crop=x0,x1,y0,y1; set may be repeated). Files are relative to the suite's
// folder, "#" begins a comment. `base`: the command line's options, over which a line's go.
// Throws Error with file and line.
std::vector<SceneRequest> read_suite(const std::string& file, const BuildOptions& base);
// A scene named on the command line: its name is the file's without ending.
SceneRequest request_for(const std::string& file, const BuildOptions& base);
// Gives scenes of the same name different ones: room, room-2.
void make_names_differ(std::vector<SceneRequest>& scenes);

struct LoadedScene {
  SceneDescription description;
  BuiltScene built;           // with the first technique's layers
  uint64_t content_hash = 0;  // of the scene's text and of the files that its parameters name
  double load_seconds = 0.0;
  // The scene under a technique; geometry is shared. Throws Error that names the technique.
  BuiltScene with(const Technique& technique, const BuildOptions& base) const;
};

// Parses and builds; logs what the scene has to say. Throws Error.
LoadedScene load_scene(const SceneRequest& request, const Technique& first);

// "480x270". Throws Error.
ivec2 parse_size(const std::string& text);
// "x0,x1,y0,y1". Throws Error.
std::array<int, 4> parse_crop(const std::string& text);

}  // namespace pssmlt::compare
