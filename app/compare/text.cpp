#include "app/compare/text.h"

#include <fcntl.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/base/error.h"

namespace pssmlt::compare {

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == separator && depth <= 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string join(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) {
    throw Error("cannot read \"" + path + "\": " + std::strerror(errno));
  }
  return content;
}

std::vector<std::pair<int, std::string>> read_lines(const std::string& file) {
  std::istringstream in(read_file(file));
  std::vector<std::pair<int, std::string>> lines;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) lines.emplace_back(number, line);
  }
  return lines;
}

std::string plain_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    name += plain ? c : '-';
  }
  while (name.size() > 1 && name.back() == '-') name.pop_back();
  return name;
}

void write_file(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part";
  const auto fail = [&] {
    const std::string reason = std::strerror(errno);
    std::remove(temporary.c_str());
    throw Failure("cannot write \"" + path + "\": " + reason);
  };
  FILE* const file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr) fail();
  bool fine = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  fine = std::fflush(file) == 0 && fine;
  fine = fsync(fileno(file)) == 0 && fine;
  fine = std::fclose(file) == 0 && fine;
  if (!fine || std::rename(temporary.c_str(), path.c_str()) != 0) fail();
}

}  // namespace pssmlt::compare
