#include "core/excess/redistribution.h"

#include <algorithm>
#include <cmath>

#include "core/metropolis/advance.h"
#include "core/metropolis/candidate_source.h"

namespace pssmlt {
namespace {

constexpr int probes = 1024;  // samples that tell which numbers are read

// A number that chose an offset within its pixel, as one that chooses pixel and offset.
uint32_t over_the_window(uint32_t offset, int pixel, int pixels) {
  const uint64_t place =
      (static_cast<uint64_t>(pixel) << 32 | offset) / static_cast<uint64_t>(pixels);
  return static_cast<uint32_t>(std::min<uint64_t>(place, ~0u));
}

// What would have to be allocated for each sample otherwise.
struct Scratch {
  Chain start;
  Splats current;
};

// For numbers that the state does not hold, should rounding lead the sample to read some.
class RestSource final : public NumberSource {
 public:
  explicit RestSource(uint64_t seed) : seed_(seed) {}
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    const uint32_t what = index << 2 | static_cast<uint32_t>(stream);
    block = philox(seed_, {what, 0, 0, static_cast<uint32_t>(RandomUse::resample)});
  }

 private:
  uint64_t seed_;
};

}  // namespace

void Redistribution::start(const SamplerContext& context, const ChainTarget& target) {
  target_ = &target;
  size_ = context.raster_map.frame().crop_size();
  set_kernels(walk_, settings_.kernels, size_);
  unsigned streams = 0;
  bool raster = false;
  context.parallel(1, [&](int, Worker& worker) {
    for (uint32_t i = 0; i < probes; ++i) {
      CandidateSource source(context.seed, i);
      worker.sample.begin(source);
      (void)worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
      streams |= source.streams();
      raster = raster || worker.sample.sample().raster_known();
    }
  });
  chooser_.emplace(settings_.mix, streams, raster);
}

// How many, with which probability any.
int Redistribution::chains(double value, double u, double& probability) const {
  const double wanted =
      std::min(value / deposit_, static_cast<double>(settings_.chains_of(length_)));
  probability = std::min(1.0, wanted);
  if (wanted < 1.0) return u < wanted ? 1 : 0;
  return static_cast<int>(std::lround(wanted));
}

void Redistribution::run(uint64_t key, double value, int plane, int group, SplatSink& sink,
                         Worker& worker) const {
  const RandomBlock bits = philox(key, {0, 0, 0, static_cast<uint32_t>(RandomUse::decide)});
  double probability = 1.0;
  const int count = chains(value, to_unit_double(bits[0]), probability);
  if (count == 0) return;
  WalkSettings walk = walk_;
  walk.seed = key;
  // All that is read of it is written first, in every call.
  static thread_local Scratch scratch;
  Chain& start = scratch.start;
  store_numbers(worker.sample, start.numbers);
  const bool raster = worker.sample.sample().raster_known();
  const int pixel = std::max(0, worker.sample.credit().pixel);
  for (size_t at = 0; raster && at < start.numbers.size(); at += words_a_block) {
    if (start.numbers[at] != static_cast<uint32_t>(Stream::camera)) continue;
    uint32_t* const pair = &start.numbers[at + 1];
    pair[0] = over_the_window(pair[0], pixel % size_.x, size_.x);
    pair[1] = over_the_window(pair[1], pixel / size_.x, size_.y);
  }
  // The target is that of the numbers as they are now.
  RestSource source(key);
  restore_numbers(start.numbers, raster, source, worker.sample);
  if (!worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace)) return;
  start.credit = worker.sample.credit();
  start.value = target_->evaluate(worker.splats, start.credit);
  if (!(start.value > 0.0)) return;
  start.splats.assign(worker.splats.all().begin(), worker.splats.all().end());
  store_numbers(worker.sample, start.numbers);
  const double carried = start.value / (probability * count);
  const CreditRule rule = CreditRule::expected(carried / length_);
  Walker walker(walk, *chooser_, worker.sample);
  Splats& current = scratch.current;
  current.keep_tags(worker.splats.keeps_tags());
  WalkTally tally;
  for (int c = 0; c < count; ++c) {
    ChainHost host(*target_, sink, plane, worker, current, group);
    host.restore(start);
    walker.load(static_cast<uint32_t>(c) + 1, 0, start.numbers, raster, start.value);
    uint64_t stuck = 0;
    advance(walker, worker.sample, host, rule, static_cast<uint64_t>(length_), stuck, tally);
  }
}

}  // namespace pssmlt
