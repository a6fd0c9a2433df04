#include "core/excess/redistribution_sampler.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/log.h"
#include "core/render/error_estimate.h"

namespace pssmlt {

RedistributionSamplerSettings read_redistribution(Parameters& p) {
  RedistributionSamplerSettings s;
  s.samples = p.integer("pixelsamples", 16, "samples",
                        "default budget, per pixel: samples and mutations together");
  s.plan.pilot_samples =
      p.integer("pilotsamples", 0, "samples",
                "Sobol' points that give the local means; 0: four a pixel and more, "
                "fewer on large pictures");
  s.plan.threshold =
      p.number("threshold", 0.f, "local means",
               "what samples are worth above this is spread by chains; 0: chosen by the "
               "pilot");
  s.plan.mutations = p.number("mutations", -1.f, "mutations",
                              "for each sample, on average; below 0: chosen by the pilot");
  s.plan.length = p.integer("chainlength", 500, "mutations", "of a chain");
  s.plan.chains.most_chains = p.integer(
      "mostchains", 0, "", "chains from one sample; 0: as many as make 8192 mutations together");
  s.plan.chains.mix = read_step_mix(p, 0.f);
  s.plan.chains.kernels = read_kernels(p);
  s.seed = p.integer("seed", 0, "", "another seed gives another picture");
  if (s.samples < 1) p.fail("pixelsamples", "\"pixelsamples\" must be at least 1");
  if (s.plan.pilot_samples < 0) p.fail("pilotsamples", "\"pilotsamples\" must not be negative");
  if (!(s.plan.threshold >= 0.0)) p.fail("threshold", "\"threshold\" must not be negative");
  if (!(s.plan.mutations <= 100.0)) p.fail("mutations", "\"mutations\" must be at most 100");
  if (s.plan.length < 1) p.fail("chainlength", "\"chainlength\" must be positive");
  if (s.plan.chains.most_chains < 0) {
    p.fail("mostchains", "\"mostchains\" must not be negative");
  }
  return s;
}

RedistributionSampler::RedistributionSampler(const char* name,
                                             const RedistributionSamplerSettings& s, Chains chains)
    : SobolSweeps(name, s.samples, static_cast<uint32_t>(s.seed)),
      name_(name),
      settings_(s),
      use_(chains),
      above_(limit_),
      chains_(s.plan.chains) {}

void RedistributionSampler::start(const SamplerContext& context) {
  SobolSweeps::start(context);
  plan_ = {};
  limit_ = {};
  work_ = 1.0;
  if (context.integrator.fixed()) return plan(context);
  // Its estimate now is not that of later rounds.
  if (is_chain()) {
    throw Error("sampler \"" + std::string(name_) +
                "\": this integrator's estimate changes from round to round, so that no Markov "
                "chain can follow it; choose another sampler");
  }
  log_info(fmt::format(
      "sampler \"{}\": the integrator's estimate changes from round to round: Sobol' points alone",
      name_));
}

void RedistributionSampler::plan(const SamplerContext& context) {
  RedistributionPlanSettings settings = settings_.plan;
  if (context.clamped) settings.mutations = 0.0;
  plan_ = plan_redistribution(context, mix_bits(seed() + 0x70696C6F74u), settings);
  const RedistributionOption& o = plan_.option();
  limit_ = {&plan_.mean, o.threshold};
  if (plan_.chains()) {
    chains_.start(context, above_);
    chains_.set(o.length, o.deposit);
    // With the sample where a chain starts, which is evaluated again.
    work_ += o.mutations * (1.0 + 1.0 / o.length);
  }
  const std::string me = fmt::format("sampler \"{}\": ", name_);
  for (const RedistributionOption& one : plan_.options) log_debug(me + to_string(one));
  log_info(me + plan_.why());
  for (const std::string& warning : warnings()) log_warning(warning);
}

void RedistributionSampler::add_rest(const SampleId& id, double rest, int plane, SplatSink& sink,
                                     Worker& worker) const {
  const uint64_t key = mix_bits(seed() + mix_bits(id.sweep << 32 | id.pixel));
  chains_.run(key, rest, plane, id.group(), sink, worker);
}

std::string RedistributionSampler::unknown_error() const {
  if (plan_.options.empty() || plan_.finds >= static_cast<uint64_t>(least_bootstrap)) return "";
  return fmt::format("only {} of {} pilot samples found light, fewer than {}", plan_.finds,
                     plan_.samples, least_bootstrap);
}

std::vector<std::string> RedistributionSampler::warnings() const {
  const std::string why = unknown_error();
  if (why.empty()) return {};
  return {
      fmt::format("sampler \"{}\": {}: the error is unknown; choose an integrator that finds "
                  "the light more often",
                  name_, why)};
}

void RedistributionSampler::report(nlohmann::json& statistics) const {
  if (plan_.options.empty()) return;
  const RedistributionOption& o = plan_.option();
  statistics["integrator_chosen"] = o.integrator;
  statistics["chain_share"] = 1.0 - 1.0 / work_;
  statistics["excess"] = o.light.mean > 0.0 ? o.excess / o.light.mean : 0.0;
  if (limit_.finite()) statistics["threshold"] = limit_.threshold;
}

}  // namespace pssmlt
