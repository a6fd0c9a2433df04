#include "core/scene/builder_hashes.h"

#include <fmt/format.h>

#include "core/path/path_expression.h"

namespace pssmlt {

void set_hashes(BuiltScene& built, const SceneDescription& description, const BuildOptions& options,
                std::string settings) {
  built.scene_hash = description.hash[0] ^ mix_bits(description.hash[1]);
  const RasterFrame& r = built.raster_map->frame();
  const std::string raster =
      fmt::format("{} {} {} {} {} {} {}", r.resolution.x, r.resolution.y, r.crop_min.x,
                  r.crop_min.y, r.crop_max.x, r.crop_max.y, built.max_component);
  for (const std::string& assignment : options.set) settings += assignment + "\n";
  std::array<uint64_t, 2> state{};
  hash_text(state, settings + raster);
  built.settings_hash = state[0] ^ mix_bits(state[1]);
  std::string shown = fmt::format("{:016x} {}\n", built.scene_hash, raster);
  for (const Layer& layer : built.layers) {
    const PathLimits& limits = layer.integrator->limits();
    shown += fmt::format("{} {} {}\n", limits.min_bounces, limits.max_bounces, limits.paths.text());
  }
  for (const std::string& set : options.set) {
    if (!set.starts_with("integrator.") && !set.starts_with("sampler.")) shown += set + "\n";
  }
  state = {};
  hash_text(state, shown);
  built.picture_hash = state[0] ^ mix_bits(state[1]);
}

}  // namespace pssmlt
