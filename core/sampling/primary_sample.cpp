#include "core/sampling/primary_sample.h"

#include <algorithm>

#include "core/sampling/raster_map.h"

namespace pssmlt {

void StreamNumbers::grow(uint32_t index) {
  const size_t size = std::max<size_t>({64, 2 * blocks_.size(), size_t{index} + 1});
  blocks_.resize(size);
  stamps_.resize(size, 0);
}

// The stamp wrapped around: old stamps might look new.
void StreamNumbers::restart() {
  std::fill(stamps_.begin(), stamps_.end(), 0u);
  stamp_ = 1;
}

void PrimarySample::find_raster() {
  const auto camera = static_cast<size_t>(Stream::camera);
  if (streams_[camera]->find(0) == nullptr) (void)numbers(Stream::camera, 0);
  const NumberBlock& block = *streams_[camera]->find(0);
  const double x = to_unit_double(block[0]);
  const double y = to_unit_double(block[1]);
  const RasterMap::CameraPoint point = fixed_pixel_ >= 0
                                           ? raster_map_->camera_point_in(fixed_pixel_, x, y)
                                           : raster_map_->camera_point(x, y);
  raster_ = point.raster;
  raster_pixel_ = point.credit.pixel;
  raster_weight_ = point.credit.weight;
  raster_known_ = true;
}

}  // namespace pssmlt
