// Reconstruction filters: f(x, y) around a pixel's centre, separable or not, possibly negative.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

class Filter {
 public:
  virtual ~Filter() = default;
  // Half width of the support in x and y [pixels].
  virtual vec2 radius() const = 0;
  // Value at an offset from the pixel centre [1]; 0 outside the support.
  virtual float evaluate(const vec2& offset) const = 0;
};

}  // namespace pssmlt
