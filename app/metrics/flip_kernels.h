// The filters of FLIP for a viewing distance, as sums of separable kernels.
#pragma once

#include "app/metrics/separable.h"

namespace pssmlt::flip {

// Pixels per degree of visual angle on a screen 3840 pixels and 0.7 m wide, seen from 0.7 m.
inline constexpr double default_pixels_per_degree = 67.0206432766;

// Contrast sensitivity of one opponent channel in space (FLIP, section 4.1.1): over the distance d
// in degrees a1 sqrt(pi / b1) exp(-pi^2 d^2 / b1) + a2 sqrt(pi / b2) exp(-pi^2 d^2 / b2),
// normalised to sum 1 over the pixels within filter_radius().
struct Sensitivity {
  double a1, b1, a2, b2;
};
inline constexpr Sensitivity achromatic{1.0, 0.0047, 0.0, 1e-5};
inline constexpr Sensitivity red_green{1.0, 0.0053, 0.0, 1e-5};
inline constexpr Sensitivity blue_yellow{34.1, 0.04, 13.5, 0.025};
// Three standard deviations of the widest Gaussian [pixels].
int filter_radius(double pixels_per_degree);

// One term of a filter: the same kernel along rows and columns, times a weight that the kernel
// along rows carries already.
struct GaussianTerm {
  Kernel along_row, along_column;
};
std::vector<GaussianTerm> gaussian_terms(const Sensitivity& sensitivity, double pixels_per_degree);

// Detectors (section 4.2): a Gaussian whose standard deviation is half the width of the eye's edge
// filter, and its first (edge) and second (point) derivative across; of both, the weights of either
// sign sum to 1 and -1. The 2-D detector of x is derivative(x) * gaussian(y).
struct Detectors {
  explicit Detectors(double pixels_per_degree);
  Kernel gaussian, edge, point;
};

}  // namespace pssmlt::flip
