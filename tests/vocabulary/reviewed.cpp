#include "tests/vocabulary/reviewed.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>

#include "tests/vocabulary/word_text.h"

namespace pssmlt::test {
namespace {

constexpr std::array<const char*, 5> kind_names = {"noise", "same", "rounding", "record",
                                                   "ignored"};

Reason::Kind kind_of(const std::string& name) {
  const auto found = std::ranges::find(kind_names, name);
  if (found == kind_names.end()) throw std::runtime_error("no kind of reason: " + name);
  return static_cast<Reason::Kind>(found - kind_names.begin());
}

}  // namespace

const char* to_string(Reason::Kind kind) { return kind_names[kind]; }

Reasons read_reasons(const std::filesystem::path& list) {
  std::ifstream in(list);
  if (!in) throw std::runtime_error("no list " + list.string());
  Reasons reasons;
  std::string section;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (line.starts_with('[')) {
      section = line.substr(1, line.find(']') - 1);
      continue;
    }
    const size_t arrow = line.find(" => "), colon = line.find(": ", arrow);
    if (arrow == std::string::npos || colon == std::string::npos)
      throw std::runtime_error("not \"word => kind: reason\": " + line);
    const Reason reason{kind_of(line.substr(arrow + 4, colon - arrow - 4)), line.substr(colon + 2)};
    if (!reasons.emplace(section + ": " + line.substr(0, arrow), reason).second)
      throw std::runtime_error("given twice: " + line);
  }
  return reasons;
}

std::optional<std::string> reason_key(const Reasons& reasons, const Word& word) {
  for (const std::string& plugin : {word.plugin, std::string("*")}) {
    const std::string key = word.kind + " " + plugin + ": " + declaration_of(word);
    if (reasons.contains(key)) return key;
  }
  return {};
}

}  // namespace pssmlt::test
