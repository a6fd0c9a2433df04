// What the user asks `pssmlt compare` for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/compare/scene_job.h"
#include "app/live/live_options.h"

namespace pssmlt::compare {

struct CompareOptions {
  std::vector<SceneRequest> scenes;
  std::vector<Technique> techniques;            // the first is what others are compared with
  std::vector<Technique> reference_techniques;  // two
  double seconds = 60.0;                        // of every technique in every run [s]
  double reference_seconds = 0.0;               // of both reference techniques together [s]
  int runs = 4, snapshots = 12;
  double slice = 0.25;  // [s]
  int threads = 0;      // 0: all processors
  uint64_t seed = 0;    // of the first run; the others' follow
  std::string output;   // the report's folder
  bool resume = false, quiet = false, verbose = false;
  LiveOptions page;                // that follows it
  std::vector<std::string> notes;  // for the log
  std::string command;             // repeats the comparison, quoted for a shell
};

// A reference gets so many times --time unless told otherwise: even if only one of its two
// techniques is any good, and no better than what is compared, its own error is then a fifth of the
// others' at the end, below the quarter that counts as near the floor.
inline constexpr double reference_factor = 10.0;

// Throws Error on bad usage. nullopt: help was printed.
std::optional<CompareOptions> parse_compare_options(const Arguments& arguments);

}  // namespace pssmlt::compare
