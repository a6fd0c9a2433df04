#include "app/compare/interleave.h"

#include <algorithm>
#include <cstdint>

namespace pssmlt::compare {

bool interleave(std::span<Racer* const> racers, const Slices& slices,
                const std::function<bool()>& stopped, const std::function<void()>& after_slice) {
  double slowest = 0.0;
  for (int64_t k = 1; slowest < slices.seconds; ++k) {
    const double until = std::min(static_cast<double>(k) * slices.slice, slices.seconds);
    slowest = slices.seconds;
    for (Racer* const racer : racers) {
      while (racer->elapsed() < until) {
        racer->round();
        if (stopped()) return false;
      }
      slowest = std::min(slowest, racer->elapsed());
    }
    after_slice();
  }
  return true;
}

}  // namespace pssmlt::compare
