// Wall time that can be held: what happens meanwhile does not count.
#pragma once

#include <chrono>

namespace pssmlt {

class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;
  // Runs from the start.
  Stopwatch() : since_(Clock::now()) {}
  // Counted so far [s].
  double seconds() const {
    return before_ + (running_ ? std::chrono::duration<double>(Clock::now() - since_).count() : 0);
  }
  void hold() {
    before_ = seconds();
    running_ = false;
  }
  void go_on() {
    if (!running_) since_ = Clock::now();
    running_ = true;
  }

 private:
  Clock::time_point since_;
  double before_ = 0.0;
  bool running_ = true;
};

}  // namespace pssmlt
