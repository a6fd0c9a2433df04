// Turns a scene description into a scene, its layers and its raster: loads the plugins named,
// checks every parameter, computes features.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/integrator.h"
#include "core/sampler.h"
#include "core/sampling/raster_map.h"
#include "core/scene/description.h"
#include "core/scene/scene.h"

namespace pssmlt {

// Plugins that stand where a scene names none. The core names no plugin: whoever builds scenes
// says (app/defaults.h).
struct DefaultPlugins {
  std::string integrator, sampler, camera, filter, material;
};

// What the command line changes of a scene.
struct BuildOptions {
  DefaultPlugins defaults;
  std::optional<std::string> integrator, sampler;  // replace the scene's (of every layer)
  std::vector<std::string> set;  // "integrator.maxdepth=8", "sampler.sigma=0.02", "camera.fov=30"
  std::optional<ivec2> size;     // of the full picture [pixels]
  float scale = 1.f;             // of the picture's size
  std::optional<std::array<int, 4>> crop;  // x0, x1, y0, y1 [pixels], upper bounds exclusive
  bool honour_clamp = false;               // apply the film's maxcomponentvalue per sample
};

// Names and values of a plugin's parameters.
using PluginValues = std::vector<std::pair<std::string, std::string>>;

// One term of the picture: sampler x integrator x path class; the picture is the sum of the layers.
struct Layer {
  std::string name;
  std::shared_ptr<Integrator> integrator;
  std::shared_ptr<Sampler> sampler;
  std::string integrator_name, sampler_name;
  // Every parameter with its value in force, as text, in the order of the manual.
  PluginValues integrator_values, sampler_values;
};

struct BuiltScene {
  std::shared_ptr<const Scene> scene;
  std::vector<Layer> layers;
  std::shared_ptr<const RasterMap> raster_map;
  std::string output;  // the film's file name, "" if it gives none
  // Layers that the film wants beside the picture where the format holds any (film "gbuffer").
  std::vector<std::string> film_layers;
  // From render space to the axes of a layer of normals: the world's, or the camera's if the film
  // says so. Acts on normals.
  glm::dmat3 normal_axes{1.0};
  float max_component = infinity;  // per sample [W/(m^2 sr)], infinity unless asked for
  // Power of two near the scene's mean radiance: the film accumulates value / radiance_scale and
  // multiplies it back on output, so that its fixed-point range fits every scene.
  double radiance_scale = 1.0;
  // The written picture is balance * radiance * exposure: the time of the exposure * iso / 100, and
  // the colours and the white balance of the film's sensor in linear Rec.709.
  double exposure = 1.0;
  glm::dmat3 balance{1.0};
  std::optional<uint64_t> seed;  // Option "seed" of the scene
  uint64_t scene_hash = 0;       // of the scene's text
  uint64_t settings_hash = 0;    // of all else that decides the picture: names, parameters, size
  // Of what the picture shows, whatever technique computes it: the scene's text, size and window,
  // the range of paths of each layer, what was set of anything but integrators and samplers.
  // Renders that agree in it may be averaged.
  uint64_t picture_hash = 0;
  // Lines for the user: translated names, what is left out; and why the picture may be wrong.
  std::vector<std::string> log, warnings;
};

// Throws Error with a location on anything wrong.
BuiltScene build_scene(const SceneDescription& description, const BuildOptions& options);
// The same scene with layers of its own, by other integrators, samplers and parameters of theirs;
// all else is shared with `built`. The options' size, crop and camera must be those of `built`.
// Throws Error.
BuiltScene with_layers(const BuiltScene& built, const SceneDescription& description,
                       const BuildOptions& options);

}  // namespace pssmlt
