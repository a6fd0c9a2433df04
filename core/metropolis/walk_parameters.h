// The parameters that samplers with Markov chains in primary sample space share.
#pragma once

#include <array>

#include "core/metropolis/kernels.h"
#include "core/metropolis/steps.h"
#include "core/scene/parameters.h"

namespace pssmlt {

struct KernelChoice {
  KernelShape shape = KernelShape::kelemen;
  double scale = 1.0 / 64;       // as Kernel takes it [torus]
  double film_scale = 1.0 / 64;  // of the raster pair [side of a square picture of equal area]
};

// "largestepprobability", "filmprobability", "streamprobability", "rangeprobability"; `large`:
// the first one's default.
StepMix read_step_mix(Parameters& parameters, float large = 0.3f);
// "kernel", "sigma", "filmsigma".
KernelChoice read_kernels(Parameters& parameters);
// Of each kind of steps, times the scales that were chosen.
using StepFactors = std::array<double, step_kinds>;
inline constexpr StepFactors as_chosen = {1, 1, 1, 1, 1, 1, 1, 1, 1};
// For a window of this size [pixels]: film steps have the same length in pixels along both axes.
void set_kernels(struct WalkSettings& walk, const KernelChoice& choice, const ivec2& size,
                 const StepFactors& factors = as_chosen);

}  // namespace pssmlt
