// Techniques take turns (A B C A B C ...) in slices of wall time, so that a machine whose speed
// drifts hurts all alike.
#pragma once

#include <functional>
#include <span>

namespace pssmlt::compare {

// A technique that renders, as the interleaver sees it.
class Racer {
 public:
  virtual ~Racer() = default;
  // Wall time that this racer alone has used and that counts [s].
  virtual double elapsed() const = 0;
  // The smallest piece of work; the first one prepares.
  virtual void round() = 0;
};

struct Slices {
  double seconds = 60.0;  // until every racer's clock has reached this
  double slice = 0.25;    // [s]
};

// In slice k = 1, 2, ... each racer in turn works until its own clock reaches k * slice (the last:
// `seconds`), at least; one whose rounds are longer than a slice skips turns until the others have
// caught up. after_slice() is called when all have had their turn. Ends early, false, as soon as
// stopped() is true after a round.
bool interleave(std::span<Racer* const> racers, const Slices& slices,
                const std::function<bool()>& stopped, const std::function<void()>& after_slice);

// Order of `count` racers in a run: 0 1 2, 1 2 0, 2 0 1, ...: who comes first changes.
inline int rotated(int position, int run, int count) { return (position + run) % count; }

}  // namespace pssmlt::compare
