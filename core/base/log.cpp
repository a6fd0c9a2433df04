#include "core/base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <utility>

namespace pssmlt {
namespace {

// Standard error: standard output belongs to what a command prints.
spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> made = [] {
    auto l = std::make_shared<spdlog::logger>(
        "pssmlt", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    l->set_pattern("%^%v%$");
    l->flush_on(spdlog::level::debug);
    return l;
  }();
  return *made;
}

std::mutex printing;  // and of what stands below
std::function<void(const std::function<void()>&)> around;

bool capturing = false;
std::vector<std::string> captured;

void log(spdlog::level::level_enum level, const std::string& message) {
  const std::lock_guard lock(printing);
  if (capturing) return captured.push_back(message);
  if (!logger().should_log(level)) return;
  const auto print = [&] { logger().log(level, message); };
  if (around) {
    around(print);
  } else {
    print();
  }
}

}  // namespace

void print_log_by(std::function<void(const std::function<void()>& print)> printer) {
  const std::lock_guard lock(printing);
  around = std::move(printer);
}

void set_log_level(LogLevel level) {
  logger().set_level(level == LogLevel::quiet     ? spdlog::level::warn
                     : level == LogLevel::verbose ? spdlog::level::debug
                                                  : spdlog::level::info);
}

LogCapture::LogCapture() {
  const std::lock_guard lock(printing);
  capturing = true;
  captured.clear();
}
LogCapture::~LogCapture() {
  const std::lock_guard lock(printing);
  capturing = false;
}
std::vector<std::string> LogCapture::lines() const {
  const std::lock_guard lock(printing);
  return captured;
}

void log_debug(const std::string& message) { log(spdlog::level::debug, message); }
void log_info(const std::string& message) { log(spdlog::level::info, message); }
void log_warning(const std::string& message) { log(spdlog::level::warn, "warning: " + message); }

}  // namespace pssmlt
