#include "core/excess/excess_sampler.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/log.h"
#include "core/render/error_estimate.h"

namespace pssmlt {
namespace {

// Mutations a pixel and sweep: more would make rounds long for little.
constexpr double most_mutations = 8.0;
// Of a round: small pictures with few mutations are left without chains.
constexpr double most_sweeps = 256.0;

ExcessSettings read_settings(Parameters& p) {
  ExcessSettings s;
  s.samples = p.integer("pixelsamples", 16, "samples",
                        "default budget, per pixel: samples and mutations together");
  s.pilot_samples =
      p.integer("pilotsamples", 0, "samples",
                "Sobol' points that give the local means and the limit; 0: as many as "
                "bootstrapsamples, if given, else four a pixel, fewer on large pictures and "
                "more where light is hard to find");
  s.threshold = p.number("threshold", 0.f, "local means",
                         "samples brighter than this are split; 0: chosen by the pilot");
  s.share = p.number("chainshare", 0.f, "",
                     "of all samples, mutations of chains; 0: chosen by the pilot");
  s.stickiness = p.number("stickiness", 0.f, "mutations",
                          "that are taken to be worth one independent sample, for both choices; 0: "
                          "measured by chains on trial");
  s.chains = read_population(p, 0);
  if (s.samples < 1) p.fail("pixelsamples", "\"pixelsamples\" must be at least 1");
  if (s.pilot_samples < 0) p.fail("pilotsamples", "\"pilotsamples\" must not be negative");
  if (!(s.threshold >= 0.f)) p.fail("threshold", "\"threshold\" must not be negative");
  if (!(s.share >= 0.f && s.share < 1.f)) p.fail("chainshare", "\"chainshare\" must lie in [0, 1)");
  if (!(s.stickiness >= 0.f)) p.fail("stickiness", "\"stickiness\" must not be negative");
  return s;
}

}  // namespace

ExcessSampler::ExcessSampler(const char* name, Parameters& parameters)
    : name_(name),
      settings_(read_settings(parameters)),
      below_(name, limit_, settings_.samples, settings_.chains.seed),
      above_(limit_),
      chains_(name, settings_.chains) {}

void ExcessSampler::start(const SamplerContext& context) {
  if (!context.integrator.fixed()) {
    throw Error("sampler \"" + std::string(name_) +
                "\": this integrator's estimate changes from round to round, so that no "
                "Markov chain can follow it; choose another sampler");
  }
  limit_ = {};
  corner_ = dvec2(context.raster_map.frame().crop_min);
  below_.start(context);
  choose(context);
  start_chains(context);
  tell();
  for (const std::string& warning : warnings()) log_warning(warning);
}

void ExcessSampler::choose(const SamplerContext& context) {
  const uint64_t seed = mix_bits(mix_bits(context.seed + 0x70696C6F74u) + settings_.chains.seed);
  const int given = settings_.chains.bootstrap_samples;
  plan_ =
      plan_excess(context, seed,
                  {.pilot_samples = settings_.pilot_samples > 0 ? settings_.pilot_samples : given,
                   .threshold = static_cast<double>(settings_.threshold),
                   .share = static_cast<double>(settings_.share),
                   .stickiness = static_cast<double>(settings_.stickiness),
                   .candidates = given,
                   .chains = settings_.chains});
  limit_.mean = &plan_.mean;
  if (plan_.worth_chains) limit_.threshold = plan_.split.threshold;
}

void ExcessSampler::start_chains(const SamplerContext& context) {
  sweeps_ = 1;
  if (!split()) return;
  const double share = plan_.split.chain_share;
  const double a_sample = std::min(share / (1.0 - share), most_mutations);
  const double sweeps = std::ceil(group_count / (a_sample * below_.samples(0)));
  if (sweeps > most_sweeps) {
    limit_.threshold = static_cast<double>(infinity);
    return;
  }
  sweeps_ = static_cast<int>(sweeps);
  chains_.start(context, above_, {a_sample * sweeps_ * below_.samples(0), plan_.candidates});
  // Whether to split must not depend on what b is made of, lest b be biased; but without chains
  // what is cut off would be lost.
  if (!chains_.empty()) return;
  limit_.threshold = static_cast<double>(infinity);
  sweeps_ = 1;
}

double ExcessSampler::samples(int64_t round) const {
  double sum = mutations_a_round();
  for (int k = 0; k < sweeps_; ++k) sum += below_.samples(round * sweeps_ + k);
  return sum;
}

void ExcessSampler::run(int64_t round, int unit, SplatSink& sink, Worker& worker) {
  if (unit < chain_units()) return chains_.run(round, unit, below_.planes(), sink, worker);
  for (int k = 0; k < sweeps_; ++k) {
    below_.run(round * sweeps_ + k, unit - chain_units(), sink, worker);
  }
}

void ExcessSampler::tell() const {
  const std::string me = fmt::format("sampler \"{}\": ", name_);
  log_debug(me + to_string(plan_));
  if (!split()) {
    return log_info(me + "no samples stand out enough for chains: Sobol' points alone");
  }
  log_info(me + fmt::format(
                    "samples above {:.3g} local means are split, {:.2g} of the light lies above; "
                    "chains make {:.2g} of the samples",
                    limit_.threshold, excess(), mutations_a_round() / samples(0)));
}

double ExcessSampler::scale(int plane, int subset, int64_t rounds) const {
  if (plane < below_.planes()) return below_.scale(plane, subset, rounds * sweeps_);
  if (!split()) return 0.0;
  return plane == below_.planes() ? chains_.scale(rounds) : chains_.large_scale(rounds);
}

double ExcessSampler::group_scale(int plane, int group, int64_t rounds) const {
  if (plane < below_.planes()) return below_.group_scale(plane, group, rounds * sweeps_);
  return scale(plane, 0, rounds) * group_count;
}

double ExcessSampler::scale_relative_variance() const {
  return split() ? chains_.scale_relative_variance() : 0.0;
}

// Without a split the pilot's finds stand for what is known of the light.
std::string ExcessSampler::unknown_error() const {
  if (split()) return chains_.unknown_error();
  const ExcessPlan& o = plan_;
  if (o.finds >= static_cast<uint64_t>(least_bootstrap)) return "";
  return fmt::format("only {} of {} pilot samples found light, fewer than {}", o.finds, o.pilots,
                     least_bootstrap);
}

std::vector<std::string> ExcessSampler::warnings() const {
  if (split()) return chains_.warnings();
  const std::string why = unknown_error();
  if (why.empty()) return {};
  return {"sampler \"excess\": " + why +
          ": the error is unknown; choose an integrator that finds the light more often"};
}

void ExcessSampler::report(nlohmann::json& statistics) const {
  if (split()) {
    chains_.report(statistics);
    statistics["threshold"] = limit_.threshold;
  } else {
    statistics["bootstrap_samples"] = plan_.pilots;
    statistics["bootstrap_contributing"] = plan_.finds;
  }
  statistics["excess"] = split() ? excess() : 0.0;
  statistics["chain_share"] = mutations_a_round() / samples(0);
}

}  // namespace pssmlt
