#include "core/base/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

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

}  // namespace

void set_log_level(LogLevel level) {
  logger().set_level(level == LogLevel::quiet     ? spdlog::level::warn
                     : level == LogLevel::verbose ? spdlog::level::debug
                                                  : spdlog::level::info);
}

void log_debug(const std::string& message) { logger().debug(message); }
void log_info(const std::string& message) { logger().info(message); }
void log_warning(const std::string& message) { logger().warn("warning: " + message); }

}  // namespace pssmlt
