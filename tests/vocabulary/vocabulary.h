// What becomes of every word of pbrt-v4's format: read from a table, tried.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pssmlt::test {

struct Word {
  std::string kind, plugin, form;  // form: of textures, "float" or "spectrum"
  std::string needed;              // what the plugin cannot do without; of directives all
  std::string parameter;    // as written, and what stands beside it; "" for the plugin itself
  std::string base;         // what stands instead in the picture without the word
  bool base_alone = false;  // and instead of all that stands beside it
  std::string stage;        // what shows it; "": the kind's
  int line = 0;             // of the table
};

// How a word fared when it was loaded. Refused words say so with `message`; the others may have a
// note.
struct Fate {
  bool refused = false;
  std::string message;
  bool located = false;  // the refusal names its place in the scene
};

// Throws if the table is malformed.
std::vector<Word> read_words(const std::filesystem::path& table);
// Loads the word's stage; `folder` has the files that the table names (make_files). Throws if the
// stage cannot be loaded without the word.
Fate try_word(const Word& word, const std::filesystem::path& folder);
void make_files(const std::filesystem::path& folder);

}  // namespace pssmlt::test
