// FLIP, the difference that a viewer sees when flipping between two images: Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", HPG 2020 (images as displayed); Andersson, Nilsson, Shirley, Akenine-Moeller,
// "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021 (radiances).
#pragma once

#include <span>
#include <vector>

#include "app/metrics/flip_kernels.h"
#include "core/base/rgb.h"
#include "core/render/worker_pool.h"

namespace pssmlt::flip {

// A colour image, row-major; linear Rec.709.
struct View {
  int width, height;
  std::span<const Rgb> colours;
};

// Error per pixel in [0, 1] of two images as displayed: linear light, [0, 1] (values outside are
// clamped). Symmetric. Throws Error if pixels_per_degree is not in [1, 1000].
Plane displayed_error(const View& picture, const View& reference, WorkerPool& pool,
                      double pixels_per_degree = default_pixels_per_degree);

// Exposures in stops at which radiances are looked at.
struct Exposures {
  double start = 0.0, stop = 0.0;
  int count = 1;
  double at(int i) const { return count < 2 ? start : start + (stop - start) * i / (count - 1); }
};
// From the one that maps the largest luminance to where the tone curve reaches 0.85, to the one
// that does so to the median, max(2, ceil(range)) of them. A median of 0 is replaced by that of the
// positive luminances; a black image is looked at once, as it is. Negative values count as 0.
Exposures exposures_for(std::span<const Rgb> reference);
// Narkowicz' fit of the ACES curve with its exposure factor 0.6 included; [0, 1].
float tone_mapped(double value);

// The largest displayed_error() over the exposures that the reference asks for. Finite values.
Plane radiance_error(const View& picture, const View& reference, WorkerPool& pool,
                     double pixels_per_degree = default_pixels_per_degree);

}  // namespace pssmlt::flip
