// How bright the picture is about a pixel, as a pilot found it: what samples are measured by where
// relative errors matter. Any positive map gives a correct picture; a good one a quieter picture.
#pragma once

#include <span>
#include <vector>

#include "core/excess/pilot.h"

namespace pssmlt {

// Means over equal cells of the window.
class MeanGrid {
 public:
  MeanGrid() = default;
  // About so many of the pilot's samples with light to a cell, but no cell smaller than a pixel.
  // What is above `outlier` times the mean that `cap` has there is clamped to that.
  MeanGrid(const Pilot& pilot, double samples_a_cell, const MeanGrid* cap = nullptr);
  void smooth();        // by 1 2 1 in each direction
  void take_medians();  // of each cell and its neighbours
  double mean() const;
  // Between cells' centres, and of the cell itself. Outside the window that of the nearest cell.
  double between(const dvec2& raster) const;
  double nearest(const dvec2& raster) const;

 private:
  dvec2 cell_position(const dvec2& raster) const;
  ivec2 cell_at(const dvec2& raster) const;
  size_t index(const ivec2& c) const {
    return static_cast<size_t>(c.y) * static_cast<size_t>(cells_.x) + static_cast<size_t>(c.x);
  }
  RasterFrame frame_;
  ivec2 cells_{1, 1};
  std::vector<double> values_{0.0};  // [W/(m^2 sr)], rows from the window's first
};

class LocalMean {
 public:
  LocalMean() = default;
  // The larger of two: a smooth one of cells of some hundred samples, in which single bright
  // samples are clamped, and medians of neighbouring cells of few, which follow what is bright in
  // all samples and not what is in some. All 1 if the pilot found nothing.
  explicit LocalMean(const Pilot& pilot);
  // Cells of the pilot's lattice that may be far brighter than that and rightly so (lamps and
  // mirrored lamps of the size of a pixel, and their edges): those with a very bright camera
  // sample, or whose neighbours have several, or are settled. None if that would be many: bright
  // samples are outliers then.
  std::vector<uint32_t> doubtful(const Pilot& pilot) const;
  // Cells with many samples: sets their mean without the largest sample, where that is far above
  // what is known otherwise.
  void settle(const Pilot& some);
  // sqrt(local mean^2 + relative_mse_epsilon * mean^2) [W/(m^2 sr)], as relMSE weighs errors there;
  // positive. `raster` [pixels], may lie outside the window.
  double at(const dvec2& raster) const;
  // Sum of a sample's splats' luminances, each divided by the local mean where it lands.
  double relative(const Splats& splats, const PixelCredit& camera) const;

 private:
  // Of the pixel that is sampled there [pixels].
  dvec2 centre(const PilotLattice& lattice, uint32_t cell) const;
  RasterFrame frame_;
  PilotLattice lattice_;
  MeanGrid coarse_, fine_;
  std::vector<float> settled_;  // by cells of the lattice; 0: nothing special [W/(m^2 sr)]
  double floor2_ = 0.0;         // relative_mse_epsilon * mean^2; 0: nothing is known
};

}  // namespace pssmlt
