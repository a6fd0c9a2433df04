// Per-thread scratch memory of an integrator, so that sample() allocates nothing.
#pragma once

#include <memory>

namespace pssmlt {

class Workspace {
 public:
  // The integrator's own scratch object, made on this thread's first use and kept. One workspace
  // serves one integrator, so T is always the same for it.
  template <typename T>
  T& scratch() {
    if (!memory_) memory_ = std::make_shared<T>();
    return *static_cast<T*>(memory_.get());
  }

 private:
  std::shared_ptr<void> memory_;
};

}  // namespace pssmlt
