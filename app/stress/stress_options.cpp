#include "app/stress/stress_options.h"

#include <algorithm>

#include "app/compare/text.h"
#include "app/parse_arguments.h"
#include "app/render_options.h"
#include "app/stress/technique.h"
#include "core/scene/suggest.h"

namespace pssmlt::stress {

Cases chosen_cases(const Cases& all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<std::string> known;
  for (const Case& c : all) known.push_back(c.name);
  for (const std::string& name : names) {
    const bool found = std::ranges::any_of(
        all, [&](const Case& c) { return c.name == name || std::to_string(c.group) == name; });
    if (found) continue;
    throw Error("there is no case \"" + name + "\"" + suggestion(name, known) +
                "; --list prints all");
  }
  Cases chosen;
  for (const Case& c : all) {
    const auto wanted = [&](const std::string& name) {
      return c.name == name || std::to_string(c.group) == name;
    };
    if (std::ranges::any_of(names, wanted)) chosen.push_back(c);
  }
  return chosen;
}

std::optional<StressOptions> parse_stress_options(const Arguments& arguments) {
  CLI::App app(
      "Runs extreme scenes whose pictures are known with every integrator under every sampler.\n"
      "docs/stress.md says what is tested and how it is decided.",
      "pssmlt stress");
  StressOptions o;
  std::vector<std::string> names;
  std::string integrators = "all", samplers = "all", time = "10m";
  app.add_option("--case", names, "case or number of a group; may be repeated (all)")
      ->allow_extra_args(false);
  app.add_option("--integrators", integrators, "names separated by commas (all)");
  app.add_option("--samplers", samplers, "names separated by commas (all)");
  app.add_option("--time", time,
                 "wall time, spent on the extremes first (10m); what has to run at least runs "
                 "even if it takes longer");
  app.add_option("-o,--output", o.output, "folder of the results (stress)");
  app.add_option("--threads", o.runner.threads, "threads (all processors)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--seed", o.runner.seed, "seed (1)")->check(CLI::NonNegativeNumber);
  app.add_flag("--list", o.list, "print the cases and what they test");
  app.add_flag("--quiet", o.quiet, "no progress, no table");
  if (!parse_arguments(app, arguments)) return std::nullopt;
  o.cases = chosen_cases(catalogue(), names);
  o.runner.integrators = chosen_plugins("integrator", integrators);
  o.runner.samplers = chosen_plugins("sampler", samplers);
  o.runner.seconds = parse_duration(time, o.notes);
  o.command = "pssmlt stress";
  for (const std::string& a : arguments) o.command += " " + a;
  return o;
}

}  // namespace pssmlt::stress
