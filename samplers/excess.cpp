// Metropolis sampling for outliers alone. A pilot finds how bright the picture is about each pixel;
// with T times that as a limit, every sample's contribution f is split into f min(1, T / |f|) and
// f max(0, 1 - T / |f|), |f| being the sum of its splats' luminances relative to the local mean.
// The first part has no fireflies and is integrated by Sobol' points, the same number in every
// pixel; the second is zero almost everywhere and is what Markov chains follow, so that they spend
// their mutations where independent samples fail. In the spirit of Bitterli and Jarosz 2019,
// Selectively Metropolised Monte Carlo light transport simulation, who choose samples by bounds on
// path densities; here any integrator will do. Unbiased for every T fixed in advance, up to the
// bias of b (pssmlt).
//
// Good where few samples carry much light: caustics seen by a path tracer, light through a door.
// Where no samples stand out it is "sobol" after a pilot. Its chains follow relative brightness, so
// that dark parts of the picture get their share. Blind to what no bootstrap sample finds, but only
// for light above the limit: what is cut off must have been found by enough of the pilot, else
// nothing is cut off.
#include "core/excess/excess_sampler.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Excess final : public ExcessSampler {
 public:
  static constexpr const char* summary =
      "Sobol' points for what is not exceptional, Markov chains for bright samples' excess.";
  explicit Excess(Parameters& p) : ExcessSampler("excess", p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "excess", pssmlt::Excess)
