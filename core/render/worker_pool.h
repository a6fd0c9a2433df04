// Threads that run the units of a round.
#pragma once

#include <functional>
#include <memory>

namespace pssmlt {

class WorkerPool {
 public:
  // threads: 0 is one per logical processor.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  int threads() const { return threads_; }
  // Runs body(unit, slot) for unit in [0, count) on the pool's threads, the caller's included, and
  // returns when all are done. slot in [0, threads) is the thread's own while a unit runs. Units
  // run with denormals flushed to zero.
  void run(int count, const std::function<void(int unit, int slot)>& body);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  int threads_;
};

}  // namespace pssmlt
