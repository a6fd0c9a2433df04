// pbrt's Option directives.
#pragma once

#include "core/filter.h"
#include "core/scene/description.h"

namespace pssmlt {

struct SceneOptions {
  enum class Space { camera_world, camera, world };
  std::optional<uint64_t> seed;
  Space render_space = Space::camera_world;  // what positions are computed in
  float displacement_edge_scale = 1.f;       // factor of all displacement.edgelength
  bool texture_filtering = true;
  bool pixel_jitter = true;  // false: pixels are seen through their centres only
};

// Throws Error at an option of the wrong type or value. Notes go to log: options without effect.
SceneOptions read_scene_options(const SceneDescription& scene, std::vector<std::string>& log);

// In place of the scene's filter where pixels are not jittered: a box too small to be seen.
class PixelCentreFilter final : public Filter {
 public:
  vec2 radius() const override { return vec2(0x1p-10f); }
  float evaluate(const vec2&) const override { return 1.f; }
};

}  // namespace pssmlt
