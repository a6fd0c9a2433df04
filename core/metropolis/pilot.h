// Independent samples before the render, for what has to be known of the picture in advance.
#pragma once

#include <span>
#include <vector>

#include "core/sampler.h"
#include "core/sampling/raster_map.h"
#include "core/sampling/splats.h"

namespace pssmlt {

// A splat of the pilot.
struct PilotSplat {
  vec2 raster{0.f};   // [pixels]
  float value = 0.f;  // luminance [W/(m^2 sr)]
};

// The splats of many independent samples, in their order.
class Pilot {
 public:
  // Where camera splats of this credit land [pixels]; the window's middle if they land nowhere.
  static dvec2 centre(const PixelCredit& credit, const RasterFrame& frame);
  void add(const Splats& splats, const PixelCredit& camera, const RasterFrame& frame);
  void append(const Pilot& other);
  size_t samples() const { return ends_.size(); }
  size_t finds() const { return finds_; }  // samples with light
  std::span<const PilotSplat> sample(size_t i) const {
    const size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {splats_.data() + begin, ends_[i] - begin};
  }
  std::span<const PilotSplat> all() const { return splats_; }

 private:
  std::vector<PilotSplat> splats_;
  std::vector<size_t> ends_;
  size_t finds_ = 0;
};

// The same number in every pixel, if there are enough. count = 0: four a pixel, within limits, and
// up to 32 times as many where only few find light. A pure function of the seed.
Pilot run_pilot(const SamplerContext& context, uint64_t seed, int count);

}  // namespace pssmlt
