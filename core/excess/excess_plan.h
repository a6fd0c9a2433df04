// What a pilot decides for a sampler that leaves bright samples' excess to long chains: the limit
// and the chains' share.
#pragma once

#include <string>

#include "core/excess/excess_pilots.h"
#include "core/excess/excess_split.h"
#include "core/metropolis/chain_population.h"

namespace pssmlt {

struct ExcessPlanSettings {
  int pilot_samples = 0;    // as run_excess_pilots() takes them
  double threshold = 0.0;   // [local means]; 0: chosen
  double share = 0.0;       // of all samples, the chains'; 0: chosen
  double stickiness = 0.0;  // RelativePilot::variances(); 0: measured by chains on trial
  int candidates = 0;       // of the chains' bootstrap; 0: by the pilot's size
  PopulationSettings chains;
};

// Light and variances are relative to the local mean.
struct ExcessPlan {
  LocalMean mean;
  ExcessSplit split;
  double light = 0.0;              // mean of all samples
  double plain = 0.0;              // variance of a sample without chains
  double stickiness = 0.0;         // RelativePilot::variances()
  uint64_t pilots = 0, finds = 0;  // samples of the deep pilot, and those with light
  int candidates = 0;              // of the chains' bootstrap
  // Samples above the limit are known well enough, and numerous enough, for chains.
  bool worth_chains = false;
};

// A function of the context's seed and the settings.
ExcessPlan plan_excess(const SamplerContext& context, uint64_t seed,
                       const ExcessPlanSettings& settings);
std::string to_string(const ExcessPlan& plan);  // for --verbose

}  // namespace pssmlt
