#include "core/camera_screen.h"

namespace pssmlt {

void read_shutter(Parameters& p) {
  const float open = p.number("shutteropen", 0.f, "s", "When the exposure begins.");
  const float close = p.number("shutterclose", 1.f, "s", "When it ends.");
  if (!(open <= close))
    p.fail("shutterclose", "\"shutterclose\" must not be before \"shutteropen\"");
}

ScreenMap::ScreenMap(Parameters& p, const RasterFrame& frame) : frame_(frame) {
  const double natural = static_cast<double>(frame.resolution.x) / frame.resolution.y;
  const double aspect = static_cast<double>(
      p.number("frameaspectratio", static_cast<float>(natural), "",
               "Width of the picture over its height; default: that of the resolution."));
  const std::vector<float> window =
      p.numbers("screenwindow", "",
                "xmin xmax ymin ymax of the picture; default: -1 to 1 along the shorter axis.");
  read_shutter(p);
  if (!(aspect > 0.0)) p.fail("frameaspectratio", "\"frameaspectratio\" must be positive");
  dvec2 low = -dvec2(std::max(aspect, 1.0), std::max(1.0 / aspect, 1.0)), high = -low;
  if (p.has("screenwindow") && window.size() != 4)
    p.fail("screenwindow", "\"screenwindow\" needs four numbers: xmin xmax ymin ymax");
  if (window.size() == 4) {
    low = {window[0], window[2]};
    high = {window[1], window[3]};
    if (low.x == high.x || low.y == high.y)
      p.fail("screenwindow", "\"screenwindow\" must not be empty");
  }
  const dvec2 resolution(frame.resolution);
  origin_ = {low.x, high.y};
  pixel_ = {(high.x - low.x) / resolution.x, (low.y - high.y) / resolution.y};
}

}  // namespace pssmlt
