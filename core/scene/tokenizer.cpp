#include "core/scene/tokenizer.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

namespace pssmlt {
namespace {

// One byte's role in the text.
bool is_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}
bool ends_word(char c) { return is_space(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

// from_chars takes no plus sign, and takes "inf" and "nan", which pbrt's grammar has not.
bool strip_sign(const char*& p, const char* end) {
  if (p != end && *p == '+')
    ++p;
  else if (p != end && *p == '-')
    return p + 1 != end && p[1] != '+' && p[1] != '-';
  return p != end && *p != '+' && *p != '-';
}

bool starts_number(const char* p, const char* end) {
  if (p != end && *p == '-') ++p;
  return p != end && ((*p >= '0' && *p <= '9') || *p == '.');
}

// Whether a number out of range is too small, not too large: its exponent is negative, or it has
// none and no digit but 0 before the point.
bool underflows(std::string_view text) {
  const size_t exponent = text.find_first_of("eE");
  if (exponent != std::string_view::npos && text.find('-', exponent) != std::string_view::npos)
    return true;
  const size_t first = text.find_first_of("123456789.");
  return exponent == std::string_view::npos && first != std::string_view::npos &&
         text[first] == '.';
}

template <typename Float>
bool parse_float(std::string_view text, Float& value) {
  const char* p = text.data();
  const char* const end = p + text.size();
  if (!strip_sign(p, end) || !starts_number(p, end)) return false;
  const auto result = std::from_chars(p, end, value);
  if (result.ptr != end) return false;
  if (result.ec == std::errc()) return true;
  if (result.ec != std::errc::result_out_of_range || !underflows(text)) return false;
  value = 0;
  return true;
}

std::string read_plain(std::FILE* file, const std::string& path, const Location& where) {
  std::string text;
  std::error_code no_size;
  const auto size = std::filesystem::file_size(path, no_size);
  text.resize(no_size ? 65536 : size + 1);  // one more byte, to see the end without growing
  size_t used = 0;
  while (true) {
    const size_t n = std::fread(text.data() + used, 1, text.size() - used, file);
    used += n;
    if (used < text.size()) break;
    text.resize(2 * text.size());
  }
  if (std::ferror(file) != 0)
    throw Error(where, "cannot read '" + path + "': " + std::strerror(errno));
  text.resize(used);
  return text;
}

// Frees zlib's state however the function is left.
struct Inflater {
  z_stream stream{};
  Inflater() { ready = inflateInit2(&stream, 16 + MAX_WBITS) == Z_OK; }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  bool ready = false;
};

std::string gunzip(const std::string& packed, const std::string& path, const Location& where) {
  Inflater z;
  if (!z.ready) throw Failure("zlib does not start");
  std::string text;
  std::vector<char> chunk(1 << 18);
  size_t fed = 0;
  int status = Z_OK;
  while (status != Z_STREAM_END || fed < packed.size() || z.stream.avail_in > 0) {
    if (status == Z_STREAM_END) {  // concatenated members, as gzip allows
      if (inflateReset(&z.stream) != Z_OK) throw Failure("zlib does not restart");
    }
    if (z.stream.avail_in == 0) {
      const size_t n = std::min<size_t>(packed.size() - fed, 1 << 30);
      z.stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data() + fed));
      z.stream.avail_in = static_cast<uInt>(n);
      fed += n;
    }
    z.stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    z.stream.avail_out = static_cast<uInt>(chunk.size());
    status = inflate(&z.stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END)
      throw Error(where, "cannot unpack '" + path + "': the gzip data is damaged or cut short");
    text.append(chunk.data(), chunk.size() - z.stream.avail_out);
  }
  return text;
}

}  // namespace

std::string read_text(const std::string& path, const Location& where) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(where, "cannot read '" + path + "': it is a directory");
  // Some of them never end.
  if (std::filesystem::is_character_file(path, ignored))
    throw Error(where, "cannot read '" + path + "': it is a device");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr) throw Error(where, "cannot open '" + path + "': " + std::strerror(errno));
  std::string text = read_plain(file.get(), path, where);
  const bool packed = text.size() >= 2 && text[0] == '\x1f' && text[1] == '\x8b';
  return packed ? gunzip(text, path, where) : text;
}

bool parse_number(std::string_view text, double& value) { return parse_float(text, value); }
bool parse_number(std::string_view text, float& value) { return parse_float(text, value); }

