// Pieces of scene text that several groups of the catalogue share.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace pssmlt::stress {

// A picture of width x height pixels with the box filter.
inline std::string film(int width, int height) {
  return fmt::format(
      "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\nPixelFilter \"box\"\n",
      width, height);
}

// A small room: a lamp, a point light, a faint sky, paint, rough metal, glass, a ball of fog; seen
// through a lens. Everything that has a unit of length or radiance is written with its factor.
struct Lab {
  double length = 1.0, radiance = 1.0;
  double x = 0.0, y = 0.0, z = 0.0;  // where it lies, by coordinates
  bool by_transform = false;         // where it lies, by Translate
  int height = 16;                   // of the picture [pixels]
};
std::string lab(const Lab& l);

// Orthographic view of the plane z = 0 from above, tilted about y, of the window half_width x
// half_height [scene units].
std::string plane_view(int size, double half_width, double half_height, double tilt_degrees = 0.0,
                       double distance = 10.0);

// Radiance of the quarters of a square, 2 half wide, that reflects .6 of what a light of 3 W/sr at
// height 1.5 above its centre sends: I cos / d^2.
std::vector<double> lit_quarters(double half);

// Reflectance of a smooth interface for unpolarised light (Fresnel); eta: index behind over before.
double fresnel_reflectance(double cosine, double eta);

}  // namespace pssmlt::stress
