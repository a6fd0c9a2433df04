// What a render says of its error when hardly any bootstrap sample found light.
#include <nlohmann/json.hpp>

#include "app/stress/catalogue/probes.h"
#include "app/stress/catalogue/scenes.h"
#include "app/stress/picture.h"
#include "app/stress/technique.h"
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

}  // namespace pssmlt::stress
