// Noise-free companions of the picture, as denoisers want them: what the camera sees first.
#pragma once

#include "core/image/image.h"
#include "core/scene/builder.h"

namespace pssmlt {

struct AuxiliaryImages {
  Image albedo;  // hemispherical albedo of the first surface [1]; 0 where the ray leaves the scene
  Image normal;  // its shading normal, mean over the pixel (not renormalised), in the world's axes
                 // or the camera's, as the scene's film says
  Image depth;   // distance along the ray [m], mean over the rays that hit; 0 where none does
};

inline constexpr int auxiliary_rays = 16;  // per pixel

// Averages over the pixel's filter as the picture does. Deterministic; `threads` as in
// RenderSettings.
AuxiliaryImages render_auxiliary(const BuiltScene& scene, uint64_t seed, int threads);
// Standard deviation of the picture's luminance [its unit]: the square root of `variance` (see
// RenderResult) averaged over 5 x 5 pixels, since one difference of halves says little. Channel Y.
Image error_image(const Image& variance);

}  // namespace pssmlt
