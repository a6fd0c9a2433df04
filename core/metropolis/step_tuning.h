// How long small steps should be: scales found by chains on trial, which are then thrown away, so
// that what is rendered is made with fixed steps.
#pragma once

#include <span>

#include "core/metropolis/chain_host.h"
#include "core/metropolis/walk_parameters.h"

namespace pssmlt {

// Factors for the kernels' scales by which each kind of small steps is accepted as often as is best
// for normal densities of many dimensions (0.234: Roberts, Gelman and Gilks 1997, Weak convergence
// and optimal scaling of random walk Metropolis algorithms), steps of the film position as is best
// in two (0.352: Gelman, Roberts and Gilks 1996, Efficient Metropolis jumping rules). Stochastic
// approximation over copies of some of the chains, from where they are. 1 where a kind is never
// proposed. A pure function of the chains and of walk.seed. `walk` holds what is not a scale.
StepFactors tuned_steps(const SamplerContext& context, const ChainTarget& target,
                        std::span<const Chain> chains, const StepChooser& chooser,
                        const KernelChoice& kernels, const WalkSettings& walk);

}  // namespace pssmlt
