#include "core/base/error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace pssmlt {
namespace {

Location at(const std::string& file, uint32_t line, uint32_t column) {
  return {std::make_shared<const std::string>(file), line, column};
}

TEST(Error, LocationsAreWrittenAsFarAsTheyAreKnown) {
  EXPECT_EQ(to_string(Location()), "");
  EXPECT_EQ(to_string(at("a.pbrt", 0, 0)), "a.pbrt");
  EXPECT_EQ(to_string(at("a.pbrt", 3, 0)), "a.pbrt:3");
  EXPECT_EQ(to_string(at("a.pbrt", 3, 7)), "a.pbrt:3:7");
}

TEST(Error, QuotesTheLineOfTheFile) {
  const auto path = std::filesystem::temp_directory_path() / "pssmlt_error_test.txt";
  std::ofstream(path) << "first\n\tsecond line\r\nthird\n";
  const Error error(at(path.string(), 2, 9), "wrong");
  EXPECT_EQ(error.what(), path.string() + ":2:9: wrong\n  \tsecond line\n  \t       ^");
  std::filesystem::remove(path);
}

TEST(Error, WithoutTheFileOnlyThePlace) {
  EXPECT_STREQ(Error(at("/does/not/exist", 2, 9), "wrong").what(), "/does/not/exist:2:9: wrong");
  EXPECT_STREQ(Error(Location(), "wrong").what(), "wrong");
}

TEST(Error, LongLinesAreCutAroundTheCaret) {
  const std::string line(100000, 'x');
  const std::string text = Error(at("f", 1, 50001), "wrong", line).what();
  EXPECT_LT(text.size(), 400u);
  const size_t below = text.rfind('\n');
  EXPECT_EQ(text.back(), '^');
  EXPECT_NE(text.find("...x"), std::string::npos);
  EXPECT_EQ(text.size() - below - 1, 2u + 3u + 80u + 1u);  // indent, dots, shown before, caret
}

TEST(Error, ACaretBeyondTheLineStandsAtItsEnd) {
  EXPECT_STREQ(Error(at("f", 1, 99), "wrong", "abc").what(), "f:1:99: wrong\n  abc\n     ^");
}

}  // namespace
}  // namespace pssmlt
