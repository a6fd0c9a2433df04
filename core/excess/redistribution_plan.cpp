#include "core/excess/redistribution_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/excess/excess_limit.h"

namespace pssmlt {
namespace {

// The limit for which chains are tried, where none is asked for [local means].
constexpr double trial_threshold = 4.0;
// Limits that are considered [local means]: with larger ones too much stays as it is, however
// little the pilot shows of that (docs/results.md).
constexpr double largest_threshold = 16.0;
constexpr int deep_pixels = 512;  // of the pilots that tell variances

// A variance that few samples make is likely to be larger than it looks: so many standard errors
// are added.
constexpr double caution = 2.0;

double cautious(const RelativePilot::Variances& v) { return v.below + caution * v.below_error; }

// Of samples as they are. What is bright is so seldom met that the deep pilot may know nothing of
// it.
double plain_variance(const RelativePilot& deep, const RelativePilot& wide) {
  double squares = 0.0, fourths = 0.0;
  for (const RelativePilot::Above& a : wide.above(largest_threshold)) {
    squares += a.squares;
    fourths += a.squares * a.squares;
  }
  return cautious(deep.variances(largest_threshold, 1.0)) +
         (squares + caution * std::sqrt(fourths)) / static_cast<double>(wide.samples());
}

std::vector<PilotLight> lights(const std::vector<RedistributionOption>& options) {
  std::vector<PilotLight> all;
  for (const RedistributionOption& o : options) all.push_back(o.light);
  return all;
}

// What samples above a limit leave as noise if chains of this length and number spread them. A
// sample worth less than a chain's deposit gives one seldom, which then carries more; one worth
// more gives several.
void spread(std::span<const RelativePilot::Above> above, double samples, int most_chains,
            const SpreadRemainder& remainder, RedistributionOption& option) {
  option.deposit = option.excess * option.length / option.mutations;
  double squares = 0.0, fourths = 0.0;
  for (const RelativePilot::Above& a : above) {
    const double chains = a.value / option.deposit;
    const double several = std::clamp(chains, 1.0, static_cast<double>(most_chains));
    const double left =
        a.squares * std::max(1.0, 1.0 / chains) * remainder.at(option.length * several);
    squares += left;
    fourths += left * left;
  }
  option.variance += (squares + caution * std::sqrt(fourths)) / samples;
}

// Of the integrator that is chosen.
SpreadTrial try_chains(const SamplerContext& context, uint64_t seed,
                       const RedistributionPlanSettings& settings, const ExcessPilots::Seeded& wide,
                       const LocalMean& mean, const RelativePilot& relative) {
  // Nothing to be decided.
  if (settings.mutations == 0.0) return {};
  const double threshold = settings.threshold > 0.0 ? settings.threshold : trial_threshold;
  const ExcessLimit limit{&mean, threshold};
  const AboveLimit target(limit);
  return try_spreading(context, mix_bits(seed + 0x73707264u), wide.pilot, wide.seed, mean, target,
                       relative.above(threshold), settings.chains);
}

}  // namespace

void choose_redistribution(const RelativePilot& deep, const RelativePilot& wide,
                           const RedistributionPlanSettings& settings, const SpreadTrial& trial,
                           RedistributionOption& option) {
  option.mutation_rays = std::max(trial.rays, option.rays);
  option.plain = option.variance = plain_variance(deep, wide);
  bool asked = settings.mutations > 0.0;  // done even if it does not pay
  const auto consider = [&](RedistributionOption one, std::span<const RelativePilot::Above> above) {
    spread(above, static_cast<double>(wide.samples()), settings.chains.chains_of(one.length),
           trial.remainder, one);
    if (asked || one.effort() < option.effort()) option = one;
    asked = false;
  };
  const bool free = !(settings.threshold > 0.0);
  const double first = free ? 1.0 : settings.threshold, last = free ? largest_threshold : first;
  for (double threshold = first; threshold <= last && settings.mutations != 0.0; threshold *= 2.0) {
    const std::vector<RelativePilot::Above> above = wide.above(threshold);
    if (above.empty()) break;
    const double below = cautious(deep.variances(threshold, 1.0));
    RedistributionOption one = option;
    one.threshold = threshold;
    one.length = settings.length;
    one.excess = 0.0;
    for (const RelativePilot::Above& a : above) {
      one.excess += a.value / static_cast<double>(wide.samples());
    }
    for (double mutations = 1.0 / 16.0; mutations <= 1.0; mutations *= 2.0) {
      one.mutations = settings.mutations > 0.0 ? settings.mutations : mutations;
      one.variance = below;
      consider(one, above);
    }
  }
}

size_t best_option(const std::vector<RedistributionOption>& options) {
  const std::vector<PilotLight> all = lights(options);
  size_t best = options.size();
  for (size_t i = 0; i < options.size(); ++i) {
    if (misses_light(options[i].light, all)) continue;
    if (best == options.size() || options[i].effort() < options[best].effort()) best = i;
  }
  return best;
}

RedistributionPlan plan_redistribution(const SamplerContext& context, uint64_t seed,
                                       const RedistributionPlanSettings& settings) {
  ExcessPilots found = run_excess_pilots(context, seed, settings.pilot_samples, deep_pixels);
  RedistributionPlan plan;
  for (size_t i = 0; i < found.wide.size(); ++i) {
    const RelativePilot wide(found.wide[i].pilot, found.mean);
    const RelativePilot deep(found.deep[i].pilot, found.mean);
    RedistributionOption o;
    o.integrator = context.integrator.alternative_name(static_cast<int>(i));
    o.light = {wide.light(), wide.light_error()};
    o.rays = found.wide[i].pilot.rays() / static_cast<double>(std::max<size_t>(1, wide.samples()));
    context.integrator.choose(static_cast<int>(i));
    const SpreadTrial trial = try_chains(context, seed, settings, found.wide[i], found.mean, wide);
    choose_redistribution(deep, wide, settings, trial, o);
    plan.options.push_back(o);
  }
  plan.chosen = best_option(plan.options);
  context.integrator.choose(static_cast<int>(plan.chosen));
  plan.samples = found.deep[plan.chosen].pilot.samples();
  plan.finds = found.deep[plan.chosen].pilot.finds();
  plan.mean = std::move(found.mean);
  return plan;
}

std::string RedistributionPlan::why() const {
  std::string text;
  if (options.size() > 1) {
    text =
        option().integrator + (option().effort() > 0.0 ? " needs the fewest rays for a given noise"
                                                       : " finds as much as the others");
    const std::vector<PilotLight> all = lights(options);
    for (const RedistributionOption& o : options) {
      if (&o == &option() || !(option().effort() > 0.0)) continue;
      text += misses_light(o.light, all) ? fmt::format(", {} misses light", o.integrator)
                                         : fmt::format(", {} {:.2g} times as many", o.integrator,
                                                       o.effort() / option().effort());
    }
    text += "; ";
  }
  if (!chains()) return text + "no samples stand out enough for chains: Sobol' points alone";
  const RedistributionOption& o = option();
  return text + fmt::format(
                    "what samples are worth above {:.3g} local means ({:.2g} of the light) is "
                    "spread by chains of {} mutations, {:.2g} mutations a sample",
                    o.threshold, o.light.mean > 0.0 ? o.excess / o.light.mean : 0.0, o.length,
                    o.mutations);
}

std::string to_string(const RedistributionOption& o) {
  const std::string text = fmt::format(
      "{}: {:.3g} rays a sample, light {:.4g} +- {:.2g} local means, variance of a sample {:.3g}",
      o.integrator, o.rays, o.light.mean, o.light.error, o.plain);
  if (!(o.mutations > 0.0)) return text + "; without chains";
  return text +
         fmt::format(
             "; {:.3g} expected with {:.2g} mutations in chains of {}, spread above {:.3g} local "
             "means",
             o.variance, o.mutations, o.length, o.threshold);
}

}  // namespace pssmlt
