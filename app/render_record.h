// What an image file says about the render that it holds, so that renders can be merged later.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/render/render.h"

namespace pssmlt {

// An estimated relMSE with its 95 % interval.
struct RelativeError {
  double value = 0.0, low = 0.0, high = 0.0;
};

// Numbers drawn by these settings from this seed: what makes two renders the same.
struct RenderPart {
  std::string settings_hash, seed;
  bool operator==(const RenderPart&) const = default;
};

struct RenderRecord {
  std::string scene, scene_hash;
  std::string picture_hash;         // see BuiltScene::picture_hash
  std::string integrator, sampler;  // names, of all layers and parts
  std::vector<RenderPart> parts;    // one for a render, more for what was merged
  double samples = 0.0;             // of all layers
  double seconds = 0.0;             // wall time, summed over the parts [s]
  std::optional<RelativeError> error;
  std::string unknown_error;  // why there is none
  // True if all parts are of one technique with the same parameters.
  bool one_technique() const;
};

RenderRecord make_record(const std::string& scene_path, const BuiltScene& scene, uint64_t seed,
                         const RenderResult& result);
ImageMetadata to_metadata(const RenderRecord& record);
// nullopt if a hash, the seed or the number of samples is not there or not readable.
std::optional<RenderRecord> read_record(const ImageMetadata& metadata);

}  // namespace pssmlt
