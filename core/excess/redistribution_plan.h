// What pilots decide for a sampler that spreads bright samples' excess by short chains: the limit,
// the work spent on chains, and which of an integrator's alternatives is rendered.
#pragma once

#include <string>
#include <vector>

#include "core/excess/excess_pilots.h"
#include "core/excess/excess_split.h"
#include "core/excess/spread_trial.h"

namespace pssmlt {

// 0, but for the length: chosen.
struct RedistributionPlanSettings {
  int pilot_samples = 0;    // as run_excess_pilots() takes them
  double threshold = 0.0;   // [local means]
  double mutations = -1.0;  // for each sample; below 0: chosen
  int length = 500;         // of a chain [mutations]
  RedistributionSettings chains;
};

// One of the integrator's alternatives. Light and variances are relative to the local mean; the
// variances are two standard errors above what the pilot shows.
struct RedistributionOption {
  std::string integrator;
  PilotLight light;
  double rays = 0.0, mutation_rays = 0.0;            // of a sample, of a mutation
  double plain = 0.0;                                // variance of a sample without chains
  double threshold = static_cast<double>(infinity);  // [local means]
  double mutations = 0.0;                            // for each sample
  int length = 1;                                    // of a chain [mutations]
  double deposit = 1.0;   // what a sample must be worth above the limit for one chain
  double variance = 0.0;  // of a sample with chains, expected
  double excess = 0.0;    // mean of what is above the limit
  // Rays times variance: what is least is best.
  double effort() const { return (std::max(rays, 1.0) + mutations * mutation_rays) * variance; }
};

struct RedistributionPlan {
  LocalMean mean;
  std::vector<RedistributionOption> options;  // one for each alternative
  size_t chosen = 0;
  uint64_t samples = 0, finds = 0;  // of the chosen one's deep pilot
  const RedistributionOption& option() const { return options[chosen]; }
  bool chains() const { return option().mutations > 0.0; }
  // In a few words, for the user: what was chosen and why.
  std::string why() const;
};

// Leaves the chosen alternative chosen: the one with the least effort of those that miss no light
// that another one found. A function of the seed.
RedistributionPlan plan_redistribution(const SamplerContext& context, uint64_t seed,
                                       const RedistributionPlanSettings& settings);
// Limit and mutations with the least effort.
// `deep`: many samples of a pixel, which tell what Sobol' points leave of what is not bright;
// `wide`: samples everywhere, which tell what is bright.
void choose_redistribution(const RelativePilot& deep, const RelativePilot& wide,
                           const RedistributionPlanSettings& settings, const SpreadTrial& trial,
                           RedistributionOption& option);
size_t best_option(const std::vector<RedistributionOption>& options);
std::string to_string(const RedistributionOption& option);  // for --verbose

}  // namespace pssmlt
