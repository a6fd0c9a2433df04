// The pilots of samplers that treat bright samples in a way of their own: how bright the picture is
// about each pixel, and how noisy.
#pragma once

#include <span>
#include <vector>

#include "core/excess/local_mean.h"

namespace pssmlt {

struct ExcessPilots {
  // A pilot with the seed that its samples are found again by (PilotSamples).
  struct Seeded {
    Pilot pilot;
    uint64_t seed = 0;
  };
  LocalMean mean;                  // of all the integrator's alternatives together
  std::vector<Seeded> wide, deep;  // one for each alternative
};
// Two pilots for each alternative: a wide one of few samples in every pixel (one of several, on
// large pictures) for the local means, and a deep one of many samples in few pixels
// (deep_pixels), since Sobol' points show what they are worth only in numbers. pilot_samples: of
// each pilot, about; 0: by the picture's size. Counts decide and not the clock: a function of the
// seed. Leaves the integrator's last alternative chosen.
ExcessPilots run_excess_pilots(const SamplerContext& context, uint64_t seed, int pilot_samples,
                               int deep_pixels = 2048);

// The local means alone, by wide pilots.
LocalMean find_local_mean(const SamplerContext& context, uint64_t seed, int pilot_samples);

// The light that a pilot found [local means], with its standard error were samples independent.
struct PilotLight {
  double mean = 0.0, error = 0.0;
};
// True if it falls short of another's by more than three standard errors.
bool misses_light(const PilotLight& one, std::span<const PilotLight> all);

}  // namespace pssmlt
