// Lights. Plugins of the kinds "light" (LightSource) and "arealight" (AreaLightSource).
#pragma once

#include <memory>

#include "core/endpoint.h"

namespace pssmlt {

class Shape;

// The sphere around everything that is not infinite, in render space.
struct SceneBounds {
  vec3 center{0.f};
  float radius = 1.f;  // [m]
};

class Light : public Endpoint {
 public:
  // Called once before rendering, when the scene's extent is known (infinite lights need it).
  virtual void prepare(const SceneBounds&) {}
  // Emitted power [W], summed with luminance weights; guides the choice among lights only.
  virtual float power() const = 0;
  // Infinite lights: radiance that arrives along a ray that leaves the scene in `direction`.
  virtual Rgb background(const vec3& direction) const {
    (void)direction;
    return Rgb(0.f);
  }
};

}  // namespace pssmlt
