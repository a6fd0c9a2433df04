// Energy redistribution (Cline, Talbot and Egbert 2005, Energy redistribution path tracing): what
// an independent sample found is spread by short Markov chains that start from it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/metropolis/chain_host.h"
#include "core/metropolis/walk_parameters.h"

namespace pssmlt {

struct RedistributionSettings {
  StepMix mix;
  KernelChoice kernels;
  int most_chains = 0;  // from one sample; 0: as many as make most_mutations
  static constexpr int most_mutations = 8192;
  int chains_of(int length) const {
    return most_chains > 0 ? most_chains : std::max(1, most_mutations / length);
  }
};

// A sample whose target is worth e gives e / deposit chains on average, never more than
// chains_of(length), of a fixed length; each visit of a state with target F is credited F's splats
// times what the chain carries over (length F). Since chains start in proportion to the target,
// every state's expected credit is the target's own whatever the length: no normalisation is
// needed, and chains that do not move leave the picture as noisy as it was, never worse. (e /
// chains is carried where there are at least that many; else 1 / probability times as much by the
// few that are run.)
class Redistribution {
 public:
  explicit Redistribution(const RedistributionSettings& settings) : settings_(settings) {}
  // Finds out which numbers the integrator reads at all.
  void start(const SamplerContext& context, const ChainTarget& target);
  // length: mutations of a chain. deposit: the target's value at its start that is worth one chain.
  void set(int length, double deposit) {
    length_ = length;
    deposit_ = deposit;
  }
  // Spreads the sample in worker.sample, of a pixel of its own (PrimarySampleOwner::set_pixel), by
  // chains over the whole picture; `key` names its random numbers.
  // `value`: the target's there.
  void run(uint64_t key, double value, int plane, int group, SplatSink& sink, Worker& worker) const;

 private:
  int chains(double value, double u, double& probability) const;
  RedistributionSettings settings_;
  const ChainTarget* target_ = nullptr;
  int length_ = 1;
  double deposit_ = 1.0;
  WalkSettings walk_;
  std::optional<StepChooser> chooser_;
  ivec2 size_{1, 1};
};

}  // namespace pssmlt
