// How textures of two dimensions find their coordinates (s, t) at a surface point, with pbrt-v4's
// parameters: "mapping" uv, spherical, cylindrical or planar.
#pragma once

#include "core/hit.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// What a pixel covers around a point: the change of (s, t) over a pixel's diameter along two
// perpendicular directions in the surface.
struct TextureFootprint {
  vec2 axis0{0.f}, axis1{0.f};
};

class TextureMapping2D {
 public:
  explicit TextureMapping2D(Parameters& p);
  vec2 map(const Hit& hit) const;
  // Zero where the hit knows no footprint.
  TextureFootprint footprint(const Hit& hit) const;

 private:
  enum class Kind { uv, spherical, cylindrical, planar };
  static Kind read_kind(Parameters& p);
  vec2 map_point(const vec3& p) const;
  TextureFootprint uv_footprint(const Hit& hit, const vec3& along, const vec3& across) const;

  Kind kind_;
  vec2 scale_{1.f}, delta_{0.f};
  vec3 v1_{1.f, 0.f, 0.f}, v2_{0.f, 1.f, 0.f};
  Transform to_texture_;  // render space to the texture's
};

}  // namespace pssmlt
