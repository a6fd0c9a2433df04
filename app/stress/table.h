// What a run found, for the terminal, for scripts and for the page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/stress/runner.h"

namespace pssmlt::stress {

struct Totals {
  size_t pass = 0, fail = 0, cannot_see = 0, undecided = 0, not_run = 0;
};
Totals count(const std::vector<Entry>& entries);
// 0: everything passed or cannot be seen; 1: something failed; 3: something is undecided or was
// not run.
int exit_code(const Totals& totals);

// One line a case and value with how many pairs passed and the worst of them, then what failed,
// what is undecided, what was not run.
std::string terminal_table(const Cases& cases, const std::vector<Entry>& entries);
// What `results.json` and the page hold; docs/stress.md has the schema.
nlohmann::json result_data(const Cases& cases, const std::vector<Entry>& entries,
                           const std::string& command, double seconds);

}  // namespace pssmlt::stress
