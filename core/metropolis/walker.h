// A Markov chain over primary sample space: proposes points, decides about them, keeps its state.
// Knows nothing of what the target measures.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/metropolis/kernels.h"
#include "core/metropolis/steps.h"
#include "core/sampling/primary_sample_owner.h"

namespace pssmlt {

// The same kernel for steps of all kinds.
inline std::array<Kernel, step_kinds> for_all_kinds(const Kernel& k) {
  return {k, k, k, k, k, k, k, k, k};
}

// How all chains of a render step; a chain's random numbers are keyed by (seed, chain, mutation,
// stream, block).
struct WalkSettings {
  uint64_t seed = 0;
  // Of each kind of small steps, but for the raster pair.
  std::array<Kernel, step_kinds> kernels = for_all_kinds({KernelShape::kelemen, 1.0 / 64});
  Kernel film_x{KernelShape::kelemen, 1.0 / 64};  // of the raster pair
  Kernel film_y{KernelShape::kelemen, 1.0 / 64};
  double ensemble_scale = 0.5;  // of the difference that a step "ensemble" adds
  bool second_tries = false;    // Walker::tries_again()
};

// The numbers that a chain's state holds, between batches, by blocks of five words: the block's
// address (index << 2 | stream), its four numbers.
using StoredNumbers = std::vector<uint32_t>;
inline constexpr size_t words_a_block = 5;

// Copies the current state's numbers out of `owner`; `numbers` keeps its capacity.
void store_numbers(const PrimarySampleOwner& owner, StoredNumbers& numbers);
// Begins a point of these numbers; `source` gives what else is read. The raster position is known
// again if the state had one.
void restore_numbers(const StoredNumbers& numbers, bool raster, NumberSource& source,
                     PrimarySampleOwner& owner);

// The outcome of one proposal.
struct Transition {
  StepKind kind = StepKind::large;
  double acceptance = 0.0;  // probability with which the proposal was accepted
  bool accepted = false;
};

// Numbers that the current state holds are moved by the kernel where the step says so; numbers that
// it does not hold are, given the state, uniform, and drawn fresh when the proposal first reads
// them (a Gibbs step, which leaves the target invariant).
class Walker final : public NumberSource {
 public:
  Walker(const WalkSettings& settings, const StepChooser& chooser, PrimarySampleOwner& owner)
      : settings_(settings), chooser_(chooser), owner_(owner) {}

  // Continues a stored chain: its number, its next mutation, its state with the target's value > 0.
  void load(uint32_t chain, uint64_t mutation, const StoredNumbers& numbers, bool raster,
            double value);
  // Sets owner.sample() to the next proposal, to be evaluated by the caller.
  const Step& propose();
  // Accepts or rejects given the target's value at the proposal (Metropolis et al. 1953: all steps
  // are symmetric). 0 is never accepted.
  Transition decide(double proposed_value);
  // Delayed rejection (Tierney and Mira 1999, Some adaptive Monte Carlo methods for Bayesian
  // inference; Rioux-Lavoie et al. 2020, Delayed Rejection Metropolis Light Transport): true after
  // a large step was rejected and before decide_again(), if the settings ask for it. A small step
  // from the current state is then proposed in the same mutation. With target values x, y of the
  // rejected and z of the second one it is accepted with probability max(0, z - y) / (x - y), at
  // most 1: large steps are equally probable from x and z, small ones symmetric.
  bool tries_again() const { return again_; }
  bool gives_second_tries(StepKind kind) const {
    return settings_.second_tries && kind == StepKind::large;
  }
  const Step& propose_again();
  Transition decide_again(double proposed_value);
  // The states of other chains that "ensemble" steps use (ter Braak 2006, A Markov Chain Monte
  // Carlo version of the genetic algorithm Differential Evolution), which must not change until
  // the next set_mates(). With fewer than two such steps lead nowhere.
  void set_mates(std::span<const StoredNumbers* const> mates) { mates_ = mates; }
  // Of the current state.
  double value() const { return value_; }

  void fill(Stream stream, uint32_t index, NumberBlock& block) override;

 private:
  RandomBlock random(RandomUse use, uint32_t what) const;
  void move(const NumberBlock& from, bool film, const RandomBlock& bits, NumberBlock& block) const;
  const Step& begin(const Step& step, const RandomBlock& bits);
  void choose_mates();
  NumberBlock moved_by_mates(const NumberBlock& from, uint32_t what) const;
  Transition settle(double acceptance, double value);

  const WalkSettings& settings_;
  const StepChooser& chooser_;
  PrimarySampleOwner& owner_;
  uint32_t chain_ = 0;
  uint64_t mutation_ = 0;
  double value_ = 0.0;
  Step step_;
  uint32_t accept_bits_ = 0, accept_more_ = 0;
  bool again_ = false;
  double rejected_ = 0.0;  // target at the first proposal, where there is a second
  std::span<const StoredNumbers* const> mates_;
  const StoredNumbers *plus_ = nullptr, *minus_ = nullptr;  // whose difference is added
  double scale_ = 1.0;                                      // that is multiplied by
};

}  // namespace pssmlt
