#include "tests/vocabulary/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tests/vocabulary/word_text.h"

namespace pssmlt::test {
namespace {

// How the page speaks of a word.
enum Verdict { picture, reason, ignored, refused };
const std::array<std::string, 4> names = {"picture", "reason", "**without effect**", "**refused**"};

struct Row {
  const Word* word = nullptr;
  Verdict verdict = picture;
  std::string text;        // message, note or reason
  std::string group = "";  // of reasons: their kind
};

Row row_of(const Word& word, const Fate& fate, const Reasons& reasons) {
  if (fate.refused) return {&word, refused, fate.message};
  const std::optional<std::string> key = reason_key(reasons, word);
  if (!key) return {&word, picture, fate.message};
  const Reason& why = reasons.at(*key);
  if (why.kind == Reason::ignored) return {&word, ignored, why.text};
  return {&word, reason, why.text, to_string(why.kind)};
}

std::string cell(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

size_t count(const std::vector<Row>& rows, const std::string& kind, Verdict verdict) {
  return static_cast<size_t>(std::ranges::count_if(rows, [&](const Row& r) {
    return r.verdict == verdict && (kind.empty() || r.word->kind == kind);
  }));
}

std::string share(size_t part, size_t all) {
  return fmt::format("{} of {} ({:.1f} %)", part, all,
                     all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

// ": 30 noise, 2 record", of all reasons.
std::string groups(const std::vector<Row>& rows) {
  std::map<std::string, int> counts;
  for (const Row& row : rows)
    if (!row.group.empty()) ++counts[row.group];
  std::string text;
  for (const auto& [group, n] : counts)
    text += fmt::format("{} {} {}", text.empty() ? ":" : ",", n, group);
  return text;
}

std::string summary(const std::vector<Row>& rows) {
  std::array<size_t, 4> n{};
  for (size_t v = 0; v < n.size(); ++v) n[v] = count(rows, "", static_cast<Verdict>(v));
  std::string text = "- supported: " + share(n[picture] + n[reason], rows.size()) + "\n";
  text += "  - picture: " + share(n[picture], rows.size()) + "\n";
  text += "  - reason: " + share(n[reason], rows.size()) + groups(rows) + "\n";
  text += "- without effect, although it should have one: " + share(n[ignored], rows.size()) + "\n";
  text += "- refused, with the message given: " + share(n[refused], rows.size()) + "\n\n";
  return text;
}

std::string table_of(const std::vector<Row>& rows, const std::string& kind) {
  std::string text = "\n## " + kind + "\n\n| word | | message, note or reason |\n|---|---|---|\n";
  for (const Row& row : rows) {
    if (row.word->kind != kind) continue;
    const bool itself = row.word->parameter.empty();
    const std::string& form = row.word->form;
    text += fmt::format(
        "| {}{} | {} | {} |\n",
        itself ? "**" + row.word->plugin + "**" : "`" + cell(declaration_of(*row.word)) + "`",
        itself && !form.empty() ? " (" + form + ")" : "",
        names[row.verdict] + (row.group.empty() ? "" : ": " + row.group), cell(row.text));
  }
  return text;
}

constexpr const char* head =
    R"(# Vocabulary of pbrt-v4

Every directive, plugin and parameter of the reference of [pbrt-v4's
format](https://pbrt.org/fileformat-v4), and what this program does with it. Made by loading a
small scene for each (`PSSMLT_WRITE_VOCABULARY=1 build/bin/test_vocabulary`); tests hold the page
against the program:

- *picture*: a test renders a small stage with the word and without it, or with another value, and
  the pictures differ beyond what noise explains (32 renders each, false-alarm probability of
  one word 10^-6; with --honour-clamp, for the film's "maxcomponentvalue");
- *reason*: no picture is to change, for the reason given, which has been reviewed and is tested as
  well: only the *noise* is another (bits differ, no mean does), not a bit differs (*same*), as much
  as *rounding* makes differs, or the *record* of what is written where;
- *without effect*: the picture should change and does not;
- *refused*: with this message.

)";

}  // namespace

std::string page(const std::vector<Word>& words, const std::vector<Fate>& fates,
                 const Reasons& reasons) {
  std::vector<Row> rows;
  for (size_t i = 0; i < words.size(); ++i) rows.push_back(row_of(words[i], fates[i], reasons));
  std::string text = head + summary(rows) +
                     "| kind | words | picture | reason | without effect | refused |\n"
                     "|---|---|---|---|---|---|\n";
  std::vector<std::string> kinds;
  for (const Word& w : words)
    if (std::ranges::find(kinds, w.kind) == kinds.end()) kinds.push_back(w.kind);
  for (const std::string& kind : kinds) {
    std::array<size_t, 4> n{};
    for (size_t v = 0; v < n.size(); ++v) n[v] = count(rows, kind, static_cast<Verdict>(v));
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", kind, n[0] + n[1] + n[2] + n[3], n[0],
                        n[1], n[2], n[3]);
  }
  for (const std::string& kind : kinds) text += table_of(rows, kind);
  return text;
}

}  // namespace pssmlt::test
