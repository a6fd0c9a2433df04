// Tells the thread sanitizer of orderings that libraries without its instrumentation give (oneTBB,
// Embree): what a thread did before happens_before(key) is seen by those that pass
// happens_after(key) later. Nothing in other builds.
#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define PSSMLT_THREAD_SANITIZER 1
#endif
#elif defined(__SANITIZE_THREAD__)
#define PSSMLT_THREAD_SANITIZER 1
#endif

#ifdef PSSMLT_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace pssmlt {

inline void happens_before([[maybe_unused]] const void* key) {
#ifdef PSSMLT_THREAD_SANITIZER
  __tsan_release(const_cast<void*>(key));
#endif
}
inline void happens_after([[maybe_unused]] const void* key) {
#ifdef PSSMLT_THREAD_SANITIZER
  __tsan_acquire(const_cast<void*>(key));
#endif
}

}  // namespace pssmlt
