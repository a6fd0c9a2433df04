// What a review found of the words that no picture shows (tests/vocabulary/unseen.txt).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "tests/vocabulary/vocabulary.h"

namespace pssmlt::test {

// Why no picture changes, and what the test holds it to.
struct Reason {
  enum Kind {
    noise,     // other random numbers: bits differ, means do not
    same,      // speed, memory, another name: not a bit differs
    rounding,  // bits differ, means do not by what can be seen
    record,    // what is written, and where: as the film's record says
    ignored    // it should have an effect and has none: not a bit differs
  } kind = same;
  std::string text;
};

// As the list names it.
const char* to_string(Reason::Kind kind);

// By "kind plugin: declaration", where the plugin may be "*".
using Reasons = std::map<std::string, Reason>;

// Throws if the list is malformed.
Reasons read_reasons(const std::filesystem::path& list);
// The entry of a word's own plugin goes before that of all plugins.
std::optional<std::string> reason_key(const Reasons& reasons, const Word& word);

}  // namespace pssmlt::test
