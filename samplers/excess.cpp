// Metropolis sampling for outliers alone. A pilot finds how bright the picture is about each pixel;
// with T times that as a limit, every sample's contribution f is split into f min(1, T / |f|) and
// f max(0, 1 - T / |f|), |f| being the sum of its splats' luminances relative to the local mean.
// The first part has no fireflies and is integrated by Sobol' points, the same number in every
// pixel; the second is zero almost everywhere and is what Markov chains follow, so that they spend
// their mutations where independent samples fail. In the spirit of Bitterli and Jarosz 2019,
// Selectively Metropolised Monte Carlo light transport simulation, who choose samples by bounds on
// path densities; here any integrator will do. Unbiased for every T fixed in advance, up to the
// bias of b (pssmlt).
//
// Good where few samples carry much light: caustics seen by a path tracer, light through a door.
// Where no samples stand out it is "sobol" after a pilot. Bad where small lamps are seen directly,
// whose pixels a short pilot takes for outliers. Its chains follow relative brightness, so
// that dark parts of the picture get their share. Blind to what no bootstrap sample finds, but only
// for light above the limit: what is cut off must have been found by enough of the pilot, else
// nothing is cut off.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/log.h"
#include "core/metropolis/chain_population.h"
#include "core/metropolis/excess_split.h"
#include "core/plugin/plugin.h"
#include "core/render/error_estimate.h"
#include "core/sampling/sobol_sweeps.h"

namespace pssmlt {
namespace {

// Fewer pilot samples above a limit than this, and it is not considered.
constexpr uint64_t least_above = 32;
// Mutations a pixel and sweep: more would make rounds long for little.
constexpr double most_mutations = 8.0;
// Of a round: small pictures with few mutations are left without chains.
constexpr double most_sweeps = 256.0;
// Fewer are not worth their chains.
constexpr double least_share = 1e-3;

// The limit, and both parts of a sample by it.
struct Limit {
  LocalMean mean;
  double threshold = static_cast<double>(infinity);
  double relative(const Splats& splats, const PixelCredit& camera) const {
    return mean.norms(splats, camera).sum;
  }
};

class Below final : public SobolSweeps {
 public:
  Below(const Limit& limit, double spp, uint64_t seed)
      : SobolSweeps("excess", spp, seed), limit_(limit) {}

 private:
  void reshape(Splats& splats, const PixelCredit& camera) const override {
    if (!std::isfinite(limit_.threshold)) return;
    const double r = limit_.relative(splats, camera);
    if (r > limit_.threshold) splats.scale(static_cast<float>(limit_.threshold / r));
  }
  const Limit& limit_;
};

class Above final : public ChainTarget {
 public:
  explicit Above(const Limit& limit) : limit_(limit) {}
  double evaluate(Splats& splats, const PixelCredit& camera) const override {
    const double r = limit_.relative(splats, camera);
    const double rest = std::max(0.0, r - limit_.threshold);
    splats.scale(rest > 0.0 ? static_cast<float>(rest / r) : 0.f);
    return rest;
  }

 private:
  const Limit& limit_;
};

struct Settings {
  PopulationSettings chains;
  int samples = 16, pilot_samples = 0;
  float threshold = 0.f, share = 0.f, stickiness = 8.f;
};

Settings read_settings(Parameters& p) {
  Settings s;
  s.samples = p.integer("pixelsamples", 16, "samples",
                        "default budget, per pixel: samples and mutations together");
  s.pilot_samples =
      p.integer("pilotsamples", 0, "samples",
                "independent samples that give the local means and the limit; 0: as many "
                "as bootstrapsamples, if given, else by the image size, and more where "
                "light is hard to find");
  s.threshold = p.number("threshold", 0.f, "local means",
                         "samples brighter than this are split; 0: chosen by the pilot");
  s.share = p.number("chainshare", 0.f, "",
                     "of all samples, mutations of chains; 0: chosen by the pilot");
  s.stickiness = p.number("stickiness", 8.f, "mutations",
                          "that are taken to be worth one independent sample, for both choices");
  s.chains = read_population(p, 0);
  if (s.samples < 1) p.fail("pixelsamples", "\"pixelsamples\" must be at least 1");
  if (s.pilot_samples < 0) p.fail("pilotsamples", "\"pilotsamples\" must not be negative");
  if (!(s.threshold >= 0.f)) p.fail("threshold", "\"threshold\" must not be negative");
  if (!(s.share >= 0.f && s.share < 1.f)) p.fail("chainshare", "\"chainshare\" must lie in [0, 1)");
  if (!(s.stickiness > 0.f)) p.fail("stickiness", "\"stickiness\" must be positive");
  return s;
}

class Excess final : public Sampler {
 public:
  static constexpr const char* summary =
      "Sobol' points for what is not exceptional, Markov chains for bright samples' excess.";
  explicit Excess(Parameters& p)
      : settings_(read_settings(p)),
        below_(limit_, settings_.samples, settings_.chains.seed),
        above_(limit_),
        chains_("excess", settings_.chains) {}

