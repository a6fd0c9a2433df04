// A small room with a lamp, 32 x 24 pixels, that every technique sees.
#pragma once

#include "app/compare/scene_job.h"
#include "app/compare/text.h"
#include "app/defaults.h"
#include "tests/app/compare/folder.h"

namespace pssmlt::compare::test {

inline constexpr const char* small_room = R"(Film "rgb" "integer xresolution" 32
  "integer yresolution" 24
PixelFilter "box"
LookAt 0 -3 1  0 0 .8  0 0 1
Camera "perspective" "float fov" 50
Sampler "sobol"
Integrator "path" "integer maxdepth" 4
WorldBegin
AttributeBegin
Translate 0 0 2
AreaLightSource "diffuse" "rgb L" [ 6 5 4 ] "bool twosided" true
Shape "disk" "float radius" .7
AttributeEnd
Material "diffuse" "rgb reflectance" [ .6 .5 .4 ]
Shape "disk" "float radius" 5
Translate 0 0 .5
Shape "sphere" "float radius" .5
)";

inline BuildOptions small_options() {
  BuildOptions options;
  options.defaults = default_plugins();
  return options;
}

inline LoadedScene load_small(const Folder& folder, const BuildOptions& options = small_options()) {
  const std::string file = folder / "room.txt";
  write_file(file, small_room);
  return load_scene(request_for(file, options), parse_technique("path"));
}

}  // namespace pssmlt::compare::test
