#include "core/excess/excess_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/excess/chain_trial.h"
#include "core/excess/excess_limit.h"
#include "core/excess/pilot.h"

namespace pssmlt {
namespace {

// Fewer pilot samples above a limit than this, and it is not considered.
constexpr uint64_t least_above = 32;
// Fewer are not worth their chains [of all samples].
constexpr double least_share = 1e-3;
int candidates_for(const ExcessPlanSettings& settings, const Pilot& pilot) {
  if (settings.candidates > 0) return settings.candidates;
  return static_cast<int>(std::max<size_t>(pilot.samples() / 2, 8192));
}

// Pilot samples above the limit that promise `least_above` candidates of the chains' own.
uint64_t least_contributing(const ExcessPlanSettings& settings, const Pilot& pilot) {
  const double times = static_cast<double>(pilot.samples()) / candidates_for(settings, pilot);
  return static_cast<uint64_t>(static_cast<double>(least_above) * std::max(1.0, times));
}

// Splits by what is known of the chains' stickiness, tries chains at that limit, and splits again.
class Splitter {
 public:
  Splitter(const SamplerContext& context, uint64_t seed, const ExcessPlanSettings& settings,
           const Pilot& pilot, const LocalMean& mean)
      : context_(context),
        seed_(seed),
        settings_(settings),
        relative_(pilot, mean),
        mean_(mean),
        candidates_(candidates_for(settings, pilot)),
        least_(least_contributing(settings, pilot)) {}
  const RelativePilot& relative() const { return relative_; }

  void run(ExcessPlan& plan) {
    const bool decided = settings_.threshold > 0.0 && settings_.share > 0.0;
    const bool given = settings_.stickiness > 0.0 || decided;
    plan.stickiness = settings_.stickiness > 0.0 ? settings_.stickiness : guess;
    plan.split = split(plan.stickiness);
    for (int trial = 0; !given && trial < most_trials; ++trial) {
      const double before = plan.split.threshold;
      if (!std::isfinite(before)) return;
      const double model = plan.split.variances.above / plan.stickiness;
      const double measured = measure(before);
      if (!(measured > 0.0) || !(model > 0.0)) return;
      plan.stickiness = std::clamp(measured / model, 1.0, most_stickiness);
      plan.split = split(plan.stickiness);
      if (std::abs(std::log2(plan.split.threshold / before)) <= 1.0) return;
    }
  }

 private:
  static constexpr double guess = 16.0, most_stickiness = 1e6;
  static constexpr int most_trials = 2;
  ExcessSplit split(double stickiness) const {
    return settings_.threshold > 0.0 ? split_at(relative_, settings_.threshold, stickiness)
                                     : choose_split(relative_, stickiness, least_);
  }
  double measure(double threshold) const {
    const ExcessLimit limit{&mean_, threshold};
    const AboveLimit target(limit);
    return trial_variance(context_, seed_, settings_.chains, target, mean_, candidates_);
  }
  const SamplerContext& context_;
  uint64_t seed_;
  const ExcessPlanSettings& settings_;
  RelativePilot relative_;
  const LocalMean& mean_;
  int candidates_;
  uint64_t least_;
};

}  // namespace

ExcessPlan plan_excess(const SamplerContext& context, uint64_t seed,
                       const ExcessPlanSettings& settings) {
  ExcessPilots found = run_excess_pilots(context, seed, settings.pilot_samples);
  const Pilot& pilot = found.deep.back().pilot;
  ExcessPlan plan;
  plan.mean = std::move(found.mean);
  Splitter splitter(context, mix_bits(seed + 1), settings, pilot, plan.mean);
  plan.light = splitter.relative().light();
  plan.plain = splitter.relative().variances(static_cast<double>(infinity), 1.0).below;
  plan.pilots = pilot.samples();
  plan.finds = pilot.finds();
  plan.candidates = candidates_for(settings, pilot);
  splitter.run(plan);
  if (settings.share > 0.0) plan.split.chain_share = settings.share;
  plan.worth_chains = std::isfinite(plan.split.threshold) &&
                      plan.split.chain_share >= least_share &&
                      plan.split.variances.contributing >= least_contributing(settings, pilot);
  return plan;
}

std::string to_string(const ExcessPlan& p) {
  const std::string text =
      fmt::format("light {:.4g} local means, variance of a sample {:.3g}", p.light, p.plain);
  if (!std::isfinite(p.split.threshold)) return text + "; without chains";
  const RelativePilot::Variances& v = p.split.variances;
  return text + fmt::format(
                    "; {:.3g} with chains above {:.3g} local means ({:.3g} below, {:.3g} of chains "
                    "of which {:.3g} mutations are worth a sample)",
                    v.total(), p.split.threshold, v.below, v.above, p.stickiness);
}

}  // namespace pssmlt
