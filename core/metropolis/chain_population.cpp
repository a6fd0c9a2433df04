#include "core/metropolis/chain_population.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <nlohmann/json.hpp>

#include "core/base/archive.h"
#include "core/base/log.h"
#include "core/metropolis/candidate_source.h"
#include "core/metropolis/resampling.h"
#include "core/metropolis/step_tuning.h"
#include "core/render/error_estimate.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/replay.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 2> b_names = {"refined", "bootstrap"};
constexpr std::array<std::string_view, 2> weight_names = {"expected", "kelemen"};

constexpr int candidates_a_unit = 1024;
constexpr int64_t most_mutations_a_round = 1 << 18;
constexpr int64_t least_stretch = 16;  // mutations of a chain in a round

}  // namespace

PopulationSettings read_population(Parameters& p, int bootstrap_samples) {
  PopulationSettings s;
  s.mix = read_step_mix(p);
  s.kernels = read_kernels(p);
  s.chains = p.integer("chains", 0, "", "number of chains, a multiple of 32; 0: by the image size");
  s.bootstrap_samples =
      p.integer("bootstrapsamples", bootstrap_samples, "samples",
                bootstrap_samples > 0 ? "independent samples that give b and the chains' seeds"
                                      : "independent samples that give b and the chains' seeds; 0: "
                                        "half as many as the pilot's");
  s.refine_b =
      p.choice("b", "refined", b_names,
               "normalisation: refined by every large step, or the bootstrap's") == "refined";
  s.kelemen_weights = p.choice("weights", "expected", weight_names,
                               "credit by expected value, or Kelemen's, which weigh large steps "
                               "as independent samples too") == "kelemen";
  s.second_tries = p.flag("delayedrejection", false,
                          "a rejected large step is followed by a small one in the same mutation "
                          "(Rioux-Lavoie et al. 2020)");
  s.tune_steps =
      p.flag("tunesteps", false,
             "the scales of small steps of each kind are tuned before the render, to the "
             "acceptance that is best for normal densities of their dimension");
  s.mix.ensemble = p.number("ensembleprobability", 0.f, "",
                            "of small steps: by the difference of two other chains' states "
                            "(ter Braak 2006)");
  s.ensemble_scale =
      p.number("ensemblescale", 0.5f, "", "of that difference; one step in ten adds all of it");
  s.seed = static_cast<uint32_t>(p.integer("seed", 0, "", "another seed gives another picture"));
  if (s.chains < 0 || s.chains > 1 << 24) p.fail("chains", "\"chains\" must lie in [0, 2^24]");
  const double small = s.mix.film + s.mix.stream + s.mix.range + s.mix.ensemble;
  if (!(s.mix.ensemble >= 0.0 && small <= 1.0 + 1e-6)) {
    p.fail("ensembleprobability",
           "\"ensembleprobability\" must not be negative nor exceed 1 with those of other steps");
  }
  if (s.mix.ensemble > 0.0 && s.chains != 0 && s.chains < least_chains_for_ensembles) {
    p.fail("chains", "\"ensembleprobability\" needs at least 96 \"chains\", three in a group");
  }
  if (!(s.ensemble_scale >= 0.0 && s.ensemble_scale <= 1.0)) {
    p.fail("ensemblescale", "\"ensemblescale\" must lie in [0, 1]");
  }
  if (s.bootstrap_samples < std::min(bootstrap_samples, 1)) {
    p.fail("bootstrapsamples", "\"bootstrapsamples\" must be positive");
  }
  return s;
}

void ChainPopulation::start(const SamplerContext& context, const ChainTarget& target,
                            const Size& size) {
  if (size.candidates > 0) settings_.bootstrap_samples = size.candidates;
  target_ = &target;
  chains_.clear();
  tallies_.clear();
  plan(context.raster_map.frame(), size.mutations);
  walk_.seed = mix_bits(context.seed + mix_bits(settings_.seed));
  bootstrap(context);
  if (bootstrap_.sum > 0.0) start_chains(context);
  candidates_ = {};
  factors_ = as_chosen;
  if (settings_.tune_steps && !empty()) {
    factors_ = tuned_steps(context, target, chains_, *chooser_, settings_.kernels, walk_);
    set_kernels(walk_, settings_.kernels, context.raster_map.frame().crop_size(), factors_);
  }
}