  void start(const SamplerContext& context) override;
  double default_spp() const override { return settings_.samples; }
  // Chains first: their units are the longer ones.
  int units(int64_t round) const override { return chain_units() + below_.units(round); }
  double samples(int64_t round) const override;
  void run(int64_t round, int unit, SplatSink& sink, Worker& worker) override;
  int planes() const override { return most_planes; }
  int subsets() const override { return below_.subsets(); }
  int subset_of(int pixel) const override { return below_.subset_of(pixel); }
  double scale(int plane, int subset, int64_t rounds) const override;
  double group_scale(int plane, int group, int64_t rounds) const override;
  // Chains are independent of one another, so that any two groups of them make a pair.
  bool pairs_groups() const override { return true; }
  double scale_relative_variance() const override;
  bool is_chain() const override { return true; }
  bool is_chain_plane(int plane) const override { return plane >= below_.planes(); }
  double mutations(int64_t rounds) const override { return mutations_a_round() * double(rounds); }
  double visits(const dvec2& place) const override { return 1.0 / limit_.mean.at(corner_ + place); }
  void save(Archive& archive) const override { chains_.save(archive); }
  void load(Archive& archive) override { chains_.load(archive); }
  bool replay(const std::string& key, Worker& worker) override {
    return below_.replay(key, worker) || chains_.replay(key, worker);
  }
  std::vector<std::string> warnings() const override;
  std::string unknown_error() const override;
  std::string remedy() const override { return chains_.remedy(); }
  void report(nlohmann::json& statistics) const override;

 private:
  // Two of the sweeps, on large pictures, and two of the chains, with Kelemen's weights.
  static constexpr int most_planes = 4;
  int chain_units() const { return split() ? chains_.units() : 0; }
  double mutations_a_round() const { return split() ? chains_.mutations() : 0.0; }
  bool split() const { return std::isfinite(limit_.threshold); }
  std::vector<RelativeNorms> pilot(const SamplerContext& context);
  void choose(std::span<const RelativeNorms> norms);
  uint64_t least_contributing() const;
  // Of the chains' bootstrap.
  int candidates() const {
    const int given = settings_.chains.bootstrap_samples;
    return given > 0 ? given : std::max(pilots_ / 2, 8192);
  }
  void start_chains(const SamplerContext& context);
  void tell() const;

