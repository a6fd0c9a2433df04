// Spectra as samples over wavelength, the CIE 1931 standard observer, and integrals of one against
// the other.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/base/rgb.h"

namespace pssmlt {

// (wavelength [nm], value), wavelengths strictly ascending, linear in between.
using Samples = std::vector<vec2>;

// The visible range of the standard observer [nm].
inline constexpr int lambda_min = 360, lambda_max = 830;

// What a sampled spectrum is outside the range of its samples.
enum class Outside { Zero, Clamp };

// The value at a wavelength [nm]; 0 if there are no samples.
double evaluate(const Samples& samples, double lambda, Outside outside);

// Colour matching functions x, y, z of the two-degree observer [1]; 0 outside the visible range.
dvec3 cie_1931(double lambda);

// Planck's law: spectral radiance [W/(m^2 sr m)] of a black body at a wavelength [nm] and a
// temperature [K].
double planck(double lambda, double temperature);
// A black body every 5 nm over the visible range, scaled to a maximum of 1 over all wavelengths.
Samples blackbody_samples(double temperature);

// Sum over the visible range, in steps of 1 nm, of f(lambda) times the matching functions.
dvec3 xyz_integral(const std::function<double(double)>& f);

// Illuminant D65 seen by the observer, scaled to Y = 1: the white of linear Rec.709.
const dvec3& d65_white();

// XYZ and linear Rec.709 of an emission spectrum scaled to Y = 1; 0 if it emits nothing visible.
// Rec.709 components are negative for colours out of gamut.
dvec3 emission_xyz(const Samples& samples, Outside outside);
dvec3 emission_rgb(const Samples& samples, Outside outside);

// Linear Rec.709 of a reflectance spectrum (or of any other factor over wavelength) lit by D65: the
// constant spectrum c gives (c, c, c). Components are negative for colours out of gamut.
dvec3 reflectance_rgb(const std::function<double(double)>& factor);

// reflectance_rgb as weights: the sum over i of weights[i] * factor(lambda_min + i). They add up to
// (1, 1, 1).
const std::vector<dvec3>& reflectance_weights();

}  // namespace pssmlt