// Chains, round length and film steps: functions of the settings and the picture alone.
void ChainPopulation::plan(const RasterFrame& frame, double mutations_a_round) {
  pixels_ = frame.pixels();
  int64_t chains = settings_.chains;
  if (chains == 0) {
    chains = std::clamp<int64_t>(static_cast<int64_t>(pixels_ / 64), 512, 16384);
    // Short rounds: rather fewer chains than shorter stretches of each.
    if (mutations_a_round > 0.0) {
      chains =
          std::clamp<int64_t>(static_cast<int64_t>(mutations_a_round / least_stretch), 1, chains);
    }
  }
  chain_count_ = static_cast<int>((chains + group_count - 1) / group_count * group_count);
  if (settings_.chains != 0 && chain_count_ != settings_.chains) {
    log_info(std::string("sampler \"") + name_ + "\": \"chains\" rounded up to " +
             std::to_string(chain_count_));
  }
  if (mutations_a_round > 0.0) {
    steps_ = static_cast<int>(std::clamp(mutations_a_round / chain_count_, 1.0, 1e6));
  } else {
    const int64_t a_round = std::min(static_cast<int64_t>(pixels_), most_mutations_a_round);
    steps_ = static_cast<int>(std::clamp<int64_t>(a_round / chain_count_, least_stretch, 1024));
  }

  set_kernels(walk_, settings_.kernels, frame.crop_size());
  walk_.second_tries = settings_.second_tries;
  walk_.ensemble_scale = settings_.ensemble_scale;
}

void ChainPopulation::bootstrap(const SamplerContext& context) {
  const int count = settings_.bootstrap_samples;
  candidates_.assign(static_cast<size_t>(count), 0.0);
  std::atomic<unsigned> streams{0};
  std::atomic<bool> raster{false};
  const auto body = [&](int unit, Worker& worker) {
    const int end = std::min(count, (unit + 1) * candidates_a_unit);
    for (int i = unit * candidates_a_unit; i < end; ++i) {
      CandidateSource source(walk_.seed, static_cast<uint32_t>(i));
      worker.sample.begin(source);
      PrimarySample& u = worker.sample.sample();
      const bool good = worker.evaluator.evaluate(u, worker.splats, worker.workspace);
      if (good) {
        candidates_[static_cast<size_t>(i)] =
            target_->evaluate(worker.splats, worker.sample.credit());
      }
      streams.fetch_or(source.streams(), std::memory_order_relaxed);
      if (u.raster_known()) raster.store(true, std::memory_order_relaxed);
    }
  };
  context.parallel((count - 1) / candidates_a_unit + 1, body);
  bootstrap_ = {};
  contributing_ = 0;
  for (const double value : candidates_) {
    bootstrap_.add(value);
    if (value > 0.0) ++contributing_;
  }
  chooser_.emplace(settings_.mix, streams.load(), raster.load());
}

void ChainPopulation::start_chains(const SamplerContext& context) {
  const RandomBlock bits =
      philox(walk_.seed, {0, 0, 0, static_cast<uint32_t>(RandomUse::resample)});
  const std::vector<uint32_t> seeds =
      systematic_resample(candidates_, static_cast<size_t>(chain_count_), to_unit_double(bits[0]));
  chains_.assign(seeds.size(), {});
  const int units = chain_count_ / chains_a_unit;
  tallies_.assign(static_cast<size_t>(units), {});
  context.parallel(units, [&](int unit, Worker& worker) {
    for (int c = unit * chains_a_unit; c < (unit + 1) * chains_a_unit; ++c) {
      start_chain(c, seeds[static_cast<size_t>(c)], worker);
    }
  });
}

void ChainPopulation::start_chain(int chain, uint32_t candidate, Worker& worker) {
  CandidateSource source(walk_.seed, candidate);
  worker.sample.begin(source);
  (void)worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
  Chain& c = chains_[static_cast<size_t>(chain)];
  store_numbers(worker.sample, c.numbers);
  c.credit = worker.sample.credit();
  (void)target_->evaluate(worker.splats, c.credit);
  c.splats = worker.splats.all();
  c.value = candidates_[candidate];
}

