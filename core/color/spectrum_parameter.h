// How a colour or spectrum parameter of a scene file becomes RGB or samples over wavelength.
#pragma once

#include <vector>

#include "core/base/rgb.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// The linear Rec.709 value of a parameter of type Rgb, Spectrum or Blackbody: what the spectral
// renderer that defines the format, pbrt-v4, shows in its image with its default sensor (the CIE
// 1931 observer, no white balance) and an sRGB film.
//
// Illuminant: pbrt-v4 divides the scale of every light by the luminance Y of its spectrum; of an
//   RGB light it divides by that of the colour space's white only. So, seen directly, a light of
//   rgb (r, g, b) shows (r, g, b), and a spectrum or a black body, whatever its magnitude, shows
//   its chromaticity with Y = 1, times the light's "scale". There is no adaptation to white: a
//   black body is (1.93, 0.80, 0.19) at 2700 K and (1.04, 0.98, 1.04) at 6500 K, stdillum-D65 is
//   (1, 1, 1). A light's photometric "power" and "illuminance" therefore need no constant: with
//   this colour the luminous flux of a point light is 4 pi, and so on.
// Albedo: the spectrum, clipped to [0, 1], as a reflectance lit by D65; components in [0, 1].
// Unbounded: the same integral without the upper limit (eta, k, extinction coefficients).
//
// Inline samples and files are zero outside their range, named spectra continue. What is clipped
// (negative components of colours outside Rec.709, reflectances above 1) is reported by
// take_color_warnings() of core/color/color_warnings.h. Throws Error at the parameter.
Rgb spectrum_to_rgb(const Parameter& parameter, SpectrumUse use, const SceneResolver& resolver);

// (wavelength [nm], value), wavelengths ascending, not empty, of a parameter of type Spectrum
// (inline, named or file) or Blackbody (maximum 1). Throws Error at the parameter.
std::vector<vec2> spectrum_samples(const Parameter& parameter, const SceneResolver& resolver);

}  // namespace pssmlt
