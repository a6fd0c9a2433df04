// The one entry to rendering, for the command, tests and tools: rounds of work units of every layer
// until a budget is spent, with checkpoints, snapshots and an error estimate.
#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/render/develop.h"
#include "core/render/efficiency.h"
#include "core/render/error_estimate.h"
#include "core/scene/builder.h"

namespace pssmlt {

// The film is a function of scene, seed and the number of rounds alone. Budgets choose after which
// round to stop, whichever is reached first; with none given, the samplers' default numbers of
// samples are made. A resumed render counts what was done before toward its budgets.
struct RenderSettings {
  std::optional<double> spp;           // samples or mutations per pixel, of every layer
  std::optional<double> seconds;       // wall time of preparation and rounds [s]
  std::optional<double> target_error;  // stop when relMSE's 95 % interval is below
  int threads = 0;                     // 0: one per logical processor
  uint64_t seed = 0;
  bool per_length = false;               // also one image per number of bounces
  bool per_strategy = false;             // also one image per (s, t)
  std::string checkpoint;                // file; "": none
  double checkpoint_seconds = 60.0;      // between checkpoints [s]
  bool resume = false;                   // from the checkpoint, if the file exists
  std::vector<double> snapshot_seconds;  // ascending; the first round's end after each calls back
};

enum class RenderPhase : uint8_t { prepare, bootstrap, render };

struct Progress {
  RenderPhase phase = RenderPhase::prepare;
  double fraction = 0.0;    // of the budget, the largest of those given
  double elapsed = 0.0;     // [s]
  double remaining = -1.0;  // estimated [s]; -1: not known
  double samples = 0.0, samples_per_second = 0.0;
  bool chains = false;                   // samples are mutations
  const ErrorEstimate* error = nullptr;  // the last one made, null before
};

enum class StopReason : uint8_t { samples, time, error, interrupted };
std::string_view to_string(StopReason reason);

struct RenderResult {
  Image image;
  Image half[2], variance;  // empty where the rounds so far do not give them
  std::vector<SplitImage> splits;
  ErrorEstimate error;
  StopReason stop = StopReason::samples;
  bool complete = false;        // every layer has a round: image is meaningful
  double seconds = 0.0;         // preparation and rounds, earlier runs included [s]
  double samples = 0.0;         // of all layers
  std::vector<int64_t> rounds;  // per layer
  std::vector<std::optional<ChainEfficiency>> efficiency;  // per layer, of chains
  std::vector<std::string> warnings;  // what the summary must say about this picture
  nlohmann::json statistics;
};

// What somebody who watches is shown between two rounds.
struct Preview {
  Image image;
  double seconds = 0.0;   // as in RenderResult
  double samples = 0.0;   // of all layers
  nlohmann::json layers;  // "layers" of the statistics
};

struct RenderCallbacks {
  // Called on the thread that called render(), at most ten times a second.
  std::function<void(const Progress&)> progress;
  std::function<void(const RenderResult&)> snapshot;
  // Both or neither, on the same thread, between rounds: whether anybody would look at a preview
  // now, and the preview. It comes so seldom that previews cost about a hundredth of the time.
  std::function<bool()> wants_preview;
  std::function<void(Preview)> preview;
  // When it becomes true (signal handlers), the round is finished and the result returned.
  const std::atomic<bool>* stop = nullptr;
};

// Throws Error (settings that do not fit, a checkpoint that is refused) before rendering starts. A
// checkpoint that cannot be written is a warning in the log.
RenderResult render(const BuiltScene& scene, const RenderSettings& settings,
                    const RenderCallbacks& callbacks = {});

}  // namespace pssmlt
