#include "core/scene/tokenizer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pssmlt {
namespace {

std::shared_ptr<const std::string> name() { return std::make_shared<const std::string>("t"); }

TEST(Tokenizer, KindsAndPlaces) {
  Tokenizer tokens("Shape # comment \"\n\t\"a b\"[1.5]\r\nx", name());
  const Token shape = tokens.next();
  EXPECT_EQ(shape.kind, TokenKind::Word);
  EXPECT_EQ(shape.text, "Shape");
  EXPECT_EQ(to_string(tokens.where(shape)), "t:1:1");
  EXPECT_EQ(tokens.peek().kind, TokenKind::String);
  const Token text = tokens.next();
  EXPECT_EQ(text.text, "a b");
  EXPECT_EQ(to_string(tokens.where(text)), "t:2:2");
  EXPECT_EQ(tokens.next().kind, TokenKind::Open);
  EXPECT_EQ(tokens.next().text, "1.5");
  EXPECT_EQ(tokens.next().kind, TokenKind::Close);
  EXPECT_EQ(to_string(tokens.where(tokens.next())), "t:3:1");
  EXPECT_EQ(tokens.next().kind, TokenKind::End);
  EXPECT_EQ(tokens.next().kind, TokenKind::End);
}

TEST(Tokenizer, EmptyTextAndByteOrderMark) {
  EXPECT_EQ(Tokenizer({}, name()).next().kind, TokenKind::End);
  Tokenizer tokens("\xEF\xBB\xBFx", name());
  const Token x = tokens.next();
  EXPECT_EQ(x.text, "x");
  EXPECT_EQ(x.column, 1u);
}

TEST(Tokenizer, Escapes) {
  Tokenizer tokens(R"("a\"b\\c\n\t\'" "d")", name());
  const Token token = tokens.next();
  EXPECT_EQ(tokens.unescape(token), "a\"b\\c\n\t'");
  EXPECT_EQ(tokens.unescape(tokens.next()), "d");
  Tokenizer bad(R"("a\q")", name());
  EXPECT_THROW(bad.unescape(bad.next()), Error);
}

TEST(Tokenizer, StringsEndOnTheirLine) {
  for (const char* text : {"\"abc", "\"abc\n\"", "\"abc\\", "\"abc\\\n\"", "\""}) {
    Tokenizer tokens(text, name());
    EXPECT_THROW(tokens.next(), Error) << text;
  }
}

TEST(Tokenizer, FastNumbersStopBeforeWhatIsNone) {
  Tokenizer tokens("1 -2.5 .5\n3e2]", name());
  std::vector<float> values;
  tokens.append_numbers(values);
  EXPECT_EQ(values, (std::vector<float>{1.f, -2.5f, .5f, 300.f}));
  EXPECT_EQ(tokens.next().kind, TokenKind::Close);
  for (const char* text : {"nan", "-inf", "1e99", "1x", "+1", "--1", "-", "x"}) {
    Tokenizer other(text, name());
    std::vector<float> none;
    other.append_numbers(none);
    EXPECT_TRUE(none.empty()) << text;
    EXPECT_EQ(other.next().text, text);
  }
}

TEST(Tokenizer, Numbers) {
  float f = 0.f;
  for (const char* text : {"nan", "inf", "-inf", "infinity", "1e40", "0x10", "", "+", "-", ".",
                           "1.5.2", "1e", "--1", "+-1", "1 "})
    EXPECT_FALSE(parse_number(text, f)) << text;
  EXPECT_TRUE(parse_number("+1.5", f));
  EXPECT_EQ(f, 1.5f);
  EXPECT_TRUE(parse_number("-0", f));
  EXPECT_TRUE(std::signbit(f));
  for (const char* tiny : {"1e-60", "0.00000000000000000000000000000000000000000000000000001"}) {
    EXPECT_TRUE(parse_number(tiny, f)) << tiny;
    EXPECT_EQ(f, 0.f) << tiny;
  }
  int i = 0;
  for (const char* text : {"1.0", "1e3", "2147483648", "", "-", "1x"})
    EXPECT_FALSE(parse_number(text, i)) << text;
  EXPECT_TRUE(parse_number("-2147483648", i));
  EXPECT_EQ(i, -2147483647 - 1);
  EXPECT_TRUE(parse_number("+7", i));
  EXPECT_EQ(i, 7);
}

}  // namespace
}  // namespace pssmlt
