// Lights. Plugins of the kinds "light" (LightSource) and "arealight" (AreaLightSource).
#pragma once

#include <memory>

#include "core/base/bounds.h"
#include "core/base/cone.h"
#include "core/endpoint.h"

namespace pssmlt {

class Shape;

// The sphere around everything that is not infinite, in render space.
struct SceneBounds {
  vec3 center{0.f};
  float radius = 1.f;  // [m]
};

// Where a light is and where to it shines, in render space: what the choice among many lights goes
// by (core/scene/light_tree.h).
struct LightBounds {
  Bounds box;              // around all its points [m]
  DirectionCone normals;   // around the normals there; of a point: of its directions
  float cos_spread = 0.f;  // cosine of the largest angle to a normal under which it shines
  bool two_sided = false;  // shines along the reversed normals as well
  float intensity = 0.f;   // along a normal, of all points together, as power() weighted [W/sr]
};

class Light : public Endpoint {
 public:
  // Called once before rendering, when the scene's extent is known (infinite lights need it).
  virtual void prepare(const SceneBounds&) {}
  // Emitted power [W], summed with luminance weights; guides the choice among lights only.
  virtual float power() const = 0;
  // nullopt: at infinity, or not known; such a light is chosen by its power wherever one looks
  // from.
  virtual std::optional<LightBounds> bounds() const { return std::nullopt; }
  // Infinite lights: radiance that arrives along a ray that leaves the scene in `direction`.
  virtual Rgb background(const vec3& direction) const {
    (void)direction;
    return Rgb(0.f);
  }
};

}  // namespace pssmlt
