#include "core/scene/builder_options.h"

namespace pssmlt {
namespace {

[[noreturn]] void refuse(const Parameter& p, const std::string& needed) {
  throw Error(p.where, "option \"" + p.name + "\" must be " + needed);
}

bool flag(const Parameter& p) {
  if (p.type != ParameterType::Bool || p.bools.size() != 1) refuse(p, "one bool");
  return p.bools[0] != 0;
}

float positive(const Parameter& p) {
  if (p.type != ParameterType::Float || p.floats.size() != 1 || !(p.floats[0] > 0.f))
    refuse(p, "one positive float");
  return p.floats[0];
}

SceneOptions::Space space(const Parameter& p) {
  const std::string name =
      p.type == ParameterType::String && p.strings.size() == 1 ? p.strings[0] : "";
  if (name == "cameraworld") return SceneOptions::Space::camera_world;
  if (name == "camera") return SceneOptions::Space::camera;
  if (name == "world") return SceneOptions::Space::world;
  refuse(p, "\"cameraworld\", \"camera\" or \"world\"");
}

}  // namespace

SceneOptions read_scene_options(const SceneDescription& scene, std::vector<std::string>& log) {
  SceneOptions options;
  for (const Parameter& p : scene.options) {
    if (p.name == "seed" && p.type == ParameterType::Integer && !p.ints.empty()) {
      options.seed = static_cast<uint64_t>(p.ints[0]);
    } else if (p.name == "rendercoordsys") {
      options.render_space = space(p);
    } else if (p.name == "displacementedgescale") {
      options.displacement_edge_scale = positive(p);
    } else if (p.name == "disabletexturefiltering") {
      options.texture_filtering = !flag(p);
    } else if (p.name == "disablepixeljitter") {
      options.pixel_jitter = !flag(p);
    } else {
      log.push_back("option \"" + p.name + "\" has no effect here");
    }
  }
  return options;
}

}  // namespace pssmlt
