#include "tests/vocabulary/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "app/defaults.h"
#include "core/image/image.h"
#include "core/scene/parser.h"
#include "tests/support/measured_files.h"
#include "tests/vocabulary/stage.h"

namespace pssmlt::test {
namespace {

namespace fs = std::filesystem;

// Takes what follows the mark off the text's end; "" if there is no mark.
std::string take_after(std::string& text, const std::string& mark) {
  const size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  std::string rest = text.substr(at + mark.size());
  text.resize(at);
  return rest;
}

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
  word.needed = end + 2 < line.size() ? line.substr(end + 1) : "";
  word.stage = take_after(word.needed, " on ");
  word.base = take_after(word.needed, " vs ");
  if (!word.needed.empty()) word.needed.erase(0, 1);  // the blank after ]
  return word;
}

// The first line of an error, without its place.
std::string first_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  constexpr std::string_view file = "scene:";
  if (!text.starts_with(file)) return text;
  for (int colons = 0; colons < 3; ++colons) text = text.substr(text.find(':') + 1);
  return text.substr(1);
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
    word.stage = take_after(word.parameter, " on ");
    word.base = take_after(word.parameter, " vs only ");
    word.base_alone = !word.base.empty();
    if (!word.base_alone) word.base = take_after(word.parameter, " vs ");
    word.line = number;
    words.push_back(word);
  }
  return words;
}

Fate try_word(const Word& word, const fs::path& folder) {
  Fate fate;
  const StagedScenes scenes = staged(word);
  std::vector<std::string> log;
  try {
    log = load(scenes.with, folder);
  } catch (const std::exception& failure) {
    fate.refused = true;
    fate.message = first_line(failure.what());
    fate.located = std::string(failure.what()).starts_with("scene:");
    // Messages do not depend on where the test ran.
    for (size_t at; (at = fate.message.find(folder.string() + "/")) != std::string::npos;)
      fate.message.erase(at, folder.string().size() + 1);
  }
  if (!fate.refused) fate.message = new_line(log, load(scenes.without, folder));
  return fate;
}

void make_files(const fs::path& folder) {
  const fs::path given = fs::path(PSSMLT_SOURCE_DIR) / "tests/vocabulary/files";
  if (fs::exists(given)) fs::copy(given, folder, fs::copy_options::recursive);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write("part.txt", "Shape \"sphere\"\n");
  write("light.spd", "400 .2\n550 .5\n700 2\n");
  const auto triangle = [&](const char* name, const char* corner) {
    write(name,
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nproperty float u\nproperty float v\nelement face 1\n"
          "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n" +
              std::string(corner) + " 0 1\n3 0 1 2\n");
  };
  triangle("mesh.ply", "0 1 0");
  triangle("other.ply", "1 2 0");
  // One lens, of a diameter of 10 mm, and a stop: curvature, thickness, index, aperture. Its focus
  // is near the film, or it is not.
  write("lens.dat", "20 2 1.5 10\n-20 1 1 10\n0 30 1 8\n");
  write("other.dat", "30 2 1.5 10\n-30 1 1 10\n0 30 1 8\n");
  const auto measured = [&](const char* name, float value) {
    write_bytes(
        (folder / name).string(),
        tensor_file([=](const vec3&, const vec3&) { return Rgb(value); }, {.size = 8}).bytes());
  };
  measured("material.bsdf", .2f);
  measured("other.bsdf", .1f);
  Image image(4, 4, 3);
  for (size_t i = 0; i < image.data.size(); ++i)  // 48 values from 0.2 to 0.9, in no order
    image.data[i] = .2f + .7f * static_cast<float>(i * 29 % 48) / 47.f;
  for (const char* name : {"image.pfm", "image.png"})
    write_image((folder / name).string(), image, {}, {});
  std::ranges::reverse(image.data);
  write_image((folder / "other.pfm").string(), image, {}, {});
}

}  // namespace pssmlt::test
