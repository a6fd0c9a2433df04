// Every word of pbrt-v4's format that is supported shows in a picture, or a reviewed list says why
// it cannot, which is tested as well.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "tests/support/reduced.h"
#include "tests/support/temporary_folder.h"
#include "tests/vocabulary/pictures.h"
#include "tests/vocabulary/reviewed.h"
#include "tests/vocabulary/stage.h"
#include "tests/vocabulary/vocabulary.h"
#include "tests/vocabulary/word_text.h"

namespace pssmlt::test {
namespace {

namespace fs = std::filesystem;

const fs::path root = PSSMLT_SOURCE_DIR;

std::vector<Word> all_words() { return read_words(root / "tests/vocabulary/pbrt-v4.txt"); }
Reasons all_reasons() { return read_reasons(root / "tests/vocabulary/unseen.txt"); }

std::string title(const Word& w) {
  return fmt::format("{} {}, {} (line {})", w.kind, w.plugin, declaration_of(w), w.line);
}

// Pictures of scenes, each rendered once. Words of a plugin have the picture without them in
// common.
class Theatre {
 public:
  Theatre() { make_files(folder_.path()); }
  const Pictures& show(const std::string& scene) {
    const auto [at, fresh] = shown_.try_emplace(scene);
    if (fresh) at->second = render_pictures(scene, folder_.path());
    return at->second;
  }
  const fs::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  std::map<std::string, Pictures> shown_;
};

// To be looked at: PSSMLT_VOCABULARY_PICTURES names a folder for the pictures with and without, and
// a list of how clearly they differ.
void write_if_asked(const Word& word, const Pictures& with, const Pictures& without,
                    const Difference& found) {
  const char* folder = std::getenv("PSSMLT_VOCABULARY_PICTURES");
  if (folder == nullptr) return;
  const std::string start = fmt::format("{}/{:03}-{}-{}-{}-", folder, word.line, word.kind,
                                        word.plugin, name_of(declaration_of(word)));
  write_image(start + "with.png", with.images.front(), {}, {});
  write_image(start + "without.png", without.images.front(), {}, {});
  std::ofstream(fs::path(folder) / "clearness.txt", std::ios::app)
      << fmt::format("{:10.4f} {}\n", found.excess, title(word));
}

void expect_shown(const Word& word, const Reasons& reasons, Theatre& theatre) {
  const StagedScenes scenes = staged(word);
  const Pictures &with = theatre.show(scenes.with), &without = theatre.show(scenes.without);
  const Difference found = compare(with, without);
  write_if_asked(word, with, without, found);
  const std::optional<std::string> key = reason_key(reasons, word);
  const Reason::Kind kind = key ? reasons.at(*key).kind : Reason::same;
  if (!key) {
    EXPECT_TRUE(found.picture) << "the picture is the same, "
                               << (found.bits ? "but for noise, " : "bit by bit, ") << found.excess
                               << " of what would be clear";
    return;
  }
  EXPECT_FALSE(found.picture) << "shown by the picture, to be struck out of unseen.txt";
  EXPECT_EQ(found.bits, kind == Reason::noise || kind == Reason::rounding)
      << "the reason says otherwise";
  EXPECT_EQ(with.record != without.record, kind == Reason::record);
}

std::vector<std::string> kinds() {
  std::vector<std::string> list;
  for (const Word& w : all_words())
    if (list.empty() || list.back() != w.kind) list.push_back(w.kind);
  return list;
}

class VocabularyPictures : public testing::TestWithParam<std::string> {};

// False alarms: 1e-6 for each reason "noise" or "rounding"; a word that changes nothing but noise
// passes for one that shows with the same probability. Sanitized builds look at every eighth word.
TEST_P(VocabularyPictures, ShowEveryWord) {
  const Reasons reasons = all_reasons();
  Theatre theatre;
  int number = 0;
  for (const Word& word : all_words()) {
    if (word.kind != GetParam()) continue;
    if (reduced() && number++ % 8 != 0) continue;
    SCOPED_TRACE(title(word));
    try {
      expect_shown(word, reasons, theatre);
    } catch (const std::exception& failure) {
      if (!try_word(word, theatre.folder()).refused) ADD_FAILURE() << failure.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, VocabularyPictures, testing::ValuesIn(kinds()),
                         [](const auto& test) { return test.param; });

// Reasons are of words that there are.
TEST(VocabularyReasons, AreOfWords) {
  const Reasons reasons = all_reasons();
  std::set<std::string> used;
  for (const Word& word : all_words())
    if (const auto key = reason_key(reasons, word)) used.insert(*key);
  for (const auto& [key, reason] : reasons)
    EXPECT_TRUE(used.contains(key)) << "no such word: " << key;
}

}  // namespace
}  // namespace pssmlt::test
