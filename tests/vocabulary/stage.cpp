#include "tests/vocabulary/stage.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/vocabulary/word_text.h"

namespace pssmlt::test {
namespace {

namespace fs = std::filesystem;

const fs::path stages = fs::path(PSSMLT_SOURCE_DIR) / "tests/vocabulary/stages";

std::string read_stage(const std::string& name) {
  std::ifstream in(stages / (name + ".txt"));
  if (!in) throw std::runtime_error("no stage " + name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string stage_of(const Word& word) {
  if (!word.stage.empty()) return word.stage;
  if (word.kind == "type") return "directive";
  if (fs::exists(stages / (word.kind + ".txt")))
    return word.kind == "texture" && word.form == "float" ? "texture-float" : word.kind;
  return "room";
}

// What a scene says before WorldBegin and after it.
struct Parts {
  std::string options, world;
};

Parts split(const std::string& text) {
  constexpr std::string_view begin = "WorldBegin";
  const size_t at = text.find(begin);
  if (at == std::string::npos) return {text, ""};
  return {text.substr(0, at), text.substr(at + begin.size())};
}

Parts parts_with(const Word& w) {
  if (w.kind == "directive" || w.kind == "type") return split(w.needed);
  const std::string text = directive_of(w, w.parameter);
  return is_option(w) ? Parts{text, ""} : Parts{"", text};
}

// The plugin without the parameter, but with all that stands beside it.
std::string parameters_without(const Word& w) {
  std::string text = w.base;
  const std::vector<std::string> all = declarations_of(w.parameter);
  for (size_t i = 1; i < all.size() && !w.base_alone; ++i) text += " " + all[i];
  return text;
}

std::string grey(const std::string& form) {
  return "Texture \"t\" \"" + form + "\" \"constant\" " +
         (form == "float" ? "\"float value\" .5" : "\"rgb value\" [.5 .5 .5]");
}

Parts parts_without(const Word& w) {
  if (w.kind == "directive" || w.kind == "type") return split(w.base);
  std::string text;
  if (w.parameter.empty())
    text = w.kind == "texture" && w.base.empty() ? grey(w.form) : w.base;
  else if (w.kind != "option")
    text = directive_of(w, parameters_without(w));
  else if (!w.base.empty())
    text = directive_of(w, w.base);
  return is_option(w) ? Parts{text, ""} : Parts{"", text};
}

// True if the stage's line gives what the options give themselves.
bool replaced(const std::string& line, const std::string& options) {
  for (const char* directive : {"Film", "PixelFilter", "Sampler", "Integrator", "Camera"}) {
    const std::string start = std::string(directive) + " \"";
    if (line.starts_with(start)) return options.find(start) != std::string::npos;
  }
  return false;
}

std::string fill(const std::string& stage, const Parts& parts) {
  std::istringstream lines(read_stage(stage));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line == "<declarations>") line = read_stage("declarations");
    if (line == "<options>") line = parts.options;
    if (line == "<word>" || line == "<world>") line = parts.world;
    if (!replaced(line, parts.options) || line == parts.options) text += line + "\n";
  }
  return text;
}

}  // namespace

StagedScenes staged(const Word& word) {
  const std::string stage = stage_of(word);
  return {.with = fill(stage, parts_with(word)), .without = fill(stage, parts_without(word))};
}

}  // namespace pssmlt::test
