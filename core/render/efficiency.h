// What a mutation of a Markov chain is worth in each region of the picture, from sums that the film
// keeps anyway: the spread of a block's light between the groups of chains, against what as many
// independent samples of the chains' density would show.
#pragma once

#include <optional>
#include <string>

#include "core/render/develop.h"

namespace pssmlt {

// Fewer effective samples per mutation than this, and the summary says so.
inline constexpr double least_efficiency = 1e-4;

// Pixels of the rendered window, both ends included.
struct PixelRegion {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
std::string to_string(const PixelRegion& region);

struct RegionEfficiency {
  PixelRegion pixels;
  double share = 0.0;      // of the picture's light
  double effective = 0.0;  // samples per mutation
};

struct ChainEfficiency {
  RegionEfficiency worst;
  double median = 0.0;  // samples per mutation, over the regions, weighted by their light
  int regions = 0;
  bool collapsed() const { return worst.effective < least_efficiency; }
};

// A region with the share q of the picture's light is hit by an independent sample of the chains'
// density with probability q; n of them would estimate its light with the relative variance
// (1 - q) / (q n). Between-chain over within-chain variance is that variance as the groups show it,
// times the mutations, over q (1 - q): its inverse is the effective samples per mutation (the
// integrated autocorrelation time is the ratio itself; Gelman and Rubin 1992 compare the same two).
// With few light splats of a sample landing outside of the region, q (1 - q) is exact, else an
// upper bound, so that the figure flatters bidirectional integrators by the number of their splats.
//
// nullopt for layers without chains, before all groups have samples, and where fewer than four
// blocks have light. `rounds`: of the layer. q counts light as often as the sampler's chains visit
// it (Sampler::visits()).
std::optional<ChainEfficiency> chain_efficiency(const Film& film, const LayerScales& scales,
                                                int layer, int64_t rounds);

}  // namespace pssmlt
