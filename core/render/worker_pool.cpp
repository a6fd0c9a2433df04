#include "core/render/worker_pool.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <thread>
#include <vector>

#include "core/base/float_traps.h"
#include "core/base/thread_order.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace pssmlt {
namespace {

// Flushes denormals (FTZ and DAZ) while alive, so that every unit computes the same numbers on
// whichever thread it runs.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }
  ~FlushDenormals() { _mm_setcsr(before_); }
#elif defined(__aarch64__)
  FlushDenormals() {
    asm volatile("mrs %0, fpcr" : "=r"(before_));
    asm volatile("msr fpcr, %0" : : "r"(before_ | (1ull << 24)));
  }
  ~FlushDenormals() { asm volatile("msr fpcr, %0" : : "r"(before_)); }
#else
  FlushDenormals() : before_(0) {}
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__aarch64__)
  uint64_t before_ = 0;
#else
  unsigned before_;
#endif
};

int processors() {
  const unsigned n = std::thread::hardware_concurrency();
  return n == 0 ? 1 : static_cast<int>(n);
}

}  // namespace

struct WorkerPool::Impl {
  explicit Impl(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads)),
        arena(threads) {}
  tbb::global_control limit;
  tbb::task_arena arena;
};

WorkerPool::WorkerPool(int threads) : threads_(threads > 0 ? threads : processors()) {
  impl_ = std::make_unique<Impl>(threads_);
}

WorkerPool::~WorkerPool() = default;

#ifdef PSSMLT_THREAD_SANITIZER
// The sanitizer can't see how oneTBB orders its tasks; it checks the units on threads that it can.
void WorkerPool::run(int count, const std::function<void(int, int)>& body) {
  std::atomic<int> next{0};
  std::vector<std::jthread> threads;
  for (int slot = 0; slot < threads_; ++slot) {
    threads.emplace_back([&, slot] {
      const FlushDenormals flush;
      for (int unit = next++; unit < count; unit = next++) body(unit, slot);
    });
  }
}
#else
void WorkerPool::run(int count, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  impl_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, count, 1),
        [&](const tbb::blocked_range<int>& range) {
          const FlushDenormals flush;
          const FloatTraps traps;
          const int slot = tbb::this_task_arena::current_thread_index();
          for (int unit = range.begin(); unit != range.end(); ++unit) body(unit, slot);
        },
        tbb::simple_partitioner());
  });
}
#endif

}  // namespace pssmlt
