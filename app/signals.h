// SIGINT and SIGTERM as a request to end in good order.
#pragma once

#include <atomic>

namespace pssmlt {

inline constexpr int exit_interrupted = 130;

// Becomes true with the first signal after catch_signals().
std::atomic<bool>& stop_requested();
// The first signal prints `message` (static) and asks to stop, the second ends the process.
void catch_signals(const char* message);

}  // namespace pssmlt
