#include "tests/vocabulary/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <stdexcept>

#include "app/defaults.h"
#include "core/image/image.h"
#include "core/plugin/registry.h"
#include "core/scene/parser.h"
#include "tests/support/measured_files.h"

namespace pssmlt::test {
namespace {

namespace fs = std::filesystem;

// What parameters may refer to.
constexpr const char* declarations =
    "Texture \"bumps\" \"float\" \"constant\"\n"
    "Texture \"colours\" \"spectrum\" \"constant\" \"rgb value\" [.5 .5 .5]\n"
    "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
    "MakeNamedMaterial \"b\" \"string type\" \"conductor\"\n";

Word parse_header(const std::string& line, int number) {
  const size_t end = line.find(']');
  if (end == std::string::npos) throw std::runtime_error(fmt::format("line {}: no ]", number));
  std::vector<std::string> names;
  std::string name;
  for (const char c : line.substr(1, end - 1) + " ") {
    if (c != ' ')
      name += c;
    else if (!name.empty())
      names.push_back(std::exchange(name, ""));
  }
  Word word;
  word.line = number;
  word.kind = names.at(0);
  if (word.kind == "texture") word.form = names.at(1);
  word.plugin = names.back();
  word.needed = end + 2 < line.size() ? line.substr(end + 2) : "";
  return word;
}

std::string name_of(const std::string& parameter) {
  const size_t space = parameter.find(' ');
  return parameter.substr(space + 1, parameter.find('"', 1) - space - 1);
}

// A list of parameters, cut into one declaration with its values each.
std::vector<std::string> declarations_of(const std::string& list) {
  std::vector<std::string> parts;
  bool quoted = false;
  for (size_t i = 0; i < list.size(); ++i) {
    if (list[i] == '"') quoted = !quoted;
    // A declaration is the only string with a blank inside.
    const size_t end = list.find('"', i + 1), blank = list.find(' ', i + 1);
    if (list[i] == '"' && quoted && blank < end) parts.emplace_back();
    if (!parts.empty()) parts.back() += list[i];
  }
  return parts;
}

// The needed parameters but for those that the tried ones replace.
std::string with_parameter(const Word& word) {
  std::string text = word.parameter;
  const std::vector<std::string> tried = declarations_of(word.parameter);
  for (const std::string& needed : declarations_of(word.needed)) {
    const bool replaced = std::ranges::any_of(
        tried, [&](const std::string& p) { return name_of(p) == name_of(needed); });
    if (!replaced) text += " " + needed;
  }
  return text;
}

std::string scene_of(const Word& w) {
  const std::string rest = " \"" + w.plugin + "\" " + with_parameter(w) + "\n";
  const std::string world = std::string("WorldBegin\n") + declarations;
  const std::string sphere = "Shape \"sphere\"\n";
  if (w.kind == "directive" || w.kind == "type")
    return w.needed.find("WorldBegin") == std::string::npos ? w.needed + "\nWorldBegin" : w.needed;
  if (w.kind == "option") return "Option " + w.parameter + "\nWorldBegin";
  static const std::map<std::string, std::string> before = {
      {"camera", "Camera"},      {"sampler", "Sampler"},       {"film", "Film"},
      {"filter", "PixelFilter"}, {"integrator", "Integrator"}, {"accelerator", "Accelerator"}};
  if (const auto found = before.find(w.kind); found != before.end())
    return found->second + rest + world + sphere;
  if (w.kind == "shape") return world + "Shape" + rest;
  if (w.kind == "light") return world + "LightSource" + rest;
  if (w.kind == "arealight") return world + "AreaLightSource" + rest + sphere;
  if (w.kind == "material") return world + "Material" + rest + sphere;
  if (w.kind == "medium")
    return world + "MakeNamedMedium \"m\" \"string type\"" + rest +
           "MediumInterface \"m\" \"\" Material \"interface\" " + sphere;
  const bool number = w.form == "float";
  return world + "Texture \"t\" \"" + w.form + "\"" + rest + "Material " +
         (number ? "\"conductor\" \"texture roughness\"" : "\"diffuse\" \"texture reflectance\"") +
         " \"t\" " + sphere;
}

// The first line of an error, without its place.
std::string first_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  constexpr std::string_view file = "scene:";
  if (!text.starts_with(file)) return text;
  for (int colons = 0; colons < 3; ++colons) text = text.substr(text.find(':') + 1);
  return text.substr(1);
}

// True if the plugin's own manual says that it only reads the parameter.
bool has_no_effect(const Word& w) {
  if (w.parameter.empty()) return false;
  try {
    const FoundPlugin found = Registry::instance().find(w.kind, w.plugin, {});
    for (const ParameterDoc& doc : describe(*found.descriptor)) {
      if (doc.name != name_of(w.parameter)) continue;
      for (const char* words : {"ithout effect", "not supported", "accepted for", "read as"})
        if (doc.doc.find(words) != std::string::npos) return true;
    }
  } catch (const Error&) {
    // No plugin of its own: films, options.
  }
  return false;
}

std::vector<std::string> load(const std::string& text, const fs::path& folder) {
  std::vector<std::string> log;
  const SceneDescription scene = parse_string(text, "scene", folder.string(), &log);
  BuildOptions options;
  options.defaults = default_plugins();
  const BuiltScene built = build_scene(scene, options);
  for (const std::string& line : built.log) log.push_back(first_line(line));
  return log;
}

// A line that is there because of the word.
std::string new_line(const std::vector<std::string>& log, const std::vector<std::string>& usual) {
  for (const std::string& line : log) {
    if (line.find("the scene has no ") != std::string::npos) continue;
    if (std::ranges::find(usual, line) == usual.end()) return line;
  }
  return "";
}

bool says_ignored(const std::string& note) {
  for (const char* words : {"no effect", "not used", "not applied", "does not apply"})
    if (note.find(words) != std::string::npos) return true;
  return false;
}

std::string cell(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

std::string percent(size_t part, size_t all) {
  return fmt::format("{} of {} ({:.1f} %)", part, all,
                     all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

}  // namespace

std::vector<Word> read_words(const fs::path& table) {
  std::ifstream in(table);
  if (!in) throw std::runtime_error("no table " + table.string());
  std::vector<Word> words;
  Word section;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    if (line.starts_with('[')) {
      section = parse_header(line, number);
      if (section.kind != "option") words.push_back(section);
      continue;
    }
    Word word = section;
    word.parameter = line;
    word.line = number;
    words.push_back(word);
  }
  return words;
}

Fate try_word(const Word& word, const fs::path& folder) {
  Fate fate;
  try {
    std::vector<std::string> usual;
    if (!word.parameter.empty() && word.kind != "option") {
      Word bare = word;
      bare.parameter.clear();
      usual = load(scene_of(bare), folder);
    }
    fate.message = new_line(load(scene_of(word), folder), usual);
    const bool plugin_ignored = std::ranges::any_of(usual, says_ignored);
    if (has_no_effect(word) || says_ignored(fate.message) || plugin_ignored)
      fate.kind = Fate::without_effect;
  } catch (const std::exception& failure) {
    fate.kind = Fate::refused;
    fate.message = first_line(failure.what());
    fate.located = std::string(failure.what()).starts_with("scene:");
    // Messages do not depend on where the test ran.
    for (size_t at; (at = fate.message.find(folder.string() + "/")) != std::string::npos;)
      fate.message.erase(at, folder.string().size() + 1);
  }
  return fate;
}

void make_files(const fs::path& folder) {
  const fs::path given = fs::path(PSSMLT_SOURCE_DIR) / "tests/vocabulary/files";
  if (fs::exists(given)) fs::copy(given, folder, fs::copy_options::recursive);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write("part.txt", "Shape \"sphere\"\n");
  write("light.spd", "400 1\n700 1\n");
  write("mesh.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  // One lens, of a diameter of 10 mm, and a stop: curvature, thickness, index, aperture.
  write("lens.dat", "20 2 1.5 10\n-20 1 1 10\n0 30 1 8\n");
  write_bytes((folder / "material.bsdf").string(),
              tensor_file([](const vec3&, const vec3&) { return Rgb(.2f); }, {.size = 8}).bytes());
  Image image(4, 4, 3);
  std::ranges::fill(image.data, 0.5f);
  write_image((folder / "image.pfm").string(), image, {}, {});
}

std::string page(const std::vector<Word>& words, const std::vector<Fate>& fates) {
  const auto count = [&](const std::string& kind, Fate::Kind fate) {
    size_t n = 0;
    for (size_t i = 0; i < words.size(); ++i)
      n += fates[i].kind == fate && (kind.empty() || words[i].kind == kind);
    return n;
  };
  std::string text =
      "# Vocabulary of pbrt-v4\n\n"
      "Every directive, plugin and parameter of the reference of [pbrt-v4's\n"
      "format](https://pbrt.org/fileformat-v4), and what this program does with it. Made by "
      "loading a\n"
      "minimal scene for each (`PSSMLT_WRITE_VOCABULARY=1 build/bin/test_vocabulary`); a test\n"
      "holds the page against the program.\n\n";
  text += "- used: " + percent(count("", Fate::supported), words.size()) + "\n";
  text +=
      "- read, without effect: " + percent(count("", Fate::without_effect), words.size()) + "\n";
  text += "- refused, with the message given: " + percent(count("", Fate::refused), words.size()) +
          "\n\n| kind | words | used | read only | refused |\n|---|---|---|---|---|\n";
  std::vector<std::string> kinds;
  for (const Word& w : words)
    if (std::ranges::find(kinds, w.kind) == kinds.end()) kinds.push_back(w.kind);
  for (const std::string& kind : kinds) {
    const size_t used = count(kind, Fate::supported), read = count(kind, Fate::without_effect),
                 refused = count(kind, Fate::refused);
    text += fmt::format("| {} | {} | {} | {} | {} |\n", kind, used + read + refused, used, read,
                        refused);
  }
  constexpr std::array<const char*, 3> names = {"used", "read only", "**refused**"};
  for (const std::string& kind : kinds) {
    text += "\n## " + kind + "\n\n| word | | message or note |\n|---|---|---|\n";
    for (size_t i = 0; i < words.size(); ++i) {
      if (words[i].kind != kind) continue;
      const bool bare = words[i].parameter.empty();
      const std::string name =
          bare
              ? "**" + words[i].plugin + "**"
              : "`" + cell(words[i].parameter.substr(1, words[i].parameter.find('"', 1) - 1)) + "`";
      text += fmt::format("| {}{} | {} | {} |\n", name,
                          bare && !words[i].form.empty() ? " (" + words[i].form + ")" : "",
                          names[fates[i].kind], cell(fates[i].message));
    }
  }
  return text;
}

}  // namespace pssmlt::test
