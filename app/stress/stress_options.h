// The command line of `pssmlt stress`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/stress/runner.h"

namespace pssmlt::stress {

struct StressOptions {
  Cases cases;  // those chosen
  RunnerOptions runner;
  std::string output = "stress";  // folder
  bool list = false, quiet = false;
  std::string command;             // as it was called
  std::vector<std::string> notes;  // for the log
};

// The cases of `all` that `names` chooses: exact names, groups by number ("4"), or all if empty.
// Throws Error, with a suggestion.
Cases chosen_cases(const Cases& all, const std::vector<std::string>& names);

// Throws Error on bad usage. nullopt: help was printed.
std::optional<StressOptions> parse_stress_options(const Arguments& arguments);

}  // namespace pssmlt::stress