void ChainPopulation::run(int64_t round, int unit, int plane, SplatSink& sink, Worker& worker) {
  if (empty()) return;
  const double beta = bootstrap_.mean();
  const CreditRule rule = settings_.kelemen_weights ? CreditRule::kelemen(beta, settings_.mix.large)
                                                    : CreditRule::expected(beta);
  Walker walker(walk_, *chooser_, worker.sample);
  Splats current;
  current.keep_tags(worker.splats.keeps_tags());
  WalkTally tally;
  Mates room;
  const auto mutation = static_cast<uint64_t>(round) * static_cast<uint64_t>(steps_);
  for (int c = unit * chains_a_unit; c < (unit + 1) * chains_a_unit; ++c) {
    Chain& chain = chains_[static_cast<size_t>(c)];
    ChainHost host(*target_, sink, plane, worker, current, group(c));
    host.restore(chain);
    walker.set_mates(mates(c, room));
    walker.load(static_cast<uint32_t>(c), mutation, chain.numbers, chain.credit.pixel >= 0,
                chain.value);
    advance(walker, worker.sample, host, rule, static_cast<uint64_t>(steps_), chain.stuck, tally);
    host.store(chain);
    store_numbers(worker.sample, chain.numbers);
    chain.value = walker.value();
  }
  tallies_[static_cast<size_t>(unit)].merge(tally);
}

// Systematic resampling gives a bright candidate to neighbouring chains. They are in one group, and
// the two halves of the picture (even and odd groups) have halves of the candidates each: what few
// candidates found makes groups and halves differ, as it must for the error to be seen.
int ChainPopulation::group(int chain) const {
  const int stretch = static_cast<int>(int64_t{chain} * group_count / chain_count_);
  return stretch < group_count / 2 ? 2 * stretch : 2 * stretch - (group_count - 1);
}

std::span<const StoredNumbers* const> ChainPopulation::mates(int chain, Mates& room) const {
  size_t count = 0;
  const int first = chain / chains_a_unit * chains_a_unit;
  for (int c = first; c < first + chains_a_unit; ++c) {
    if (c != chain && group(c) == group(chain)) {
      room[count++] = &chains_[static_cast<size_t>(c)].numbers;
    }
  }
  return {room.data(), count};
}

double ChainPopulation::large_scale(int64_t rounds) const {
  return rounds == 0 || empty() ? 0.0 : pixels_ / (mutations() * static_cast<double>(rounds));
}

double ChainPopulation::scale(int64_t rounds) const {
  return empty() ? 0.0 : large_scale(rounds) * normalisation().mean() / bootstrap_.mean();
}

double ChainPopulation::scale_relative_variance() const {
  const MeanTally b = normalisation();
  return b.mean() > 0.0 ? sqr(b.standard_error() / b.mean()) : 0.0;
}

WalkTally ChainPopulation::total() const {
  WalkTally sum;
  for (const WalkTally& tally : tallies_) sum.merge(tally);
  return sum;
}

// b with its error: the bootstrap's samples, and every large step's if b is refined.
MeanTally ChainPopulation::normalisation() const {
  MeanTally b = bootstrap_;
  if (settings_.refine_b) b.merge(total().large_values);
  return b;
}

void ChainPopulation::save(Archive& archive) const {
  archive.array(tallies_);
  archive.value<uint64_t>(chains_.size());
  for (const Chain& chain : chains_) {
    archive.array(chain.numbers);
    archive.array(chain.splats);
    archive.value(chain.value);
    archive.value(chain.credit);
    archive.value(chain.stuck);
  }
}

void ChainPopulation::load(Archive& archive) {
  tallies_ = archive.get_array<WalkTally>();
  const auto count = archive.get<uint64_t>();
  if (count != chains_.size()) throw Error("the checkpoint has another number of chains");
  for (Chain& chain : chains_) {
    chain.numbers = archive.get_array<uint32_t>();
    chain.splats = archive.get_array<Splat>();
    chain.value = archive.get<double>();
    chain.credit = archive.get<PixelCredit>();
    chain.stuck = archive.get<uint64_t>();
  }
}

bool ChainPopulation::replay(const std::string& key, Worker& worker) const {
  if (!numbers_from_text(key, worker.sample)) return false;
  (void)worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
  return true;
}

}  // namespace pssmlt
