// When pictures of a run are taken: geometrically spaced times, equal distances in log time.
#pragma once

#include <optional>
#include <vector>

namespace pssmlt::compare {

inline constexpr int least_snapshots = 12;
// The first time is this part of the budget, unless a technique's first round ends later.
inline constexpr double first_snapshot = 1.0 / 64.0;
// Room for later runs, whose first round may take longer than the first run's.
inline constexpr double first_round_margin = 1.25;

// `count` times from max(first_snapshot * seconds, first_round_margin * first_round) to `seconds`,
// ascending [s]; `seconds` alone if the former is not smaller.
std::vector<double> snapshot_times(double seconds, int count, double first_round);

// Which of the times is due; each once.
class SnapshotClock {
 public:
  explicit SnapshotClock(std::vector<double> times) : times_(std::move(times)) {}
  // The last time that has come and was not asked about before: rounds may skip some.
  std::optional<double> due(double elapsed);
  bool last_taken() const { return next_ == times_.size(); }
  const std::vector<double>& times() const { return times_; }

 private:
  std::vector<double> times_;
  size_t next_ = 0;
};

}  // namespace pssmlt::compare
