// Where chains on trial leave their credits.
#pragma once

#include <array>
#include <vector>

#include "core/excess/local_mean.h"
#include "core/sampler.h"

namespace pssmlt {

// What chains credited to pixels.
class TrialSink final : public SplatSink {
 public:
  struct Credit {
    int group = 0, pixel = 0;
    double value = 0.0;  // [local means]
  };
  // scales: of the two planes.
  TrialSink(const RasterFrame& frame, const LocalMean& mean, std::array<double, 2> scales)
      : frame_(frame), mean_(mean), scales_(scales) {}
  void add(int plane, const Splats& splats, const PixelCredit& camera, double weight,
           int group) override {
    for (const Splat& s : splats.all()) {
      const dvec2 raster = s.from_camera ? Pilot::centre(camera, frame_) : s.raster;
      const int pixel = pixel_at(raster);
      if (pixel < 0) continue;
      const double value = static_cast<double>(luminance(s.value)) / mean_.at(raster);
      credits_.push_back({group, pixel, weight * scales_[static_cast<size_t>(plane)] * value});
    }
  }
  // In the order in which they came.
  std::vector<Credit>& credits() { return credits_; }
  const std::vector<Credit>& credits() const { return credits_; }

 private:
  int pixel_at(const dvec2& raster) const {
    const ivec2 at(glm::floor(raster - dvec2(frame_.crop_min)));
    const ivec2 size = frame_.crop_size();
    const bool inside = at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y;
    return inside ? at.y * size.x + at.x : -1;
  }
  const RasterFrame& frame_;
  const LocalMean& mean_;
  std::array<double, 2> scales_;
  std::vector<Credit> credits_;
};

}  // namespace pssmlt
