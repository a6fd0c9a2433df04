// The plugins that stand where a scene names none: pbrt's defaults, but for the sampler.
#pragma once

#include "core/scene/builder.h"

namespace pssmlt {

inline DefaultPlugins default_plugins() {
  return {.integrator = "path",
          .sampler = "sobol",
          .camera = "perspective",
          .filter = "gaussian",
          .material = "diffuse"};
}

}  // namespace pssmlt
