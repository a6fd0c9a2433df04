// Boxes along the axes.
#pragma once

#include <glm/common.hpp>

#include "core/base/math.h"

namespace pssmlt {

struct Bounds {
  vec3 min{infinity}, max{-infinity};  // empty until a point is added [m]
  void add(const vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void add(const Bounds& b) {
    min = glm::min(min, b.min);
    max = glm::max(max, b.max);
  }
};

}  // namespace pssmlt
