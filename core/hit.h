// A point on a surface as rays find it, with everything that textures and materials may ask.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

struct Primitive;

// All in render space. Directions stored elsewhere point away from the surface.
struct Hit {
  vec3 position{0.f};         // [m]
  vec3 error{0.f};            // bound on the rounding error of position, per axis [m]
  vec3 ng{0.f};               // geometric normal, unit, on the side that the shape calls outside
  vec3 ns{0.f};               // shading normal, unit, in the hemisphere of ng
  vec3 dpdu{0.f}, dpdv{0.f};  // [m per unit of u, v]
  vec3 dndu{0.f}, dndv{0.f};  // change of the shading normal
  vec2 uv{0.f};
  float distance = 0.f;   // along the ray that found it [m]
  float footprint = 0.f;  // diameter of a pixel at this point's distance to the camera [m]
  uint32_t element = 0;   // triangle of a mesh, 0 otherwise
  vec2 where{0.f};        // of a mesh: weights of the triangle's second and third vertex
  const Primitive* primitive = nullptr;
  // Asked of Shape::fill(): false where nothing reads dpdu, dpdv, dndu and dndv, which then are
  // zero.
  bool with_derivatives = true;
};

}  // namespace pssmlt
