// Which numbers a mutation changes. The choice never depends on the chain's state, so that every
// kind of step is symmetric by itself and so is their mixture.
#pragma once

#include <array>
#include <string_view>

#include "core/sampling/primary_sample.h"

namespace pssmlt {

enum class StepKind : uint8_t {
  large,   // all numbers drawn anew
  all,     // all numbers moved a little
  film,    // the raster pair alone
  camera,  // one stream
  light,
  connection,
  shared,
  range,    // some vertices, in all streams
  ensemble  // all numbers, by the difference of two other chains' states
};
inline constexpr int step_kinds = 9;
std::string_view to_string(StepKind kind);

struct Step {
  StepKind kind = StepKind::large;
  unsigned streams = 0;  // bit = Stream
  // Blocks [first, end) of those streams move, the others stay.
  uint32_t first = 0, end = ~0u;
  bool changes(Stream stream) const { return (streams >> static_cast<unsigned>(stream) & 1u) != 0; }
};

// Probabilities of the kinds; "all" gets what is left over.
struct StepMix {
  double large = 0.3;     // of all steps
  double film = 0.0;      // of the small steps
  double stream = 0.0;    // of the small steps, shared evenly by the streams in use
  double range = 0.0;     // of the small steps
  double ensemble = 0.0;  // of the small steps
};

// Chooses steps; made once the streams that the target reads at all are known, so that no step is
// wasted on numbers nobody looks at.
class StepChooser {
 public:
  // streams: bit = Stream, those that are read; raster: whether the raster pair is.
  StepChooser(const StepMix& mix, unsigned streams, bool raster);
  // Two random words decide.
  Step choose(uint32_t kind_bits, uint32_t range_bits) const;
  // Of the small steps alone; "all" if there are none.
  Step choose_small(uint32_t kind_bits, uint32_t range_bits) const;

 private:
  static Step make(StepKind kind, uint32_t range_bits);
  // Upper ends of the kinds' intervals of a 32-bit number.
  std::array<uint64_t, step_kinds> ends_{};
};

}  // namespace pssmlt
