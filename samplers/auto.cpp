// What can be left on for any scene. Where no integrator is named, pilots of all that miss none of
// the scene's light are compared, and the one whose product of rays and variance is least is
// rendered, as the sampler "erpt" would: by Sobol' points alone where no samples stand out, else
// with short Markov chains that spread what does. Counts decide and not the clock, so that a seed
// gives the same picture everywhere. Good where nobody knows what is good; what the pilots cost
// (64 samples in each of 512 pixels and two in all, and 40,000 mutations, for every integrator:
// about a second for a small picture) is lost on short renders. Blind to what no pilot sample
// finds, in choosing; what is chosen is still right then.
#include "core/excess/redistribution_sampler.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class Auto final : public RedistributionSampler {
 public:
  static constexpr const char* summary =
      "Chooses integrator, Sobol' points and short Markov chains by pilots.";
  explicit Auto(Parameters& p)
      : RedistributionSampler("auto", read_redistribution(p), Chains::where_allowed) {}
  bool chooses_integrator() const override { return true; }
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "auto", pssmlt::Auto)
