// The index of a glass by wavelength, of its index n at the d line and its Abbe number V: the first
// two terms of Cauchy's equation, n(l) = A + B / l^2, through n_F - n_C = (n_d - 1) / V.
//
// Source: Khronos Group 2024, KHR_materials_dispersion.
#pragma once

#include <algorithm>

namespace pssmlt {

// Fraunhofer's lines, where glasses are specified [nm].
inline constexpr double hydrogen_f = 486.13, helium_d = 587.56, hydrogen_c = 656.27;

class CauchyIndex {
 public:
  CauchyIndex() = default;
  // dispersion: 20 / V, finite and not negative.
  CauchyIndex(float at_d, float dispersion)
      : at_d_(static_cast<double>(at_d)),
        b_((at_d_ - 1.0) * static_cast<double>(dispersion) /
           (20.0 * (inverse_square(hydrogen_f) - inverse_square(hydrogen_c)))) {}

  bool varies() const { return b_ != 0.0; }
  // Between 1.001 and 10, or at_d if that lies outside. The source's lower limit is 1, where there
  // would be no boundary; glasses (V of 10 and more) are far from both.
  float at(float nanometres) const {
    const double n =
        at_d_ + b_ * (inverse_square(static_cast<double>(nanometres)) - inverse_square(helium_d));
    return static_cast<float>(std::clamp(n, std::min(at_d_, 1.001), std::max(at_d_, 10.0)));
  }

 private:
  static constexpr double inverse_square(double x) { return 1.0 / (x * x); }

  double at_d_ = 1.5;
  double b_ = 0.0;  // [nm^2]
};

}  // namespace pssmlt
