// The log: spdlog behind three functions, so that few files pay for its headers.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pssmlt {

enum class LogLevel { quiet, normal, verbose };
void set_log_level(LogLevel level);
// Details, shown with --verbose only.
void log_debug(const std::string& message);
// One line that every user should see.
void log_info(const std::string& message);
// Something that may spoil the picture.
void log_warning(const std::string& message);
// For what else stands on the terminal: every line that is shown is printed by around(print), on
// the thread that logs, one at a time; around must not log. Empty: no longer.
void print_log_by(std::function<void(const std::function<void()>& print)> around);

// While it lives, every line, details too, is kept here instead of being printed. One at a time.
class LogCapture {
 public:
  LogCapture();
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;
  // Warnings begin with "warning: ".
  std::vector<std::string> lines() const;
};

}  // namespace pssmlt
