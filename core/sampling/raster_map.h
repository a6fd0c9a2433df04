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
  int pixel = -1;       // row-major index in the rendered window; -1: outside
  float weight = 0.f;   // may be negative (filters with negative lobes)
};

class RasterMap {
 public:
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
  // Pixel that a light splat at `raster` [pixels] is credited to, one of those in whose support it
  // lies, with probability |f_j| / sum |f|; weight sign(f_j) * sum |f| / integral f. `u` in [0,1).
  PixelCredit pick(const dvec2& raster, float u) const;

 private:
  RasterFrame frame_;
  std::shared_ptr<const Filter> filter_;
  // Tabulated |f| for inversion, row by row: marginal over y, conditional over x.
  std::vector<float> marginal_cdf_, conditional_cdf_;
  std::vector<float> cell_sign_;
  int cells_ = 0;
  float integral_ = 1.f, abs_integral_ = 1.f;  // of f and |f| [pixels^2]
};

}  // namespace pssmlt
