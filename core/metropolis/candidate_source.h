// The numbers of the bootstrap's candidates.
#pragma once

#include "core/sampling/primary_sample.h"

namespace pssmlt {

// Independent uniform numbers of candidate `index`: not stored, but made again from the index when
// a chain starts there.
class CandidateSource final : public NumberSource {
 public:
  CandidateSource(uint64_t seed, uint32_t index) : seed_(seed), index_(index) {}
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    streams_ |= 1u << static_cast<unsigned>(stream);
    const uint32_t what = index << 2 | static_cast<uint32_t>(stream);
    block = philox(seed_, {what, 0, index_, static_cast<uint32_t>(RandomUse::bootstrap)});
  }
  // Streams that were read, bit = Stream.
  unsigned streams() const { return streams_; }

 private:
  uint64_t seed_;
  uint32_t index_;
  unsigned streams_ = 0;
};

}  // namespace pssmlt
