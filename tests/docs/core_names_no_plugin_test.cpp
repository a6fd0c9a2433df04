// The rule that keeps techniques apart: core names no plugin, plugins include core and never each
// other, app includes core.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

const fs::path root = PSSMLT_SOURCE_DIR;
const std::array<const char*, 10> plugin_folders = {
    "integrators", "samplers",   "materials", "textures", "shapes",
    "lights",      "arealights", "cameras",   "filters",  "media"};
// Words that are the name of a plugin and of something else, where core means that.
struct OtherMeaning {
  const char *word, *place, *meaning;  // place: a folder or a file
};
const std::array<OtherMeaning, 13> other_meanings = {
    {{"light", "core/scene", "a kind of plugin and a target of Attribute"},
     {"light", "core/metropolis", "a stream of primary samples"},
     {"light", "core/render", "the same stream"},
     {"point", "core/scene", "a parameter type of the text format"},
     {"infinite", "core/sampling", "why a sample was dropped"},
     {"gaussian", "core/metropolis", "a mutation kernel"},
     {"gaussian", "core/lens/aperture.cpp", "how a stop lets light through"},
     {"spherical", "core/texture_mapping.cpp", "how textures find their coordinates"},
     {"scale", "core/media", "a factor, a parameter of media"},
     {"threshold", "core/excess", "a parameter: a limit of samples"},
     {"excess", "core/excess", "a figure of the summary: the light above that limit"},
     {"pssmlt", "core/plugin", "the folder of installed plugins"},
     {"pssmlt", "core/base", "the program, in log lines"}}};

bool means_something_else(const std::string& word, const fs::path& file) {
  const std::string where = fs::relative(file, root).string();
  return std::ranges::any_of(other_meanings, [&](const OtherMeaning& other) {
    return word == other.word &&
           (where == other.place || where.starts_with(std::string(other.place) + "/"));
  });
}

std::string read(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!fs::exists(folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path ending = entry.path().extension();
    if (ending == ".h" || ending == ".cpp") found.push_back(entry.path());
  }
  return found;
}

std::set<std::string> plugin_names() {
  std::set<std::string> names;
  for (const char* folder : plugin_folders) {
    for (const fs::path& file : sources(root / folder)) {
      if (file.extension() == ".cpp") names.insert(file.stem().string());
    }
  }
  return names;
}

// The strings in double quotes of every line, comments left out.
std::vector<std::string> quoted(const std::string& text) {
  static const std::regex comment("//[^\n]*"), string("\"([^\"\n]*)\"");
  const std::string code = std::regex_replace(text, comment, "");
  std::vector<std::string> found;
  for (std::sregex_iterator i(code.begin(), code.end(), string), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

// Files included in quotes.
std::vector<std::string> included(const fs::path& file) {
  static const std::regex include("#\\s*include\\s*\"([^\"]+)\"");
  const std::string text = read(file);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

TEST(Rooms, CoreNamesNoPlugin) {
  const std::set<std::string> names = plugin_names();
  ASSERT_GT(names.size(), 20u) << "the plugin folders were not found";
  for (const fs::path& file : sources(root / "core")) {
    for (const std::string& word : quoted(read(file))) {
      EXPECT_TRUE(!names.contains(word) || means_something_else(word, file))
          << file << " names the plugin \"" << word << "\"";
    }
  }
}

TEST(Rooms, CoreIncludesOnlyCore) {
  for (const fs::path& file : sources(root / "core")) {
    for (const std::string& name : included(file)) {
      EXPECT_TRUE(name.starts_with("core/")) << file << " includes " << name;
    }
  }
}

TEST(Rooms, PluginsIncludeOnlyCore) {
  for (const char* folder : plugin_folders) {
    for (const fs::path& file : sources(root / folder)) {
      EXPECT_EQ(file.extension(), ".cpp") << file << ": a plugin has no header";
      for (const std::string& name : included(file)) {
        EXPECT_TRUE(name.starts_with("core/")) << file << " includes " << name;
      }
    }
  }
}

TEST(Rooms, AppIncludesCoreAndItself) {
  for (const fs::path& file : sources(root / "app")) {
    for (const std::string& name : included(file)) {
      EXPECT_TRUE(name.starts_with("core/") || name.starts_with("app/"))
          << file << " includes " << name;
    }
  }
}

TEST(Rooms, EmbreeStaysBehindOneDoor) {
  for (const char* folder : {"core", "integrators", "samplers", "shapes"}) {
    for (const fs::path& file : sources(root / folder)) {
      if (file.parent_path() == root / "core/scene" && file.stem() == "accel") continue;
      EXPECT_EQ(read(file).find("#include <embree"), std::string::npos) << file;
    }
  }
}

}  // namespace
