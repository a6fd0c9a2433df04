// Subpaths that outlive the evaluation that made them.
#pragma once

#include <array>

#include "core/path/subpath.h"

namespace pssmlt {

// Subpaths of the last evaluations, by the identity of the numbers they were made from: a Markov
// chain that changes one end keeps the other's subpath. Of the two, the current state's stays.
class SubpathCache {
 public:
  // The subpath to use for `version`; `fresh` says that it has to be made.
  Subpath& find(StreamVersion version, bool& fresh) {
    for (Slot& slot : slots_) {
      if (slot.version == version.now) {
        fresh = false;
        return slot.path;
      }
    }
    fresh = true;
    Slot& slot = slots_[0].version == version.keep ? slots_[1] : slots_[0];
    slot.version = version.now;
    return slot.path;
  }
  void reserve(int vertices) {
    for (Slot& slot : slots_) slot.path.reserve(vertices);
  }

 private:
  struct Slot {
    uint64_t version = ~uint64_t{0};
    Subpath path;
  };
  std::array<Slot, 2> slots_;
};

}  // namespace pssmlt
