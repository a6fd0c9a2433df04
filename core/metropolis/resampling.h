// Choosing where chains start: from candidates with probability proportional to the target, so that
// the chains are in equilibrium from their first step.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace pssmlt {

// Systematic resampling (Kitagawa 1996): `count` candidates, candidate i chosen either floor or
// ceil of count * weight_i / sum times, its expectation exactly that. `u` in [0,1). The order is
// that of the candidates. Empty if all weights are 0. Weights are finite and not negative.
std::vector<uint32_t> systematic_resample(const std::vector<double>& weights, size_t count,
                                          double u);

}  // namespace pssmlt
