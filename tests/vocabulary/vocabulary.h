// What becomes of every word of pbrt-v4's format: read from a table, tried, written as a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pssmlt::test {

struct Word {
  std::string kind, plugin, form;  // form: of textures, "float" or "spectrum"
  std::string needed;              // what the plugin cannot do without; of directives all
  std::string parameter;           // as written; "" for the plugin itself
  int line = 0;                    // of the table
};

// How a word fared. Refused words say so with `message`; the others may have a note.
struct Fate {
  enum Kind { supported, without_effect, refused } kind = supported;
  std::string message;
  bool located = false;  // the refusal names its place in the scene
};

// Throws if the table is malformed.
std::vector<Word> read_words(const std::filesystem::path& table);
// Loads a scene that uses the word; `folder` has the files that the table names (make_files).
Fate try_word(const Word& word, const std::filesystem::path& folder);
void make_files(const std::filesystem::path& folder);
// The page: counts and a table for each kind.
std::string page(const std::vector<Word>& words, const std::vector<Fate>& fates);

}  // namespace pssmlt::test
