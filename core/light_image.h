// Images that lights emit, as textures of radiance or intensity.
#pragma once

#include <string>
#include <vector>

#include "core/base/rgb.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// Row-major, upper row first; every pixel is finite and not negative.
struct LightImage {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
  bool empty() const { return pixels.empty(); }
  const Rgb& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  // The pixel that a point of the unit square lies in; (0, 0) is the corner of the upper row.
  const Rgb& nearest(const dvec2& uv) const;
};

// Reads the file that the parameter "filename" names. Throws an Error there if it is missing,
// broken or empty or has pixels that are not finite numbers; clips negative ones, with a warning.
LightImage read_light_image(const Parameters& p, const std::string& file);

// How an image covers the sphere: Clarberg's equal-area map, or longitude across, latitude down.
enum class SphereMapping { equal_area, lat_long };
// Reads the parameter "mapping".
SphereMapping read_sphere_mapping(Parameters& p);
// read_light_image for maps of the sphere, of which equal-area ones are square.
LightImage read_sphere_image(const Parameters& p, const std::string& file, SphereMapping mapping);

}  // namespace pssmlt
