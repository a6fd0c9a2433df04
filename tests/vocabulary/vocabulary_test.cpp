// docs/vocabulary.md says what the program does with every word of pbrt-v4's format.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/support/temporary_folder.h"
#include "tests/vocabulary/page.h"
#include "tests/vocabulary/vocabulary.h"

namespace pssmlt::test {
namespace {

namespace fs = std::filesystem;

const fs::path root = PSSMLT_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// The first line that differs, for a message that helps.
std::string difference(const std::string& a, const std::string& b) {
  std::istringstream left(a), right(b);
  std::string x, y;
  while (std::getline(left, x)) {
    if (!std::getline(right, y) || x != y) return "the page: " + y + "\nthe program: " + x;
  }
  return "";
}

TEST(Vocabulary, PageSaysWhatTheProgramDoes) {
  const std::vector<Word> words = read_words(root / "tests/vocabulary/pbrt-v4.txt");
  EXPECT_GT(words.size(), 400u);
  const TemporaryFolder folder;
  make_files(folder.path());
  std::vector<Fate> fates;
  for (const Word& word : words) fates.push_back(try_word(word, folder.path()));
  const std::string now = page(words, fates, read_reasons(root / "tests/vocabulary/unseen.txt"));
  const fs::path file = root / "docs/vocabulary.md";
  if (std::getenv("PSSMLT_WRITE_VOCABULARY") != nullptr) std::ofstream(file) << now;
  const std::string there = read(file);
  EXPECT_TRUE(there == now) << "run: PSSMLT_WRITE_VOCABULARY=1 build/bin/test_vocabulary\n"
                            << difference(now, there);
}

// Refusals as tests/vocabulary/reviewed.txt has them: "kind plugin: message".
std::set<std::string> reviewed() {
  std::set<std::string> list;
  std::ifstream in(root / "tests/vocabulary/reviewed.txt");
  std::string section;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (line.starts_with('[')) {
      section = line.substr(1, line.find(']') - 1);
      continue;
    }
    const size_t end = line.find(" => ");
    EXPECT_NE(end, std::string::npos) << "no reason: " << line;
    list.insert(section + ": " + line.substr(0, end));
  }
  return list;
}

// Whoever refuses a word says so in the list, with the message and a reason, and strikes out what
// works. The message says where the word stands.
TEST(Vocabulary, RefusalsAreReviewed) {
  const TemporaryFolder folder;
  make_files(folder.path());
  const std::set<std::string> list = reviewed();
  std::set<std::string> refused;
  for (const Word& word : read_words(root / "tests/vocabulary/pbrt-v4.txt")) {
    const Fate fate = try_word(word, folder.path());
    if (!fate.refused) continue;
    EXPECT_TRUE(fate.located) << "line " << word.line << ": " << fate.message;
    const std::string key = word.kind + " " + word.plugin + ": " + fate.message;
    refused.insert(key);
    EXPECT_TRUE(list.contains(key)) << "not in tests/vocabulary/reviewed.txt: " << key;
  }
  for (const std::string& key : list) {
    EXPECT_TRUE(refused.contains(key)) << "no longer refused: " << key;
  }
}

}  // namespace
}  // namespace pssmlt::test
