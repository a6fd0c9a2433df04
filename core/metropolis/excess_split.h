// Where to cut bright samples off, and how much of the work to spend on what is cut off.
//
// A sample worth r local means is split into r min(1, T / r), which independent samples integrate,
// and r max(0, 1 - T / r), which chains do (in the spirit of Bitterli and Jarosz 2019, Selectively
// Metropolised Monte Carlo light transport simulation). With the variances V1(T) and V2(T) of one
// sample of either kind, n samples shared in proportion to their roots leave
// (sqrt V1 + sqrt V2)^2 / n, which is least at some T; T = infinity is plain sampling.
#pragma once

#include <span>

#include "core/base/math.h"
#include "core/metropolis/local_mean.h"

namespace pssmlt {

struct ExcessSplit {
  double threshold = static_cast<double>(infinity);  // T [local means]
  double chain_share = 0.0;                          // of all samples
  double excess = 0.0;                               // of the light, above T
  uint64_t contributing = 0;                         // pilot samples above T
};

// Of the pilot's samples at a given T. stickiness: how many mutations of a chain are worth one
// independent sample of what it follows.
struct SplitVariances {
  double below = 0.0, above = 0.0, excess = 0.0;
  uint64_t contributing = 0;
};
SplitVariances split_variances(std::span<const RelativeNorms> pilot, double threshold,
                               double stickiness);

// The best T of a geometric series. One above which the pilot has fewer than `least` samples is not
// considered: what is cut off has to be known.
ExcessSplit choose_split(std::span<const RelativeNorms> pilot, double stickiness, uint64_t least);
// The best share for a given T.
ExcessSplit split_at(std::span<const RelativeNorms> pilot, double threshold, double stickiness);

}  // namespace pssmlt
