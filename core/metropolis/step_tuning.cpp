#include "core/metropolis/step_tuning.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/metropolis/advance.h"

namespace pssmlt {
namespace {

constexpr int passes = 12, mutations_a_pass = 32;
constexpr size_t most_chains = 256, chains_a_unit = 8;
constexpr uint64_t least_proposals = 64;  // of a kind in a pass
// Of the logarithm (base 2) by the surplus of acceptance: 8, 4, 2.7, 2 ... in the passes.
constexpr double first_gain = 8.0;
constexpr double smallest = 0x1p-10, largest = 64.0;

double best_rate(size_t kind) {
  return kind == static_cast<size_t>(StepKind::film) ? 0.352 : 0.234;
}

class NoSink final : public SplatSink {
 public:
  void add(int, const Splats&, const PixelCredit&, double, int) override {}
};

// What one pass does to copies of chains; they stay where it leads them.
WalkTally run_pass(const SamplerContext& context, const ChainTarget& target,
                   std::vector<Chain>& chains, const StepChooser& chooser,
                   const WalkSettings& settings, int pass) {
  const size_t units = (chains.size() + chains_a_unit - 1) / chains_a_unit;
  std::vector<WalkTally> tallies(units);
  context.parallel(static_cast<int>(units), [&](int unit, Worker& worker) {
    Walker walker(settings, chooser, worker.sample);
    Splats current;
    NoSink sink;
    const size_t begin = static_cast<size_t>(unit) * chains_a_unit;
    for (size_t c = begin; c < std::min(chains.size(), begin + chains_a_unit); ++c) {
      Chain& chain = chains[c];
      ChainHost host(target, sink, 0, worker, current, 0);
      host.restore(chain);
      const auto mutation = static_cast<uint64_t>(pass) * mutations_a_pass;
      walker.load(static_cast<uint32_t>(c), mutation, chain.numbers, chain.credit.pixel >= 0,
                  chain.value);
      advance(walker, worker.sample, host, CreditRule::expected(1.0), mutations_a_pass, chain.stuck,
              tallies[static_cast<size_t>(unit)]);
      host.store(chain);
      store_numbers(worker.sample, chain.numbers);
      chain.value = walker.value();
    }
  });
  WalkTally sum;
  for (const WalkTally& tally : tallies) sum.merge(tally);
  return sum;
}

}  // namespace

StepFactors tuned_steps(const SamplerContext& context, const ChainTarget& target,
                        std::span<const Chain> all, const StepChooser& chooser,
                        const KernelChoice& kernels, const WalkSettings& walk) {
  std::vector<Chain> chains;
  const size_t count = std::min(all.size(), most_chains);
  for (size_t i = 0; i < count; ++i) chains.push_back(all[i * all.size() / count]);
  WalkSettings settings = walk;
  settings.seed = mix_bits(walk.seed + 0x74756E65u);
  StepFactors factors = as_chosen;
  for (int pass = 0; pass < passes; ++pass) {
    set_kernels(settings, kernels, context.raster_map.frame().crop_size(), factors);
    const WalkTally tally = run_pass(context, target, chains, chooser, settings, pass);
    for (size_t k = 0; k < step_kinds; ++k) {
      const WalkTally::Kind& kind = tally.kinds[k];
      const bool has_scale =
          k != static_cast<size_t>(StepKind::large) && k != static_cast<size_t>(StepKind::ensemble);
      if (!has_scale || kind.proposed < least_proposals) continue;
      const double rate = static_cast<double>(kind.accepted) / static_cast<double>(kind.proposed);
      const double surplus = rate - best_rate(k);
      factors[k] = std::clamp(factors[k] * std::exp2(first_gain / (pass + 1.0) * surplus), smallest,
                              largest);
    }
  }
  return factors;
}

}  // namespace pssmlt
