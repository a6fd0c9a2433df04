// What renders by chains say of themselves where chains do badly.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/defaults.h"
#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"
#include "app/stress/picture.h"
#include "app/stress/technique.h"
#include "core/base/log.h"
#include "core/render/error_estimate.h"

namespace pssmlt::stress {

Outcome few_contributing(const ProbeContext& context, double radius) {
  Outcome outcome;
  if (!has_parameter("sampler", context.pair.sampler, "bootstrapsamples")) {
    outcome.verdict = Verdict::cannot_see;
    outcome.reason = context.pair.sampler + " has no bootstrap";
    return outcome;
  }
  const std::string scene =
      plane_view(16, 1.0, 1.0) +
      fmt::format(
          "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]\nShape \"disk\" \"float "
          "radius\" {}\n",
          radius);
  Job job{.scene = scene,
          .pair = context.pair,
          .set = small_settings(context.pair),
          .threads = context.threads};
  const LogCapture capture;
  const BuiltScene built = build_job(job, nullptr);
  RenderSettings settings;
  settings.spp = 64;
  settings.threads = context.threads;
  const RenderResult result = render(built, settings);
  const nlohmann::json& report = result.statistics["layers"][0]["report"];
  const auto contributing = report["bootstrap_contributing"].get<uint64_t>();
  const bool few = contributing < static_cast<uint64_t>(least_bootstrap);
  const bool fine = !few || !result.error.known;
  outcome.verdict = fine ? Verdict::pass : Verdict::fail;
  outcome.reason = fmt::format("{} of {} bootstrap samples contribute; the error is {}",
                               contributing, report["bootstrap_samples"].get<uint64_t>(),
                               result.error.known ? "known" : "unknown: " + result.error.why);
  return outcome;
}

Outcome no_large_steps(const ProbeContext& context) {
  Outcome outcome;
  const auto has = [&](const char* name) {
    return has_parameter("sampler", context.pair.sampler, name);
  };
  if (!has("largestepprobability") || !has("bootstrapsamples")) {
    outcome.verdict = Verdict::cannot_see;
    outcome.reason =
        context.pair.sampler +
        (has("largestepprobability") ? " starts chains anew all the time" : " has no large steps");
    return outcome;
  }
  Job job{.scene = lab({.height = 32}),  // four blocks, the fewest that regions are told of
          .pair = {default_plugins().integrator, context.pair.sampler},
          .threads = context.threads};
  job.set = small_settings(job.pair);
  job.set.push_back("sampler.largestepprobability=0");
  Picture picture(job);
  picture.add(64);
  const nlohmann::json layer = picture.layer();
  const bool warned = std::ranges::any_of(picture.log(), [](const std::string& line) {
    return line.starts_with("warning") && line.find("largestepprobability") != std::string::npos;
  });
  const bool told = layer.contains("efficiency");
  outcome.verdict = warned && told ? Verdict::pass : Verdict::fail;
  outcome.reason = !warned ? "no warning" : !told ? "no report of how chains differ" : "";
  if (told) {
    const nlohmann::json& ratio = layer["efficiency"]["between_over_within"];
    outcome.reason = fmt::format("between-chain over within-chain variance {:.3g}, at worst {:.3g}",
                                 ratio["median"].get<double>(), ratio["worst"].get<double>());
  }
  return outcome;
}

}  // namespace pssmlt::stress
