#include "core/base/error.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace pssmlt {
namespace {

// Bytes of the line shown on either side of the caret.
constexpr size_t shown_before = 80, shown_after = 60;

// The wanted line of a file (plain or gzip), or "" if it cannot be read. Only as much of a line is
// kept as can be shown.
std::string read_line(const std::string& path, uint32_t line, uint32_t column) {
  std::error_code ignored;
  if (line == 0 || !std::filesystem::is_regular_file(path, ignored)) return "";
  const gzFile file = gzopen(path.c_str(), "rb");  // also reads what is not compressed
  if (file == nullptr) return "";
  std::string result;
  std::array<char, 65536> buffer;
  const size_t longest = column + shown_after + 1;
  uint32_t at = 1;
  for (int n = 0; at <= line && (n = gzread(file, buffer.data(), buffer.size())) > 0;) {
    const char* p = buffer.data();
    const char* const end = p + n;
    while (p != end && at <= line) {
      const char* const newline = std::find(p, end, '\n');
      if (at == line && result.size() < longest)
        result.append(p, std::min<size_t>(longest - result.size(), newline - p));
      p = newline == end ? end : newline + 1;
      if (newline != end) ++at;
    }
  }
  gzclose(file);
  return result;
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// The line, cut to the neighbourhood of the column, and a caret line below it.
std::string quote(std::string_view line, uint32_t column) {
  if (line.empty() || column == 0) return "";
  size_t caret = column - 1;
  std::string text = "\n  ";
  if (caret > line.size()) caret = line.size();
  if (caret > shown_before) {
    text += "...";
    line.remove_prefix(caret - shown_before);
    caret = shown_before;
  }
  const bool cut = line.size() > caret + shown_after;
  if (cut) line = line.substr(0, caret + shown_after);
  std::string below(text.size() - 1, ' ');
  for (size_t i = 0; i < line.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(line[i]);
    if (c == '\r') continue;
    text += c < 0x20 && c != '\t' ? '?' : line[i];
    // Tabs keep their width, the bytes of one UTF-8 character count once.
    if (i < caret && !continues_character(line[i])) below += c == '\t' ? '\t' : ' ';
  }
  return text + (cut ? "..." : "") + "\n" + below + "^";
}

std::string prefixed(const Location& where, const std::string& message) {
  const std::string place = to_string(where);
  return place.empty() ? message : place + ": " + message;
}

std::string quoted_from_file(const Location& where) {
  if (where.file == nullptr || where.line == 0) return "";
  return quote(read_line(*where.file, where.line, where.column), where.column);
}

}  // namespace

Error::Error(const Location& where, const std::string& message)
    : std::runtime_error(prefixed(where, message) + quoted_from_file(where)) {}

Error::Error(const Location& where, const std::string& message, std::string_view line)
    : std::runtime_error(prefixed(where, message) + quote(line, where.column)) {}

std::string to_string(const Location& where) {
  if (where.file == nullptr) return "";
  std::string result = *where.file;
  if (where.line != 0) result += ":" + std::to_string(where.line);
  if (where.line != 0 && where.column != 0) result += ":" + std::to_string(where.column);
  return result;
}

}  // namespace pssmlt
