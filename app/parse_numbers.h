// Numbers in options: "640x480", "10,200,0,100".
#pragma once

#include <charconv>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace pssmlt {

// Numbers separated by `separator`, exactly `count` of them, nothing else. Throws Error: "... is
// not `usage`".
template <typename T>
std::vector<T> parse_numbers(const std::string& text, char separator, size_t count,
                             const std::string& usage) {
  std::vector<T> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (values.size() < count) {
    if (!values.empty() && (at == end || *at++ != separator)) break;
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc()) break;
    values.push_back(value);
    at = next;
  }
  if (values.size() != count || at != end) throw Error("\"" + text + "\" is not " + usage);
  return values;
}

}  // namespace pssmlt
