// The wavelength of a path. Rendering is in RGB; a path that meets glass whose index varies with
// the wavelength goes on as light of one wavelength, drawn by one number of the shared stream, and
// carries that wavelength's colour, once. Paths that meet none read no number.
#pragma once

#include "core/base/rgb.h"

namespace pssmlt {

class PrimarySample;

struct Wavelength {
  float nanometres = 0.f;
  // Linear Rec.709 of this wavelength over its density [1]: the mean over u is white. Monochromatic
  // light lies outside the gamut; components that would be negative are 0, which makes the spectrum
  // paler than it is.
  Rgb colour{0.f};
};

// Drawn by the mean of the colour's components.
Wavelength draw_wavelength(float u);
// The path's own; reads its number.
Wavelength path_wavelength(PrimarySample& u);

}  // namespace pssmlt
