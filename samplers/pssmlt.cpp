// Primary sample space Metropolis light transport (Kelemen, Szirmay-Kalos, Antal, Csonka 2002, A
// Simple and Robust Mutation Strategy for the Metropolis Light Transport Algorithm) over any
// integrator: many Markov chains whose stationary density is the luminance of the integrator's
// splats. Good where light is hard to find and small changes of a path keep it; noisier than
// independent samples where light is easy to find. Blind to what no bootstrap sample and no large
// step finds. Consistent: b is refined by every large step (or kept, then unbiased).
#include <array>
#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/archive.h"
#include "core/base/log.h"
#include "core/metropolis/advance.h"
#include "core/metropolis/candidate_source.h"
#include "core/metropolis/chain_host.h"
#include "core/metropolis/resampling.h"
#include "core/metropolis/walk_parameters.h"
#include "core/plugin/plugin.h"
#include "core/render/error_estimate.h"
#include "core/sampler.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/replay.h"

namespace pssmlt {
namespace {

constexpr std::array<std::string_view, 2> b_names = {"refined", "bootstrap"};
constexpr std::array<std::string_view, 2> weight_names = {"expected", "kelemen"};
constexpr std::array<std::string_view, 1> target_names = {"luminance"};

constexpr int chains_a_unit = 8;
constexpr int candidates_a_unit = 1024;
constexpr int64_t mutations_a_round = 1 << 18;
// Signs of what is wrong where chains get on too slowly: rates of small steps, and a long stay.
constexpr double least_acceptance = 0.05, most_acceptance = 0.95;
constexpr uint64_t stuck_mutations = 1000;

struct Settings {
  StepMix mix;
  KernelChoice kernels;
  int chains = 0, bootstrap_samples = 100000, mutations_per_pixel = 100;
  bool refine_b = true, kelemen_weights = false;
  uint64_t seed = 0;
};

Settings read_settings(Parameters& p) {
  Settings s;
  s.mix = read_step_mix(p);
  s.kernels = read_kernels(p);
  s.chains = p.integer("chains", 0, "", "number of chains, a multiple of 32; 0: by the image size");
  s.bootstrap_samples = p.integer("bootstrapsamples", 100000, "samples",
                                  "independent samples that give b and the chains' seeds");
  s.mutations_per_pixel =
      p.integer("mutationsperpixel", 100, "mutations", "default budget, per pixel");
  s.refine_b =
      p.choice("b", "refined", b_names,
               "normalisation: refined by every large step, or the bootstrap's") == "refined";
  s.kelemen_weights = p.choice("weights", "expected", weight_names,
                               "credit by expected value, or Kelemen's, which weigh large steps "
                               "as independent samples too") == "kelemen";
  (void)p.choice("target", "luminance", target_names, "scalar that the chains follow");
  s.seed = static_cast<uint32_t>(p.integer("seed", 0, "", "another seed gives another picture"));
  if (s.chains < 0 || s.chains > 1 << 24) p.fail("chains", "\"chains\" must lie in [0, 2^24]");
  if (s.bootstrap_samples < 1) p.fail("bootstrapsamples", "\"bootstrapsamples\" must be positive");
  if (s.mutations_per_pixel < 1) {
    p.fail("mutationsperpixel", "\"mutationsperpixel\" must be positive");
  }
  return s;
}

class Pssmlt final : public Sampler {
 public:
  static constexpr const char* summary = "Metropolis light transport in primary sample space.";
  explicit Pssmlt(Parameters& p) : settings_(read_settings(p)) {}

  void start(const SamplerContext& context) override;
  double default_spp() const override { return settings_.mutations_per_pixel; }
  int units(int64_t) const override { return chain_count_ / chains_a_unit; }
  double samples(int64_t) const override { return double(chain_count_) * steps_; }
  void run(int64_t round, int unit, SplatSink& sink, Worker& worker) override;
  int planes() const override { return settings_.kelemen_weights ? 2 : 1; }
  double scale(int plane, int subset, int64_t rounds) const override;
  double group_scale(int plane, int group, int64_t rounds) const override;
  double scale_relative_variance() const override;
  bool is_chain() const override { return true; }
  void save(Archive& archive) const override;
  void load(Archive& archive) override;
  bool replay(const std::string& key, Worker& worker) override;
  std::vector<std::string> warnings() const override;
  std::string unknown_error() const override;
  std::string remedy() const override;
  void report(nlohmann::json& statistics) const override;

 private:
  void plan(const RasterFrame& frame);
  void bootstrap(const SamplerContext& context);
  void start_chains(const SamplerContext& context);
  int group(int chain) const;
  void start_chain(int chain, uint32_t candidate, Worker& worker);
  WalkTally total() const;
  MeanTally normalisation() const;
  bool black() const { return chains_.empty(); }

