#include "tests/vocabulary/word_text.h"

#include <algorithm>
#include <map>

namespace pssmlt::test {
namespace {

const std::map<std::string, std::string> option_directives = {
    {"camera", "Camera"},      {"sampler", "Sampler"},       {"film", "Film"},
    {"filter", "PixelFilter"}, {"integrator", "Integrator"}, {"accelerator", "Accelerator"},
    {"option", "Option"}};
const std::map<std::string, std::string> world_directives = {{"shape", "Shape"},
                                                             {"light", "LightSource"},
                                                             {"arealight", "AreaLightSource"},
                                                             {"material", "Material"}};

}  // namespace

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

std::string declaration_of(const Word& word) {
  const std::string& p = word.parameter;
  return p.empty() ? "itself" : p.substr(1, p.find('"', 1) - 1);
}

std::string name_of(const std::string& declaration) {
  const size_t space = declaration.find(' ');
  return declaration.substr(space + 1, declaration.find('"', 1) - space - 1);
}

std::string with_needed(const Word& word, const std::string& parameters) {
  std::string text = parameters;
  const std::vector<std::string> given = declarations_of(parameters);
  for (const std::string& needed : declarations_of(word.needed)) {
    const bool replaced = std::ranges::any_of(
        given, [&](const std::string& p) { return name_of(p) == name_of(needed); });
    if (!replaced) text += " " + needed;
  }
  return text;
}

std::string directive_of(const Word& word, const std::string& parameters) {
  const std::string all = with_needed(word, parameters);
  const std::string rest = " \"" + word.plugin + "\" " + all + "\n";
  if (word.kind == "option") return "Option " + parameters + "\n";
  if (word.kind == "texture") return "Texture \"t\" \"" + word.form + "\"" + rest;
  if (word.kind == "medium")
    return "MakeNamedMedium \"m\" \"string type\"" + rest + "MediumInterface \"m\" \"\"\n";
  const auto& directives = is_option(word) ? option_directives : world_directives;
  return directives.at(word.kind) + rest;
}

bool is_option(const Word& word) { return option_directives.contains(word.kind); }

}  // namespace pssmlt::test
