// The screen of a camera: the rectangle that the full picture covers in the camera's own
// coordinates, x to the right and y up.
#pragma once

#include "core/camera.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// Reads and checks "shutteropen" and "shutterclose".
void read_shutter(Parameters& p);

class ScreenMap {
 public:
  // Reads "frameaspectratio", "screenwindow", "shutteropen" and "shutterclose".
  ScreenMap(Parameters& p, const RasterFrame& frame);

  // Raster position [pixels] to screen coordinates and back.
  dvec2 screen(const dvec2& raster) const { return origin_ + raster * pixel_; }
  dvec2 raster(const dvec2& screen) const { return (screen - origin_) / pixel_; }
  // Size of a pixel in screen coordinates; y is negative, since raster rows go down.
  const dvec2& pixel() const { return pixel_; }
  dvec2 center() const { return screen(0.5 * dvec2(frame_.resolution)); }
  // True within the rendered window and the filter's radius around it.
  bool shows(const dvec2& raster) const { return frame_.shows(raster); }
  // Pixels in the rendered window.
  double pixels() const { return frame_.pixels(); }

 private:
  RasterFrame frame_;
  dvec2 origin_{0.0}, pixel_{1.0};
};

}  // namespace pssmlt
