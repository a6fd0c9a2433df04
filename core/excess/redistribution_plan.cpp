#include "core/excess/redistribution_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace pssmlt {
namespace {

// Chains of this length lower the variance of what they spread by that much: measured (from
// door-ajar, mirror-maze, glass-caustics; docs/results.md), since what they reach is not known in
// advance.
struct Spread {
  int length;
  double gain;
};
constexpr std::array<Spread, 3> spreads = {{{20, 5.0}, {100, 6.0}, {500, 7.0}}};

double gain_of(int length) {
  double gain = 1.0;
  for (const Spread& s : spreads) {
    if (length >= s.length) gain = s.gain;
  }
  return gain;
}

std::vector<PilotLight> lights(const std::vector<RedistributionOption>& options) {
  std::vector<PilotLight> all;
  for (const RedistributionOption& o : options) all.push_back(o.light);
  return all;
}

// What samples above a limit leave as noise if chains of this length and number spread them. A
// sample worth less than a chain's deposit gives one seldom, which then carries more.
void spread(std::span<const RelativePilot::Above> above, double samples,
            RedistributionOption& option) {
  option.deposit = option.excess * option.length / option.mutations;
  double squares = 0.0;
  for (const RelativePilot::Above& a : above) {
    squares += a.squares * std::max(1.0, option.deposit / a.value);
  }
  option.variance += squares / samples / gain_of(option.length);
}

}  // namespace

void choose_redistribution(const RelativePilot& pilot, const RedistributionPlanSettings& settings,
                           RedistributionOption& option) {
  option.plain = option.variance = pilot.variances(static_cast<double>(infinity), 1.0).below;
  bool asked = settings.mutations > 0.0;  // done even if it does not pay
  const auto consider = [&](RedistributionOption one, std::span<const RelativePilot::Above> above) {
    spread(above, static_cast<double>(pilot.samples()), one);
    if (asked || one.effort() < option.effort()) option = one;
    asked = false;
  };
  const bool free = !(settings.threshold > 0.0);
  const double first = free ? 1.0 : settings.threshold, last = free ? 64.0 : first;
  for (double threshold = first; threshold <= last && settings.mutations != 0.0; threshold *= 2.0) {
    const std::vector<RelativePilot::Above> above = pilot.above(threshold);
    if (above.empty()) break;
    const RelativePilot::Variances v = pilot.variances(threshold, 1.0);
    RedistributionOption one = option;
    one.threshold = threshold;
    one.excess = v.excess;
    for (const Spread& s : spreads) {
      one.length = settings.length > 0 ? settings.length : s.length;
      for (double mutations = 1.0 / 16.0; mutations <= 1.0; mutations *= 2.0) {
        one.mutations = settings.mutations > 0.0 ? settings.mutations : mutations;
        one.variance = v.below;
        consider(one, above);
      }
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
  ExcessPilots found = run_excess_pilots(context, seed, settings.pilot_samples);
  RedistributionPlan plan;
  plan.mean = std::move(found.mean);
  for (size_t i = 0; i < found.pilots.size(); ++i) {
    const Pilot& pilot = found.pilots[i];
    const RelativePilot relative(pilot, plan.mean);
    RedistributionOption o;
    o.integrator = context.integrator.alternative_name(static_cast<int>(i));
    o.light = {relative.light(), relative.light_error()};
    o.rays = pilot.rays() / static_cast<double>(std::max<size_t>(1, pilot.samples()));
    choose_redistribution(relative, settings, o);
    plan.options.push_back(o);
  }
  plan.chosen = best_option(plan.options);
  context.integrator.choose(static_cast<int>(plan.chosen));
  plan.samples = found.pilots[plan.chosen].samples();
  plan.finds = found.pilots[plan.chosen].finds();
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
