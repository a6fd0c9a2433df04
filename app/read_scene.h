// How the command reads scenes: in today's format or in pbrt-v3's.
#pragma once

#include "app/dialect/pbrt_v3.h"
#include "core/scene/parser.h"

namespace pssmlt {

// As parse_file; what was translated is said in the log.
inline SceneDescription read_scene(const std::string& path, std::vector<std::string>* log) {
  return parse_file(path, log, {.dialect = &pbrt_v3()});
}

}  // namespace pssmlt
