// A Markov chain over primary sample space: proposes points, decides about them, keeps its state.
// Knows nothing of what the target measures.
#pragma once

#include <vector>

#include "core/metropolis/kernels.h"
#include "core/metropolis/steps.h"
#include "core/sampling/primary_sample_owner.h"

namespace pssmlt {

// How all chains of a render step; a chain's random numbers are keyed by (seed, chain, mutation,
// stream, block).
struct WalkSettings {
  uint64_t seed = 0;
  Kernel kernel{KernelShape::kelemen, 1.0 / 64};
  Kernel film_x{KernelShape::kelemen, 1.0 / 64};  // of the raster pair
  Kernel film_y{KernelShape::kelemen, 1.0 / 64};
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

// The outcome of one mutation.
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
  // Of the current state.
  double value() const { return value_; }

  void fill(Stream stream, uint32_t index, NumberBlock& block) override;

 private:
  RandomBlock random(RandomUse use, uint32_t what) const;
  void move(const NumberBlock& from, bool film, bool rest, const RandomBlock& bits,
            NumberBlock& block) const;

  const WalkSettings& settings_;
  const StepChooser& chooser_;
  PrimarySampleOwner& owner_;
  uint32_t chain_ = 0;
  uint64_t mutation_ = 0;
  double value_ = 0.0;
  Step step_;
  uint32_t accept_bits_ = 0, accept_more_ = 0;
};

}  // namespace pssmlt
