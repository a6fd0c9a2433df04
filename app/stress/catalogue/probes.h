// Cases that are no pictures: what the catalogue asks of single functions and of the program.
#pragma once

#include <cstdint>

#include "app/stress/case.h"

namespace pssmlt::stress {

// The density of GGX metal and glass over the sphere against the share of draws that succeed, for
// several directions, in double.
Outcome integrate_density(double alpha);

// A lamp of this radius in a picture 2 wide and 2 high, of which 8192 bootstrap samples find few.
Outcome few_contributing(const ProbeContext& context, double radius);

// A target on two numbers and the raster position, in closed form; and how a sampler visits it.
struct ChainTarget {
  enum Kind : uint8_t { constant, smooth, spike, islands, gap };
  Kind kind = smooth;
  float size = 0.f;      // of what is small
  int seeds = 100;       // renders
  int bootstrap = 4096;  // samples
  int chains = 32;
  double mutations = 64;  // a pixel
  double large = .3;      // probability of a large step
  double sigma = 0.0;     // of small steps; 0: the sampler's default
  bool keep_b = true;     // the bootstrap's b, which is exactly unbiased
};
// The blocks' means over the seeds against the truth. Samplers without chains are run as well.
Outcome chains_on_target(const ProbeContext& context, const ChainTarget& target);
// The bias of a refined b at growing numbers of bootstrap samples, in standard errors.
Outcome bias_of_refined_b(const ProbeContext& context);
// A scene without large steps: the warning, and the report of chains that differ.
Outcome no_large_steps(const ProbeContext& context);

// An integrator that throws at 10^-3 of its samples: its picture, and how many were dropped.
Outcome throwing_integrator(const ProbeContext& context);
// The program with too little memory: exit code 1, a message, nothing written.
Outcome memory_exhausted(const ProbeContext& context);
// The picture cannot be written: exit code 1 and a message, or a picture at another place.
Outcome disk_full(const ProbeContext& context);
// Checkpoints cannot be written any more: the last one resumes to the same bits.
Outcome checkpoint_on_full_disk(const ProbeContext& context);
// An image of a texture is deleted while the render runs.
Outcome texture_vanishes(const ProbeContext& context);
// An integrator throws when it is prepared: exit code 1 and its message.
Outcome integrator_throws_early(const ProbeContext& context);

}  // namespace pssmlt::stress
