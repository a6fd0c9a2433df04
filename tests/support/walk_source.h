// Numbers for materials that walk, without a sampler: fresh at every call.
#pragma once

#include "core/sampling/primary_sample_owner.h"
#include "tests/support/toy.h"

namespace pssmlt::test {

class WalkSource final : public NumberSource {
 public:
  explicit WalkSource(uint64_t seed) : random_(seed, RandomUse::test), owner_(box_map(1, 1)) {}

  void fill(Stream, uint32_t, NumberBlock& block) override {
    for (uint32_t& x : block) x = random_.bits();
  }
  MaterialNumbers next() {
    owner_.begin(*this);
    MaterialNumbers m;
    m.first = random_.next();
    m.second = random_.next();
    m.sample = &owner_.sample();
    m.walk = 1;
    return m;
  }

 private:
  RandomStream random_;
  PrimarySampleOwner owner_;
};

}  // namespace pssmlt::test
