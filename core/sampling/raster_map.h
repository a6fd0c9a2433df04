// How samples meet pixels: the reconstruction filter, importance-sampled for camera paths and
// picked stochastically for light splats.
#pragma once

#include <memory>
#include <vector>

#include "core/camera.h"
#include "core/filter.h"

namespace pssmlt {

// Where a value is credited: weight * value goes to the pixel.
struct PixelCredit {
  int pixel = -1;      // row-major index in the rendered window; -1: outside
  float weight = 0.f;  // may be negative (filters with negative lobes)
};

// The filter is tabulated: constant on each of 64 x 64 cells of its support. Both kinds of splat
// use the table, so that they converge to the same picture; a box is exact. Weights are exact: for
// camera splats they are +-integral |f| / integral f without any variance of their own.
class RasterMap {
 public:
  // Throws Error if the filter's integral is not positive or its radius not in (0, 64] pixels.
  RasterMap(const RasterFrame& frame, std::shared_ptr<const Filter> filter);
  const RasterFrame& frame() const { return frame_; }

  // Raster position of a camera sample: the pair (x, y) in [0,1)^2 selects pixel and, by the
  // fraction left over, an offset with density |f| / integral |f| around the pixel's centre. The
  // credit is sign(f) * integral |f| / integral f at that pixel.
  struct CameraPoint {
    dvec2 raster{0.0};  // [pixels]
    PixelCredit credit;
  };
  CameraPoint camera_point(double x, double y) const;
  // Same for a given pixel (index in the window) and offset numbers in [0,1)^2: what samplers that
  // are not Markov chains use to give every pixel the same number of samples.
  CameraPoint camera_point_in(int pixel, double x, double y) const;
  // Pixel that a light splat at `raster` [pixels] is credited to: one of those of the window in
  // whose support it lies, with probability |f_j| / sum |f|; weight sign(f_j) * sum |f| / integral
  // f. `u` in [0,1). A box that does not overlap its neighbours needs no choice.
  PixelCredit pick(const dvec2& raster, float u) const;
  // The tabulated filter [1] at an offset from the pixel's centre [pixels]; 0 outside its support.
  float filter_value(const dvec2& offset) const;
  // Integral of the tabulated filter [pixels^2].
  float filter_integral() const { return static_cast<float>(integral_); }

  static constexpr int cells = 64;           // of the table, a side
  static constexpr float max_radius = 64.f;  // [pixels]

 private:
  struct Candidates;
  struct Offset {
    dvec2 offset{0.0};  // from the pixel's centre [pixels]
    float weight = 0.f;
  };
  void tabulate(const Filter& filter);
  void accumulate();
  void separate();
  Offset sample_offset(double x, double y) const;
  PixelCredit pick_pair(const Candidates& xs, const Candidates& ys, float u) const;
  PixelCredit pick_separately(const Candidates& xs, const Candidates& ys, float u) const;

  RasterFrame frame_;
  dvec2 radius_{0.5}, cells_a_pixel_{0.0};
  bool pixel_box_ = false;           // constant over exactly one pixel: positions map as they are
  std::vector<float> values_;        // of the cells, row by row
  std::vector<float> column_, row_;  // values_[y][x] = row_[y] column_[x]; empty: not separable
  // Tabulated |f| for inversion: marginal over rows, then conditional over the cells of a row; each
  // starts with 0 and ends with 1.
  std::vector<double> marginal_cdf_, conditional_cdf_;
  std::vector<uint8_t> marginal_guide_, conditional_guide_;
  double integral_ = 1.0, abs_integral_ = 1.0;  // of f and |f| [pixels^2]
};

}  // namespace pssmlt
