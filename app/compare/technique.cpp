#include "app/compare/technique.h"

#include <algorithm>
#include <array>
#include <set>

#include "app/compare/text.h"
#include "app/defaults.h"
#include "core/plugin/registry.h"
#include "core/scene/suggest.h"

namespace pssmlt::compare {
namespace {

constexpr std::array<std::string_view, 2> kinds = {"integrator", "sampler"};

// Names of a kind and the other names they answer to.
std::vector<std::string> known_names(const std::string& kind) {
  Registry& registry = Registry::instance();
  std::vector<std::string> known;
  for (const std::string& name : registry.names(kind)) {
    known.push_back(name);
    const PluginDescriptor& d = *registry.find(kind, name, {}).descriptor;
    for (int i = 0; i < d.alias_count; ++i) known.emplace_back(d.aliases[i].name);
  }
  return known;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

[[noreturn]] void unknown(const std::string& text, std::string_view wrong, const std::string& what,
                          const std::vector<std::string>& known) {
  throw Error("technique \"" + text + "\": there is no " + what + " \"" + std::string(wrong) +
              "\"" + suggestion(wrong, known) + "; there are: " + join(known, ", "));
}

void check_plugin(const std::string& text, const std::string& kind, const std::string& name) {
  const std::vector<std::string> known = known_names(kind);
  if (!contains(known, name)) unknown(text, name, kind, known);
}

// A sampler that chooses the integrator needs no other word.
bool chooses_integrator(const std::string& name) {
  if (!contains(Registry::instance().names("sampler"), name)) return false;
  const FoundPlugin found = Registry::instance().find("sampler", name, {});
  const ParameterSet none;
  Parameters parameters(none, {}, "sampler \"" + name + "\"", nullptr);
  return make_plugin<Sampler>(found, parameters)->chooses_integrator();
}

Technique integrator_technique(const std::string& name) {
  if (chooses_integrator(name)) {
    return {.name = name, .integrator = {}, .sampler = name, .set = {}};
  }
  check_plugin(name, "integrator", name);
  Technique t{.name = name, .integrator = name, .sampler = {}, .set = {}};
  // An alias that implies a sampler brings it along.
  if (Registry::instance().find("integrator", name, {}).sampler.empty()) {
    t.sampler = default_plugins().sampler;
  }
  return t;
}

// The sampler that a name before parentheses stands for.
std::string sampler_of(const std::string& text, const std::string& name) {
  if (contains(known_names("sampler"), name)) return name;
  if (contains(known_names("integrator"), name)) {
    const std::string implied = Registry::instance().find("integrator", name, {}).sampler;
    if (!implied.empty()) return implied;
  }
  std::vector<std::string> known = known_names("sampler");
  for (const std::string& integrator : known_names("integrator")) {
    if (!Registry::instance().find("integrator", integrator, {}).sampler.empty()) {
      known.push_back(integrator);
    }
  }
  unknown(text, name, "sampler", known);
}

Technique short_technique(const std::string& text) {
  if (text == "scene") return {.name = text, .integrator = {}, .sampler = {}, .set = {}};
  const size_t open = text.find('(');
  if (open == std::string::npos) return integrator_technique(text);
  if (text.back() != ')' || open == 0) {
    throw Error("technique \"" + text + "\": must look like bdpt or pssmlt(path)");
  }
  Technique t{.name = text,
              .integrator = text.substr(open + 1, text.size() - open - 2),
              .sampler = sampler_of(text, text.substr(0, open)),
              .set = {}};
  check_plugin(text, "integrator", *t.integrator);
  return t;
}

// "sampler:pssmlt,sigma=0.02" into the technique.
void add_part(const std::string& text, const std::string& part, Technique& t) {
  const std::vector<std::string> items = split(part, ',');
  const size_t colon = items[0].find(':');
  const std::string kind = trimmed(items[0].substr(0, colon));
  if (colon == std::string::npos || std::ranges::find(kinds, kind) == kinds.end()) {
    throw Error("technique \"" + text + "\": \"" + part +
                "\" must begin with integrator:NAME or sampler:NAME");
  }
  const std::string name = trimmed(items[0].substr(colon + 1));
  std::optional<std::string>& chosen = kind == "integrator" ? t.integrator : t.sampler;
  if (chosen) throw Error("technique \"" + text + "\": two " + kind + "s");
  check_plugin(text, kind, name);
  chosen = name;
  for (size_t i = 1; i < items.size(); ++i) {
    const std::string item = trimmed(items[i]);
    const size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error("technique \"" + text + "\": \"" + item + "\" must look like maxdepth=8");
    }
    t.set.push_back(kind + "." + item);
  }
}

}  // namespace

Technique parse_technique(const std::string& given) {
  const std::string text = trimmed(given);
  const size_t equals = text.find('='), colon = text.find(':');
  if (text.empty()) throw Error("a technique's name is empty");
  if (colon == std::string::npos) return short_technique(text);
  if (equals == std::string::npos || equals > colon) {
    throw Error("technique \"" + text + "\": must begin with its name, as in mine=" + text);
  }
  Technique t;
  t.name = trimmed(text.substr(0, equals));
  if (t.name.empty()) throw Error("technique \"" + text + "\": its name is empty");
  for (const std::string& part : split(text.substr(equals + 1), ';')) {
    add_part(text, trimmed(part), t);
  }
  return t;
}

std::vector<Technique> parse_technique_list(const std::string& text) {
  std::vector<Technique> techniques;
  for (const std::string& name : split(text, ',')) techniques.push_back(parse_technique(name));
  return techniques;
}

std::vector<Technique> read_techniques(const std::string& file) {
  std::vector<Technique> techniques;
  for (const auto& [number, line] : read_lines(file)) {
    try {
      techniques.push_back(parse_technique(line));
    } catch (const Error& error) {
      throw Error(file + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (techniques.empty()) throw Error(file + ": there is no technique in it");
  return techniques;
}

void check_names_differ(const std::vector<Technique>& techniques) {
  std::set<std::string> names;
  for (const Technique& t : techniques) {
    if (!names.insert(t.name).second) {
      throw Error("two techniques are called \"" + t.name +
                  "\": give one another name, as in other=" + "integrator:" +
                  t.integrator.value_or("path"));
    }
  }
}

BuildOptions options_for(const Technique& technique, const BuildOptions& base) {
  BuildOptions options = base;
  options.integrator = technique.integrator;
  options.sampler = technique.sampler;
  options.set.insert(options.set.end(), technique.set.begin(), technique.set.end());
  return options;
}

}  // namespace pssmlt::compare
