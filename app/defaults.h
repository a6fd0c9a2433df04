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

// Of the commands that render what a user asks for: the sampler chooses what it can.
inline DefaultPlugins command_plugins() {
  DefaultPlugins plugins = default_plugins();
  plugins.sampler = "auto";
  return plugins;
}

}  // namespace pssmlt
