// How bright the picture is about a pixel, as a pilot found it: what samples are measured by where
// relative errors matter. Any positive map gives a correct picture; a good one a quieter picture.
#pragma once

#include <span>
#include <vector>

#include "core/metropolis/pilot.h"

namespace pssmlt {

// Two norms of a sample, its splats' luminances divided by the local mean.
struct RelativeNorms {
  double sum = 0.0, sum_squares = 0.0;
};

class LocalMean {
 public:
  LocalMean() = default;
  // Means over cells of some hundred samples, in which single bright samples are clamped; smoothed.
  // All 1 if the pilot found nothing.
  LocalMean(const RasterFrame& frame, const Pilot& pilot);
  // sqrt(local mean^2 + relative_mse_epsilon * mean^2) [W/(m^2 sr)], as relMSE weighs errors there;
  // positive. `raster` [pixels], may lie outside the window.
  double at(const dvec2& raster) const;
  RelativeNorms norms(const Splats& splats, const PixelCredit& camera) const;
  RelativeNorms norms(std::span<const PilotSplat> splats) const;

 private:
  void fill(const Pilot& pilot, const LocalMean* cap);
  void smooth();
  void finish();
  size_t cell(const ivec2& c) const {
    return static_cast<size_t>(c.y) * static_cast<size_t>(cells_.x) + static_cast<size_t>(c.x);
  }

  RasterFrame frame_;
  ivec2 cells_{1, 1};
  std::vector<double> values_{1.0};  // [W/(m^2 sr)], rows from the window's first
};

}  // namespace pssmlt
