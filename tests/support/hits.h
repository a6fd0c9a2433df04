// Surface points for tests of textures.
#pragma once

#include "core/hit.h"

namespace pssmlt::test {

// In the plane z = 0, which (u, v) parametrise by x and y.
inline Hit at_uv(float u, float v) {
  Hit hit;
  hit.uv = {u, v};
  hit.ng = {0.f, 0.f, 1.f};
  hit.dpdu = {1.f, 0.f, 0.f};
  hit.dpdv = {0.f, 1.f, 0.f};
  return hit;
}
inline Hit at_point(const vec3& p) {
  Hit hit = at_uv(0.f, 0.f);
  hit.position = p;
  return hit;
}

}  // namespace pssmlt::test
