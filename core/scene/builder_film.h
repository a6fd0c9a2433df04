// The film's side of building: picture size, crop window, exposure.
#pragma once

#include "core/scene/builder.h"

namespace pssmlt {

struct FilmDirective {
  RasterFrame frame;  // filter_radius left for the filter
  std::string output;
  float max_component = infinity;
  double exposure = 1.0;
};

// Reads Film with the command line's size, scale and crop. Throws Error (located) on sizes and
// windows that make no picture. Notes go to log.
FilmDirective read_film(const SceneDescription& scene, const BuildOptions& options,
                        std::vector<std::string>& log);

}  // namespace pssmlt
