// Chains on trial: how noisy their picture is, mutation by mutation, before the render relies on
// them.
#pragma once

#include "core/excess/local_mean.h"
#include "core/metropolis/chain_population.h"

namespace pssmlt {

// Variance of what one mutation says of a pixel relative to the local mean, averaged over pixels:
// n mutations a pixel leave this / n, as n samples of a pixel's own leave their variance / n. From
// differences between independent chains, so that it holds how long chains stay where they are (up
// to the length of the trial). `settings` are those of the chains to be judged but for their
// number. 0 if no candidate of the bootstrap was worth anything. A pure function of the seed.
double trial_variance(const SamplerContext& context, uint64_t seed, PopulationSettings settings,
                      const ChainTarget& target, const LocalMean& mean, int candidates);

}  // namespace pssmlt
