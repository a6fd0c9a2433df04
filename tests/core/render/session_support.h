// Small scenes for tests of the session, with plugins or with toys in their layers.
#pragma once

#include <string>

#include "app/defaults.h"
#include "core/render/render.h"
#include "core/scene/parser.h"
#include "tests/support/toy.h"

namespace pssmlt::test {

// A lit sphere over a plane; odd size, a filter wider than a pixel.
inline std::string small_scene(const std::string& before = "") {
  return R"(Film "rgb" "integer xresolution" 19 "integer yresolution" 13
PixelFilter "gaussian"
LookAt 0 -4 1.5  0 0 0.5  0 0 1
Camera "perspective" "float fov" 50
)" + before +
         R"(
WorldBegin
LightSource "point" "point3 from" [ 1 -2 3 ] "rgb I" [ 20 18 15 ]
AttributeBegin
Translate 0 0 4
AreaLightSource "diffuse" "rgb L" [ 3 4 5 ] "bool twosided" true
Shape "disk"
AttributeEnd
Material "diffuse" "rgb reflectance" [ .7 .5 .3 ]
Shape "disk" "float radius" 5
Material "dielectric"
Translate 0 0 .6
Shape "sphere" "float radius" .5
)";
}

inline BuiltScene build_small(const std::string& integrator, const std::string& sampler,
                              const std::string& before = "", BuildOptions options = {}) {
  options.defaults = default_plugins();
  if (!integrator.empty()) options.integrator = integrator;
  if (!sampler.empty()) options.sampler = sampler;
  // A chain on so small a picture needs no large bootstrap.
  if (sampler == "pssmlt") options.set.push_back("sampler.bootstrapsamples=2000");
  return build_scene(parse_string(small_scene(before), "small"), options);
}

// The scene with a function in place of its integrator; emission's scale does not matter then.
inline BuiltScene build_toy(ToyIntegrator::Function f, const std::string& sampler,
                            std::optional<ivec2> size = {}) {
  BuildOptions options;
  options.size = size;
  BuiltScene scene = build_small("path", sampler, "", options);
  scene.layers[0].integrator = std::make_shared<ToyIntegrator>(std::move(f));
  return scene;
}

inline RenderSettings settings_for(double spp, int threads = 2, uint64_t seed = 1) {
  RenderSettings s;
  s.spp = spp;
  s.threads = threads;
  s.seed = seed;
  return s;
}

}  // namespace pssmlt::test