bool parse_number(std::string_view text, int& value) {
  const char* p = text.data();
  const char* const end = p + text.size();
  if (!strip_sign(p, end)) return false;
  const auto result = std::from_chars(p, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

Tokenizer::Tokenizer(std::string_view text, std::shared_ptr<const std::string> name)
    : text_(text),
      name_(std::move(name)),
      at_(text.data()),
      end_(text.data() + text.size()),
      line_start_(text.data()) {
  if (text.starts_with("\xEF\xBB\xBF")) {  // byte order mark of UTF-8
    at_ += 3;
    line_start_ += 3;
  }
}

void Tokenizer::skip_space() {
  while (at_ != end_) {
    const char c = *at_;
    if (c == '\n') {
      ++line_;
      line_start_ = at_ + 1;
    } else if (c == '#') {
      const void* const newline = std::memchr(at_, '\n', static_cast<size_t>(end_ - at_));
      at_ = newline != nullptr ? static_cast<const char*>(newline) : end_;
      continue;
    } else if (!is_space(c)) {
      return;
    }
    ++at_;
  }
}

Token Tokenizer::string_token() {
  Token token{TokenKind::String, false, line_, column(at_), {}};
  const char* const begin = ++at_;
  for (; at_ != end_ && *at_ != '"' && *at_ != '\n'; ++at_) {
    if (*at_ != '\\') continue;
    token.has_escapes = true;
    if (at_ + 1 == end_ || at_[1] == '\n') break;
    ++at_;
  }
  if (at_ == end_ || *at_ != '"') fail(token, "this string does not end on its line");
  token.text = {begin, static_cast<size_t>(at_ - begin)};
  ++at_;
  return token;
}

Token Tokenizer::next() {
  if (peeked_) {
    peeked_ = false;
    return ahead_;
  }
  skip_space();
  Token token{TokenKind::End, false, line_, column(at_), {at_, 0}};
  if (at_ == end_) return token;
  if (*at_ == '"') return string_token();
  const char* const begin = at_++;
  if (*begin == '[' || *begin == ']') {
    token.kind = *begin == '[' ? TokenKind::Open : TokenKind::Close;
  } else {
    token.kind = TokenKind::Word;
    while (at_ != end_ && !ends_word(*at_)) ++at_;
  }
  token.text = {begin, static_cast<size_t>(at_ - begin)};
  return token;
}

const Token& Tokenizer::peek() {
  if (!peeked_) {
    ahead_ = next();
    peeked_ = true;
  }
  return ahead_;
}

template <typename T>
void Tokenizer::append_plain(std::vector<T>& values) {
  if (peeked_) return;
  while (true) {
    skip_space();
    if (!starts_number(at_, end_)) return;
    T value;
    const auto result = std::from_chars(at_, end_, value);
    if (result.ec != std::errc() || (result.ptr != end_ && !ends_word(*result.ptr))) return;
    values.push_back(value);
    at_ = result.ptr;
  }
}

void Tokenizer::append_numbers(std::vector<float>& values) { append_plain(values); }
void Tokenizer::append_numbers(std::vector<int>& values) { append_plain(values); }

std::string Tokenizer::unescape(const Token& token) const {
  if (!token.has_escapes) return std::string(token.text);
  std::string result;
  for (size_t i = 0; i < token.text.size(); ++i) {
    char c = token.text[i];
    if (c == '\\') {
      // string_token() never lets a string end in a lone backslash.
      constexpr std::string_view names = "bfnrt\\'\"", values = "\b\f\n\r\t\\'\"";
      const size_t which = names.find(token.text[++i]);
      if (which == std::string_view::npos)
        fail({name_, token.line, token.column + static_cast<uint32_t>(i)},
             "unknown escape sequence; known are \\b \\f \\n \\r \\t \\\\ \\' \\\"");
      c = values[which];
    }
    result += c;
  }
  return result;
}

std::string_view Tokenizer::line_text(uint32_t line) const {
  std::string_view rest = text_;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  for (uint32_t i = 1; i < line; ++i) {
    const size_t newline = rest.find('\n');
    if (newline == std::string_view::npos) return {};
    rest.remove_prefix(newline + 1);
  }
  return rest.substr(0, rest.find('\n'));
}

void Tokenizer::fail(const Token& token, const std::string& message) const {
  fail(where(token), message);
}

void Tokenizer::fail(const Location& where, const std::string& message) const {
  throw Error(where, message, line_text(where.line));
}

}  // namespace pssmlt
