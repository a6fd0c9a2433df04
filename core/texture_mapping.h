// How textures find their coordinates at a surface point: those of two dimensions (s, t), with
// pbrt-v4's parameters ("mapping" uv, spherical, cylindrical or planar), solid ones the position in
// the texture's own space.
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
  // Zero where the hit knows no footprint, and for second sets of coordinates.
  TextureFootprint footprint(const Hit& hit) const;

 private:
  enum class Kind { uv, spherical, cylindrical, planar };
  static Kind read_kind(Parameters& p);
  vec2 map_point(const vec3& p) const;
  TextureFootprint uv_footprint(const Hit& hit, const vec3& along, const vec3& across) const;
  vec2 rotated(const vec2& v) const {
    return {cosine_ * v.x - sine_ * v.y, sine_ * v.x + cosine_ * v.y};
  }

  Kind kind_;
  vec2 scale_{1.f}, delta_{0.f};
  float cosine_ = 1.f, sine_ = 0.f;  // of the turn of uv
  bool second_ = false;              // the mesh's second set
  vec3 v1_{1.f, 0.f, 0.f}, v2_{0.f, 1.f, 0.f};
  Transform to_texture_;  // render space to the texture's
};

// The current transformation of the Texture directive places a solid texture.
class TextureMapping3D {
 public:
  explicit TextureMapping3D(const Parameters& p) : to_texture_(p.transform().inverse()) {}
  vec3 map(const Hit& hit) const { return to_texture_.point(hit.position); }
  // The larger of the steps that a pixel's diameter makes in the texture's space along two
  // perpendicular directions in the surface. Zero where the hit knows no footprint.
  float footprint(const Hit& hit) const;

 private:
  Transform to_texture_;  // render space to the texture's
};

}  // namespace pssmlt
