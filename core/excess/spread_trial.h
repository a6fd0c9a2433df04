// Short chains on trial: how much quieter they make what they spread.
#pragma once

#include <array>
#include <span>

#include "core/excess/excess_split.h"
#include "core/excess/redistribution.h"

namespace pssmlt {

// What is left of the variance, relative, when a bright sample's excess is spread by so many
// mutations in all: the squares that chains put into pixels over those that the sample would have
// put there itself.
class SpreadRemainder {
 public:
  static constexpr std::array<int, 3> lengths = {20, 100, 500};
  SpreadRemainder() = default;
  explicit SpreadRemainder(const std::array<double, 3>& measured);
  // Between those and beyond by straight lines in logarithms, not below a quarter of the least.
  double at(double mutations) const;

 private:
  std::array<double, 3> log_{};  // log2 of what is left; at most 0, falling
};

struct SpreadTrial {
  SpreadRemainder remainder;
  double rays =
      0.0;  // of a mutation, which moves bright samples: not those of any sample; 0: unknown
};

// Measured by chains of each length from samples of the pilot, drawn in proportion to their excess
// as chains start, so that one that no chain can spread does not speak for all. `target`: the
// excess; `above`: those samples; `settings` are those of the chains to be judged. A pure function
// of the seed.
SpreadTrial try_spreading(const SamplerContext& context, uint64_t seed, const Pilot& pilot,
                          uint64_t pilot_seed, const LocalMean& mean, const ChainTarget& target,
                          std::span<const RelativePilot::Above> above,
                          RedistributionSettings settings);

}  // namespace pssmlt
