#include "app/signals.h"

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace pssmlt {
namespace {

std::atomic<bool> requested{false};
const char* text = "";

extern "C" void on_signal(int) {
  if (requested.exchange(true)) _exit(exit_interrupted);
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

}  // namespace

std::atomic<bool>& stop_requested() { return requested; }

void catch_signals(const char* message) {
  text = message;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace pssmlt
