// What bends the shading frame of a surface and leaves its shape alone: a height field ("bump map")
// or a map of normals.
#pragma once

#include <memory>
#include <string>

#include "core/base/frame.h"
#include "core/hit.h"
#include "core/texture.h"

namespace pssmlt {

class ShadingNormals {
 public:
  virtual ~ShadingNormals() = default;
  // The frame whose z is the bent normal, on the side of the geometric one, x along dpdu; the
  // unbent frame where the map says nothing (no length, NaN).
  virtual Frame frame(const Hit& hit) const = 0;
};

// Height [m] above the surface (Blinn 1978; Pharr, Jakob, Humphreys 2023, section 10.5.3).
std::shared_ptr<const ShadingNormals> bend_by_height(std::shared_ptr<const Texture<float>> height);
// An image of normals in the frame of dpdu and the shading normal, components n stored as
// (n + 1) / 2, not encoded for display; looked up bilinearly and repeated, as pbrt-v4 does. Throws
// Error if the file is missing, broken, or has less than three channels.
std::shared_ptr<const ShadingNormals> bend_by_map(const std::string& file);
// The same from a texture's colour, as glTF 2.0 has it: x and y times `scale`, y along growing v,
// on mirrored texture coordinates as well.
std::shared_ptr<const ShadingNormals> bend_by_texture(std::shared_ptr<const Texture<Rgb>> normals,
                                                      float scale);

}  // namespace pssmlt