  Settings settings_;
  WalkSettings walk_;
  std::optional<StepChooser> chooser_;
  double pixels_ = 1.0;
  int chain_count_ = 0;
  int steps_ = 1;                   // mutations of each chain in a round
  std::vector<double> candidates_;  // target's values, until the chains have started
  MeanTally bootstrap_;
  uint64_t contributing_ = 0;  // candidates that found light
  std::vector<Chain> chains_;
  std::vector<WalkTally> tallies_;  // by unit
};

void Pssmlt::start(const SamplerContext& context) {
  if (!context.integrator.fixed()) {
    throw Error(
        "sampler \"pssmlt\": this integrator's estimate changes from round to round, so that "
        "no Markov chain can follow it; choose another sampler");
  }
  plan(context.raster_map.frame());
  walk_.seed = mix_bits(context.seed + mix_bits(settings_.seed));
  bootstrap(context);
  if (bootstrap_.sum > 0.0) start_chains(context);
  for (const std::string& warning : warnings()) log_warning(warning);
  candidates_ = {};
}

// Chains, round length and film steps: functions of the settings and the picture alone.
void Pssmlt::plan(const RasterFrame& frame) {
  pixels_ = frame.pixels();
  int64_t chains = settings_.chains;
  if (chains == 0) chains = std::clamp<int64_t>(static_cast<int64_t>(pixels_ / 64), 512, 16384);
  chain_count_ = static_cast<int>((chains + group_count - 1) / group_count * group_count);
  if (settings_.chains != 0 && chain_count_ != settings_.chains) {
    log_info("sampler \"pssmlt\": \"chains\" rounded up to " + std::to_string(chain_count_));
  }
  const int64_t a_round = std::min(static_cast<int64_t>(pixels_), mutations_a_round);
  steps_ = static_cast<int>(std::clamp<int64_t>(a_round / chain_count_, 16, 1024));

  const KernelChoice& k = settings_.kernels;
  walk_.kernel = Kernel(k.shape, k.scale);
  // The same distance in pixels along both axes.
  const dvec2 size(frame.crop_size());
  const double side = std::sqrt(size.x * size.y);
  walk_.film_x = Kernel(k.shape, k.film_scale * side / size.x);
  walk_.film_y = Kernel(k.shape, k.film_scale * side / size.y);
}

void Pssmlt::bootstrap(const SamplerContext& context) {
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
      if (good) candidates_[static_cast<size_t>(i)] = luminance(worker.splats);
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

void Pssmlt::start_chains(const SamplerContext& context) {
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

void Pssmlt::start_chain(int chain, uint32_t candidate, Worker& worker) {
  CandidateSource source(walk_.seed, candidate);
  worker.sample.begin(source);
  (void)worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
  Chain& c = chains_[static_cast<size_t>(chain)];
  store_numbers(worker.sample, c.numbers);
  c.splats = worker.splats.all();
  c.credit = worker.sample.credit();
  c.value = candidates_[candidate];
}

void Pssmlt::run(int64_t round, int unit, SplatSink& sink, Worker& worker) {
  if (black()) return;
  const double beta = bootstrap_.mean();
  const CreditRule rule = settings_.kelemen_weights ? CreditRule::kelemen(beta, settings_.mix.large)
                                                    : CreditRule::expected(beta);
  Walker walker(walk_, *chooser_, worker.sample);
  Splats current;
  current.keep_tags(worker.splats.keeps_tags());
  WalkTally tally;
  const auto mutation = static_cast<uint64_t>(round) * static_cast<uint64_t>(steps_);
  for (int c = unit * chains_a_unit; c < (unit + 1) * chains_a_unit; ++c) {
    Chain& chain = chains_[static_cast<size_t>(c)];
    ChainHost host(sink, worker, current, group(c));
    host.restore(chain);
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
int Pssmlt::group(int chain) const {
  const int stretch = static_cast<int>(int64_t{chain} * group_count / chain_count_);
  return stretch < group_count / 2 ? 2 * stretch : 2 * stretch - (group_count - 1);
}

double Pssmlt::scale(int plane, int, int64_t rounds) const {
  if (rounds == 0 || black()) return 0.0;
  const double a_mutation = pixels_ / (samples(0) * rounds);
  if (plane == 1) return a_mutation;
  return a_mutation * normalisation().mean() / bootstrap_.mean();
}

double Pssmlt::group_scale(int plane, int, int64_t rounds) const {
  return scale(plane, 0, rounds) * group_count;
}

double Pssmlt::scale_relative_variance() const {
  const MeanTally b = normalisation();
  return b.mean() > 0.0 ? sqr(b.standard_error() / b.mean()) : 0.0;
}

WalkTally Pssmlt::total() const {
  WalkTally sum;
  for (const WalkTally& tally : tallies_) sum.merge(tally);
  return sum;
}

// b with its error: the bootstrap's samples, and every large step's if b is refined.
MeanTally Pssmlt::normalisation() const {
  MeanTally b = bootstrap_;
  if (settings_.refine_b) b.merge(total().large_values);
  return b;
}

void Pssmlt::save(Archive& archive) const {
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

void Pssmlt::load(Archive& archive) {
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

bool Pssmlt::replay(const std::string& key, Worker& worker) {
  if (!numbers_from_text(key, worker.sample)) return false;
  (void)worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
  return true;
}

std::vector<std::string> Pssmlt::warnings() const {
  std::vector<std::string> result;
  if (black()) {
    result.push_back("sampler \"pssmlt\": none of " + std::to_string(settings_.bootstrap_samples) +
                     " bootstrap samples found any light; the picture is black");
  } else if (contributing_ < least_bootstrap) {
    result.push_back("sampler \"pssmlt\": " + unknown_error() +
                     ": brightness and error are unknown; raise \"bootstrapsamples\", or choose an "
                     "integrator that finds the light more often");
  }
  if (settings_.mix.large <= 0.0) {
    result.emplace_back(
        "sampler \"pssmlt\": \"largestepprobability\" is 0: no chain gets where small steps do not "
        "lead, b is the bootstrap's alone, and neither shows in the estimated error");
  }
  return result;
}

std::string Pssmlt::unknown_error() const {
  if (contributing_ >= least_bootstrap) return "";
  return "only " + std::to_string(contributing_) + " of " +
         std::to_string(settings_.bootstrap_samples) +
         " bootstrap samples found light, fewer than " + std::to_string(least_bootstrap);
}

// By the commonest causes in the order of how sure their signs are.
std::string Pssmlt::remedy() const {
  const WalkTally sum = total();
  const WalkTally::Kind& large = sum.kinds[static_cast<size_t>(StepKind::large)];
  WalkTally::Kind small;
  for (const WalkTally::Kind& k : sum.kinds) {
    small.proposed += k.proposed;
    small.accepted += k.accepted;
  }
  small.proposed -= large.proposed;
  small.accepted -= large.accepted;
  const double rate =
      small.proposed > 0 ? static_cast<double>(small.accepted) / static_cast<double>(small.proposed)
                         : 0.5;
  if (settings_.mix.large <= 0.0) return "\"largestepprobability\", which is 0";
  if (rate < least_acceptance) {
    return "smaller steps (\"sigma\" with the kernel \"gaussian\"): they are hardly ever accepted";
  }
  if (rate > most_acceptance) {
    return "larger steps (\"sigma\" with the kernel \"gaussian\"): nearly all are accepted, so "
           "that "
           "chains do not get far";
  }
  if (sum.longest_stuck >= stuck_mutations) {
    return "more \"chains\" and \"bootstrapsamples\": a chain stayed in one state for " +
           std::to_string(sum.longest_stuck) + " mutations";
  }
  return "a larger \"largestepprobability\", or more \"chains\"";
}

void Pssmlt::report(nlohmann::json& statistics) const {
  const WalkTally sum = total();
  const MeanTally b = normalisation();
  nlohmann::json& acceptance = statistics["acceptance"];
  acceptance = nlohmann::json::object();
  uint64_t mutations = 0, accepted = 0;
  for (size_t k = 0; k < step_kinds; ++k) {
    const WalkTally::Kind& kind = sum.kinds[k];
    mutations += kind.proposed;
    accepted += kind.accepted;
    if (kind.proposed == 0) continue;
    acceptance[std::string(to_string(static_cast<StepKind>(k)))] = {
        {"mutations", kind.proposed},
        {"rate", static_cast<double>(kind.accepted) / static_cast<double>(kind.proposed)}};
  }
  statistics["acceptance_rate"] =
      mutations > 0 ? static_cast<double>(accepted) / static_cast<double>(mutations) : 0.0;
  statistics["mutations"] = mutations;
  statistics["chains"] = chain_count_;
  statistics["b"] = b.mean();
  statistics["b_standard_error"] = b.standard_error();
  statistics["b_samples"] = b.count;
  statistics["longest_stuck"] = sum.longest_stuck;
  statistics["bootstrap_samples"] = bootstrap_.count;
  statistics["bootstrap_contributing"] = contributing_;
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "pssmlt", pssmlt::Pssmlt)
