#include "core/excess/spread_trial.h"

#include <algorithm>
#include <cmath>

#include "core/excess/trial_sink.h"
#include "core/metropolis/resampling.h"
#include "core/scene/scene.h"

namespace pssmlt {
namespace {

constexpr size_t starts = 64;
constexpr double least = 1e-6;

double log2_length(size_t i) { return std::log2(SpreadRemainder::lengths[i]); }

uint64_t rays_so_far() { return ray_counters().nearest + ray_counters().shadow; }

// Sum over pixels of the square of what they got.
double squares(std::vector<TrialSink::Credit>& credits) {
  std::ranges::sort(credits, {}, &TrialSink::Credit::pixel);
  double sum = 0.0;
  for (size_t i = 0; i < credits.size();) {
    const int pixel = credits[i].pixel;
    double one = 0.0;
    for (; i < credits.size() && credits[i].pixel == pixel; ++i) one += credits[i].value;
    sum += one * one;
  }
  return sum;
}

// What a chain leaves of its start's squares, and the rays that it took.
struct ChainRun {
  double left = 1.0, rays = 0.0;
};

// From the sample that is in the worker.
ChainRun run_chain(const Redistribution& chains, uint64_t key, const ChainTarget& target,
                   const RasterFrame& frame, const LocalMean& mean, Worker& worker) {
  const PixelCredit credit = worker.sample.credit();
  const double value = target.evaluate(worker.splats, credit);
  if (!(value > 0.0)) return {};
  TrialSink plain(frame, mean, {1.0, 1.0}), spread(frame, mean, {1.0, 1.0});
  plain.add(0, worker.splats, credit, 1.0, 0);
  const uint64_t before = rays_so_far();
  chains.run(key, value, 0, 0, spread, worker);
  ChainRun run;
  run.rays = static_cast<double>(rays_so_far() - before);
  const double own = squares(plain.credits());
  if (own > 0.0) run.left = squares(spread.credits()) / own;
  return run;
}

}  // namespace

SpreadRemainder::SpreadRemainder(const std::array<double, 3>& measured) {
  double most = 0.0;
  for (size_t i = 0; i < measured.size(); ++i) {
    most = std::min(most, std::log2(std::max(least, measured[i])));
    log_[i] = most;
  }
}

double SpreadRemainder::at(double mutations) const {
  const double x = std::log2(std::max(1.0, mutations));
  if (x <= log2_length(0)) return std::exp2(log_[0] * x / log2_length(0));
  const size_t i = x <= log2_length(1) ? 0 : 1;
  const double slope = (log_[i + 1] - log_[i]) / (log2_length(i + 1) - log2_length(i));
  return std::exp2(std::max(log_[2] - 2.0, log_[i] + slope * (x - log2_length(i))));
}

SpreadTrial try_spreading(const SamplerContext& context, uint64_t seed, const Pilot& pilot,
                          uint64_t pilot_seed, const LocalMean& mean, const ChainTarget& target,
                          std::span<const RelativePilot::Above> above,
                          RedistributionSettings settings) {
  std::vector<double> weights;
  for (const RelativePilot::Above& a : above) weights.push_back(a.value);
  const std::vector<uint32_t> drawn = systematic_resample(weights, starts, 0.5);
  if (drawn.empty()) return {};
  settings.most_chains = 1;
  Redistribution chains(settings);
  chains.start(context, target);
  const PilotSamples samples(context, pilot_seed);
  const auto count = static_cast<double>(drawn.size());
  std::array<double, 3> left{};
  SpreadTrial trial;
  for (size_t k = 0; k < left.size(); ++k) {
    const int length = SpreadRemainder::lengths[k];
    chains.set(length, 1e-9);
    std::vector<ChainRun> runs(drawn.size());
    context.parallel(static_cast<int>(drawn.size()), [&](int unit, Worker& worker) {
      const auto u = static_cast<size_t>(unit);
      if (!samples.evaluate(pilot, above[drawn[u]].sample, worker)) return;
      const uint64_t key = mix_bits(seed + mix_bits(u + 1));
      runs[u] = run_chain(chains, key, target, context.raster_map.frame(), mean, worker);
    });
    for (const ChainRun& run : runs) {
      left[k] += run.left / count;
      trial.rays += run.rays / (count * length * static_cast<double>(left.size()));
    }
  }
  trial.remainder = SpreadRemainder(left);
  return trial;
}

}  // namespace pssmlt