  Settings settings_;
  Limit limit_;
  ExcessSplit split_;
  dvec2 corner_{0.0};   // of the window [pixels]
  int sweeps_ = 1;      // of a round; more than one where the chains could not take shorter turns
  double light_ = 0.0;  // mean of all pilot samples [local means]
  int pilots_ = 0;      // how many there were
  size_t finds_ = 0;    // those with light
  Below below_;
  Above above_;
  ChainPopulation chains_;
};

void Excess::start(const SamplerContext& context) {
  if (!context.integrator.fixed()) {
    throw Error(
        "sampler \"excess\": this integrator's estimate changes from round to round, so that no "
        "Markov chain can follow it; choose another sampler");
  }
  limit_ = {};
  corner_ = dvec2(context.raster_map.frame().crop_min);
  below_.start(context);
  choose(pilot(context));
  start_chains(context);
  tell();
  for (const std::string& warning : warnings()) log_warning(warning);
}

std::vector<RelativeNorms> Excess::pilot(const SamplerContext& context) {
  const uint64_t seed = mix_bits(mix_bits(context.seed + 0x70696C6F74u) + settings_.chains.seed);
  const Pilot all = run_pilot(
      context, seed,
      settings_.pilot_samples > 0 ? settings_.pilot_samples : settings_.chains.bootstrap_samples);
  pilots_ = static_cast<int>(all.samples());
  finds_ = all.finds();
  limit_.mean = LocalMean(context.raster_map.frame(), all);
  std::vector<RelativeNorms> norms;
  norms.reserve(all.samples());
  for (size_t i = 0; i < all.samples(); ++i) norms.push_back(limit_.mean.norms(all.sample(i)));
  return norms;
}

void Excess::choose(std::span<const RelativeNorms> norms) {
  light_ = 0.0;
  for (const RelativeNorms& n : norms) light_ += n.sum / static_cast<double>(norms.size());
  const auto stickiness = static_cast<double>(settings_.stickiness);
  split_ = settings_.threshold > 0.f
               ? split_at(norms, static_cast<double>(settings_.threshold), stickiness)
               : choose_split(norms, stickiness, least_contributing());
  if (settings_.share > 0.f) split_.chain_share = static_cast<double>(settings_.share);
  const bool known = split_.contributing >= least_contributing();
  if (known && split_.chain_share >= least_share) limit_.threshold = split_.threshold;
}

// Pilot samples above the limit that promise `least_above` candidates of the chains' own.
uint64_t Excess::least_contributing() const {
  const double times = static_cast<double>(pilots_) / candidates();
  return static_cast<uint64_t>(static_cast<double>(least_above) * std::max(1.0, times));
}

void Excess::start_chains(const SamplerContext& context) {
  sweeps_ = 1;
  if (!split()) return;
  const double a_sample = std::min(split_.chain_share / (1.0 - split_.chain_share), most_mutations);
  const double sweeps = std::ceil(group_count / (a_sample * below_.samples(0)));
  if (sweeps > most_sweeps) {
    limit_.threshold = static_cast<double>(infinity);
    return;
  }
  sweeps_ = static_cast<int>(sweeps);
  chains_.start(context, above_, {a_sample * sweeps_ * below_.samples(0), candidates()});
  // Whether to split must not depend on what b is made of, lest b be biased; but without chains
  // what is cut off would be lost.
  if (!chains_.empty()) return;
  limit_.threshold = static_cast<double>(infinity);
  sweeps_ = 1;
}

double Excess::samples(int64_t round) const {
  double sum = mutations_a_round();
  for (int k = 0; k < sweeps_; ++k) sum += below_.samples(round * sweeps_ + k);
  return sum;
}

void Excess::run(int64_t round, int unit, SplatSink& sink, Worker& worker) {
  if (unit < chain_units()) return chains_.run(round, unit, below_.planes(), sink, worker);
  for (int k = 0; k < sweeps_; ++k) {
    below_.run(round * sweeps_ + k, unit - chain_units(), sink, worker);
  }
}

void Excess::tell() const {
  if (!split()) {
    return log_info(
        "sampler \"excess\": no samples stand out enough for chains; Sobol' points alone");
  }
  log_info(fmt::format(
      "sampler \"excess\": samples above {:.3g} local means are split, {:.2g} of the light lies "
      "above; chains make {:.2g} of the samples",
      limit_.threshold, light_ > 0.0 ? split_.excess / light_ : 0.0,
      mutations_a_round() / samples(0)));
}

double Excess::scale(int plane, int subset, int64_t rounds) const {
  if (plane < below_.planes()) return below_.scale(plane, subset, rounds * sweeps_);
  if (!split()) return 0.0;
  return plane == below_.planes() ? chains_.scale(rounds) : chains_.large_scale(rounds);
}

double Excess::group_scale(int plane, int group, int64_t rounds) const {
  if (plane < below_.planes()) return below_.group_scale(plane, group, rounds * sweeps_);
  return scale(plane, 0, rounds) * group_count;
}

// b scales no more than the part of the light that is cut off.
double Excess::scale_relative_variance() const {
  if (!split() || !(light_ > 0.0)) return 0.0;
  return chains_.scale_relative_variance() * sqr(std::min(1.0, split_.excess / light_));
}

// Without a split the pilot's finds stand for what is known of the light.
std::string Excess::unknown_error() const {
  if (split()) return chains_.unknown_error();
  if (finds_ >= static_cast<size_t>(least_bootstrap)) return "";
  return fmt::format("only {} of {} pilot samples found light, fewer than {}", finds_, pilots_,
                     least_bootstrap);
}

std::vector<std::string> Excess::warnings() const {
  if (split()) return chains_.warnings();
  const std::string why = unknown_error();
  if (why.empty()) return {};
  return {"sampler \"excess\": " + why +
          ": the error is unknown; choose an integrator that finds the light more often"};
}

void Excess::report(nlohmann::json& statistics) const {
  if (split()) {
    chains_.report(statistics);
    statistics["threshold"] = limit_.threshold;
  } else {
    statistics["bootstrap_samples"] = pilots_;
    statistics["bootstrap_contributing"] = finds_;
  }
  statistics["excess"] = split() && light_ > 0.0 ? split_.excess / light_ : 0.0;
  statistics["chain_share"] = mutations_a_round() / samples(0);
}

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Sampler, "excess", pssmlt::Excess)
