// Cuts the text of a scene file into tokens without allocating: tokens are views into the text.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace pssmlt {

// The whole text of a file, plain or gzip (known by its first bytes, whatever its name). Throws
// Error at `where` if it cannot be read. Not memory-mapped: a file that shrinks while it is mapped
// would kill the process.
std::string read_text(const std::string& path, const Location& where);

enum class TokenKind : uint8_t { End, Word, String, Open, Close };

struct Token {
  TokenKind kind = TokenKind::End;
  bool has_escapes = false;  // String only: text needs unescape()
  uint32_t line = 0, column = 0;
  std::string_view text;  // String: without the quotes
};

class Tokenizer {
 public:
  // name: the file's, for locations. text must outlive the tokenizer and its tokens.
  Tokenizer(std::string_view text, std::shared_ptr<const std::string> name);

  // Both throw Error on text that is no token (a string that does not end).
  Token next();
  const Token& peek();

  // Fast path for arrays: appends the numbers that follow, up to the first token that is not a
  // plain number (which the next next() returns, and whose error the caller words).
  void append_numbers(std::vector<float>& values);
  void append_numbers(std::vector<int>& values);

  // Value of a String token.
  std::string unescape(const Token& token) const;
  Location where(const Token& token) const { return {name_, token.line, token.column}; }
  // Error at the token, quoting its line from the text.
  [[noreturn]] void fail(const Token& token, const std::string& message) const;
  [[noreturn]] void fail(const Location& where, const std::string& message) const;
  const std::shared_ptr<const std::string>& name() const { return name_; }

 private:
  void skip_space();
  Token string_token();
  uint32_t column(const char* p) const { return static_cast<uint32_t>(p - line_start_) + 1; }
  std::string_view line_text(uint32_t line) const;
  template <typename T>
  void append_plain(std::vector<T>& values);

  std::string_view text_;
  std::shared_ptr<const std::string> name_;
  const char* at_;
  const char* end_;
  const char* line_start_;
  uint32_t line_ = 1;
  bool peeked_ = false;
  Token ahead_;
};

// A number as pbrt writes it (an optional sign, digits, point, exponent; no hexadecimal, no names
// for infinity). False if the whole text is not one, or it does not fit: infinity is never
// returned; what is too small becomes 0.
bool parse_number(std::string_view text, double& value);
bool parse_number(std::string_view text, float& value);
bool parse_number(std::string_view text, int& value);

}  // namespace pssmlt
