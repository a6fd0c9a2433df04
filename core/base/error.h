// Errors that happen before rendering starts: a message with the place in the input that caused it.
// Nothing throws while a render runs; bad samples are counted instead (core/render/statistics.h).
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pssmlt {

// A place in a text file; line and column count from 1, 0 means "not known".
struct Location {
  std::shared_ptr<const std::string> file;  // null: no file (command line, generated)
  uint32_t line = 0;
  uint32_t column = 0;
};

// Bad input or usage: the program prints what() (already "file:line:column: message", the line and
// a caret where the location is known) and exits with code 2.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  // Formats "file:line:column: message\n  <line of the file>\n       ^". Reads the file again to
  // quote the line; leaves the quotation out if the file cannot be read any more.
  Error(const Location& where, const std::string& message);
  // Same, quoting the line given, for text that is in memory only.
  Error(const Location& where, const std::string& message, std::string_view line);
};

// A failure that is not the input's fault (disk full, out of memory): exit code 1.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// "file:line:column" or "" if the location is not known.
std::string to_string(const Location& where);

}  // namespace pssmlt
