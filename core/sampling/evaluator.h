// Calls an integrator and keeps bad samples away from films, chain states and acceptance ratios.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/integrator.h"

namespace pssmlt {

// Why a sample was dropped.
enum class Rejection : uint8_t { nan, infinite, negative, too_large, threw, no_raster };
inline constexpr int rejection_count = 6;
std::string_view to_string(Rejection cause);

// What replays a dropped sample bit for bit.
struct ReplayKey {
  std::string text;  // "sobol:seed:pixel:index" or "u:" + hex numbers
  Rejection cause;
  dvec2 raster{0.0};
};

// Counters shared by all threads of a render; bumped rarely (only on rejection).
class RejectionLog {
 public:
  // `plugin`: what spoilt the sample, as far as is known.
  void count(Rejection cause, const std::string& key, const dvec2& raster,
             const std::string& plugin);
  uint64_t total() const;
  uint64_t of(Rejection cause) const { return counts_[static_cast<size_t>(cause)]; }
  // True while keys are still kept; after that only the counts go on.
  bool wants_examples() const;
  // True until so many culprits have been looked for that looking for more would cost time.
  bool wants_culprits() const { return total() < most_culprits; }
  // How many samples each plugin has spoilt, by cause.
  using Culprits = std::map<std::pair<std::string, Rejection>, uint64_t>;
  Culprits culprits() const;
  // The first few keys, for the summary.
  std::vector<ReplayKey> examples() const;

 private:
  static constexpr uint64_t most_culprits = 10'000;
  std::array<std::atomic<uint64_t>, rejection_count> counts_{};
  mutable std::mutex mutex_;
  Culprits culprits_;
  std::vector<ReplayKey> examples_;
};

class Evaluator {
 public:
  // radiance_scale: see BuiltScene; what is too large is measured by it.
  Evaluator(const Integrator& integrator, RejectionLog& log, double radiance_scale = 1.0);
  // f(u) into `out` (cleared first). False if the sample was dropped: `out` is then empty and the
  // cause counted with what describes u. Values above 2^40 are too large, or above 2^40 radiance
  // scales if that is more; those above 2^60 scales always.
  bool evaluate(PrimarySample& u, Splats& out, Workspace& workspace);
  // How a memoryless sampler names the sample about to be evaluated (cheap: stored, not formatted,
  // until needed). Chains leave it unset: u itself is printed.
  void name_sample(const char* sampler, uint64_t seed, int64_t pixel, int64_t index);
  uint64_t samples() const { return samples_; }

 private:
  bool check(PrimarySample& u, Splats& out);
  void drop(Rejection cause, PrimarySample& u, Splats& out);
  // Evaluates u once more to find out what spoils it; the integrator if nothing else does.
  std::string culprit(PrimarySample& u, Splats& out) const;
  const Integrator& integrator_;
  RejectionLog& log_;
  float largest_value_;
  const char* sampler_ = nullptr;
  uint64_t seed_ = 0;
  int64_t pixel_ = -1, index_ = -1;
  uint64_t samples_ = 0;
};

}  // namespace pssmlt
