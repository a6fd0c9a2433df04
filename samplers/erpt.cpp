// Energy redistribution (Cline, Talbot and Egbert 2005, Energy redistribution path tracing) of
// bright samples' excess: Sobol' points over the pixels, and from each sample that is brighter than
// T local means, short Markov chains that spread what is above T over its neighbours in primary
// sample space. A pilot gives the local means. Unbiased, and no normalisation is to be estimated;
// samples of different pixels stay independent, so that nothing gets stuck for longer than a chain.
//
// Good where the sampler "excess" is and its long chains would have to find their way between many
// small places; never much worse than "sobol". Worse than long chains where light is so hard to
// find that few samples do. Blind to what no sample of its own finds.
#include "core/excess/redistribution_sampler.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Erpt final : public RedistributionSampler {
 public:
  static constexpr const char* summary =
      "Sobol' points whose bright samples are spread by short Markov chains (Cline et al. 2005).";
  explicit Erpt(Parameters& p)
      : RedistributionSampler("erpt", read_redistribution(p), Chains::always) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "erpt", pssmlt::Erpt)
