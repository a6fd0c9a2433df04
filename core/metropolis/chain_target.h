// What Markov chains follow, as a function of the splats that an integrator returned.
#pragma once

#include "core/sampling/raster_map.h"
#include "core/sampling/splats.h"

namespace pssmlt {

class ChainTarget {
 public:
  // The target's value at a point, finite and not negative; what is left of the splats is what the
  // point is worth to the picture where the chain visits it. `camera`: where camera splats are
  // credited. A pure function; any number of threads at a time. 0 leaves no splats of any use.
  virtual double evaluate(Splats& splats, const PixelCredit& camera) const = 0;

 protected:
  ~ChainTarget() = default;
};

// The luminance of all splats (Kelemen et al. 2002).
class LuminanceTarget final : public ChainTarget {
 public:
  double evaluate(Splats& splats, const PixelCredit&) const override { return luminance(splats); }
};

}  // namespace pssmlt
