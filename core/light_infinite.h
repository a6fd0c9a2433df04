// What lights at infinity share: the disk through which their rays enter the scene.
#pragma once

#include "core/base/frame.h"
#include "core/base/warp.h"
#include "core/light.h"

namespace pssmlt {

// Rays of a light at infinity start on a disk as large as the scene's bounding sphere, behind it
// and facing the direction of flight.
class EntryDisk {
 public:
  void set(const SceneBounds& bounds) {
    center_ = bounds.center;
    // Any positive size will do for a scene without extent.
    radius_ = bounds.radius > 0.f ? bounds.radius : 1.f;
  }
  float area() const { return pi * radius_ * radius_; }  // [m^2]
  float pdf() const { return 1.f / area(); }             // [1/m^2]
  EndpointPoint sample(const vec3& direction, const vec2& u) const {
    const vec2 d = radius_ * concentric_disk(u);
    const Frame frame(direction);
    EndpointPoint at;
    at.position = center_ + d.x * frame.s + d.y * frame.t - radius_ * direction;
    at.normal = direction;
    return at;
  }

 private:
  vec3 center_{0.f};
  float radius_ = 1.f;
};

}  // namespace pssmlt
