// The documentation agrees with the code: the reference of the plugins is what the program prints,
// links lead somewhere, code that is shown is the code of the example.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

const fs::path root = PSSMLT_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> buffer;
  for (size_t n; pipe && (n = fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0;) {
    text.append(buffer.data(), n);
  }
  return text;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {root / "README.md", root / "CONTRIBUTING.md",
                                 root / "CHANGELOG.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  return found;
}

// A heading as links name it: lower case, blanks to hyphens, punctuation dropped.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) || c == '-' || c == '_') anchor += static_cast<char>(std::tolower(u));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

bool has_anchor(const fs::path& page, const std::string& anchor) {
  std::istringstream lines(read(page));
  for (std::string line; std::getline(lines, line);) {
    const size_t level = line.find_first_not_of('#');
    if (level == 0 || level == std::string::npos || line[level] != ' ') continue;
    if (anchor_of(line.substr(level + 1)) == anchor) return true;
  }
  return false;
}

std::string without_code(const std::string& text) {
  static const std::regex inline_code("`[^`\n]*`");
  std::string out;
  bool fenced = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      fenced = !fenced;
    else if (!fenced)
      out += std::regex_replace(line, inline_code, "") + "\n";
  }
  return out;
}

TEST(Docs, PluginReferenceIsGenerated) {
  const std::string printed =
      output_of(std::string("env -u PSSMLT_PLUGIN_PATH ") + PSSMLT_BINARY + " plugins --markdown");
  ASSERT_FALSE(printed.empty());
  EXPECT_EQ(read(root / "docs/plugins.md"), printed)
      << "run: ./pssmlt plugins --markdown > docs/plugins.md";
}

TEST(Docs, LinksLeadSomewhere) {
  static const std::regex link("\\]\\(([^)\\s]+)\\)");
  for (const fs::path& page : pages()) {
    const std::string text = without_code(read(page));
    EXPECT_FALSE(text.empty()) << page;
    for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
      const std::string target = (*i)[1];
      if (target.find("://") != std::string::npos) continue;
      const size_t hash = target.find('#');
      const std::string name = target.substr(0, hash);
      const fs::path file = name.empty() ? page : page.parent_path() / name;
      EXPECT_TRUE(fs::exists(file)) << page << " links to " << target;
      if (hash == std::string::npos || file.extension() != ".md") continue;
      EXPECT_TRUE(has_anchor(file, target.substr(hash + 1))) << page << " links to " << target;
    }
  }
}

// Every line of C++ and CMake shown in the tutorial stands in the example, in the same order
// within a block, so that what readers copy is what the tests build.
TEST(Docs, TutorialShowsTheExample) {
  const std::string code = read(root / "docs/examples/naive_path/naive_path.cpp") +
                           read(root / "docs/examples/naive_path/CMakeLists.txt");
  std::istringstream lines(read(root / "docs/write-an-integrator.md"));
  size_t from = std::string::npos;  // where the next line is looked for; npos: outside of a block
  int shown = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```cpp" || line == "```cmake") {
      from = 0;
    } else if (line == "```") {
      from = std::string::npos;
    } else if (from != std::string::npos && !line.empty() &&
               line.find("// ...") == std::string::npos) {
      const size_t at = code.find(line, from);
      ASSERT_NE(at, std::string::npos) << "not in the example: " << line;
      from = at + line.size();
      ++shown;
    }
  }
  EXPECT_GT(shown, 20);
}

}  // namespace
