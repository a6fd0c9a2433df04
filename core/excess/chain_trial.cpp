#include "core/excess/chain_trial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/excess/trial_sink.h"

namespace pssmlt {
namespace {

constexpr int chain_count = group_count;  // a group each
// Of all chains together: on small pictures in proportion to their size.
constexpr double mutations_a_pixel = 16.0, least_mutations = 8192.0, most_mutations = 65536.0;

// Mean over pixels of the variance between groups.
double variance_between(std::vector<TrialSink::Credit>& credits, double pixels) {
  std::ranges::sort(credits, [](const TrialSink::Credit& a, const TrialSink::Credit& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.group < b.group;
  });
  double own = 0.0, all = 0.0;  // sums over pixels: of groups' squares, of the sum's square
  for (size_t i = 0; i < credits.size();) {
    const int pixel = credits[i].pixel;
    double sum = 0.0;
    while (i < credits.size() && credits[i].pixel == pixel) {
      const int group = credits[i].group;
      double one = 0.0;
      for (; i < credits.size() && credits[i].pixel == pixel && credits[i].group == group; ++i) {
        one += credits[i].value;
      }
      own += one * one;
      sum += one;
    }
    all += sum * sum;
  }
  constexpr double n = group_count;
  return std::max(0.0, (own / n - (all - own) / (n * (n - 1.0))) / pixels);
}

}  // namespace

double trial_variance(const SamplerContext& context, uint64_t seed, PopulationSettings settings,
                      const ChainTarget& target, const LocalMean& mean, int candidates) {
  const RasterFrame& frame = context.raster_map.frame();
  const double mutations =
      std::clamp(mutations_a_pixel * frame.pixels(), least_mutations, most_mutations);
  candidates = std::min(candidates, static_cast<int>(mutations / 4.0));
  settings.chains = chain_count;
  settings.seed = mix_bits(settings.seed + seed);
  ChainPopulation chains("trial", settings);
  chains.start(context, target, {mutations, candidates});
  if (chains.empty()) return 0.0;
  // b as it was at the start will do.
  const std::array<double, 2> scales = {chains.scale(1) * group_count,
                                        chains.large_scale(1) * group_count};
  std::vector<TrialSink> sinks(static_cast<size_t>(chains.units()), TrialSink(frame, mean, scales));
  context.parallel(chains.units(), [&](int unit, Worker& worker) {
    chains.run(0, unit, 0, sinks[static_cast<size_t>(unit)], worker);
  });
  std::vector<TrialSink::Credit> credits;
  for (const TrialSink& sink : sinks) {
    credits.insert(credits.end(), sink.credits().begin(), sink.credits().end());
  }
  const double pixels = frame.pixels();
  return variance_between(credits, pixels) * chains.mutations() / (group_count * pixels);
}

}  // namespace pssmlt
