// The reflectance of a conductor over the cosine of incidence, as linear Rec.709.
#pragma once

#include <array>
#include <vector>

#include "core/color/fresnel.h"

namespace pssmlt {

// The spectral reflectance at each angle is lit by D65 and converted to Rec.709; the result is
// tabulated at cosines (i / 128)^2, dense where the curve of a good conductor bends, and linear
// between them in the square root of the cosine. Against the formula the error is below 1e-3
// (tested). Products of such colours over several bounces are not the colour of the product of the
// spectra: that is the price of rendering in RGB.
class FresnelCurve {
 public:
  // Samples (wavelength [nm], value), continued by their end values. `outside` is the refractive
  // index of the medium above (a coating), which divides eta and k.
  static FresnelCurve from_spectra(const std::vector<vec2>& eta, const std::vector<vec2>& k,
                                   float outside = 1.f);
  // Fresnel's formula for each component on its own.
  static FresnelCurve from_rgb(const Rgb& eta, const Rgb& k, float outside = 1.f);
  // eta = 1 and the k that gives this reflectance at normal incidence.
  static FresnelCurve from_reflectance(const Rgb& reflectance, float outside = 1.f);

  // |cos_theta| is used. Components in [0, 1]; exactly 1 at grazing incidence.
  Rgb operator()(float cos_theta) const {
    const float at = std::sqrt(std::min(std::abs(cos_theta), 1.f)) * float(intervals);
    const int i = std::min(int(at), intervals - 1);
    const float t = at - float(i);
    return table_[size_t(i)] * (1.f - t) + table_[size_t(i) + 1] * t;
  }

 private:
  static constexpr int intervals = 128;
  FresnelCurve() = default;
  static float cosine(int i) { return sqr(float(i) / float(intervals)); }

  std::array<Rgb, intervals + 1> table_;
};

}  // namespace pssmlt
