#include "app/compare/snapshot_times.h"

#include <algorithm>
#include <cmath>

namespace pssmlt::compare {

std::vector<double> snapshot_times(double seconds, int count, double first_round) {
  const double first = std::max(first_snapshot * seconds, first_round_margin * first_round);
  if (first >= seconds || count < 2) return {seconds};
  std::vector<double> times;
  for (int k = 0; k + 1 < count; ++k) {
    times.push_back(seconds * std::pow(first / seconds, 1.0 - k / (count - 1.0)));
  }
  times.push_back(seconds);
  return times;
}

std::optional<double> SnapshotClock::due(double elapsed) {
  std::optional<double> found;
  while (next_ < times_.size() && times_[next_] <= elapsed) found = times_[next_++];
  return found;
}

}  // namespace pssmlt::compare
