#include "app/stress/technique.h"

#include <algorithm>

#include "app/compare/text.h"
#include "core/plugin/registry.h"
#include "core/scene/suggest.h"

namespace pssmlt::stress {

bool has_parameter(const std::string& kind, const std::string& plugin, const std::string& name) {
  const FoundPlugin found = Registry::instance().find(kind, plugin, {});
  return std::ranges::any_of(describe(*found.descriptor),
                             [&](const ParameterDoc& doc) { return doc.name == name; });
}

std::vector<std::string> small_settings(const Pair& pair, int bootstrap) {
  std::vector<std::string> set;
  if (pair.sampler.empty()) return set;
  for (const auto& [name, value] :
       {std::pair("bootstrapsamples", std::to_string(bootstrap)),
        std::pair("chains", std::string(bootstrap < 1024 ? "32" : "64"))}) {
    if (has_parameter("sampler", pair.sampler, name)) {
      set.push_back("sampler." + std::string(name) + "=" + value);
    }
  }
  return set;
}

void add_faulty_plugins() { Registry::instance().add_subfolder("stress"); }

std::vector<std::string> chosen_plugins(const std::string& kind, const std::string& text) {
  const std::vector<std::string> known = Registry::instance().names(kind);
  if (text == "all") return known;
  std::vector<std::string> chosen;
  for (const std::string& part : compare::split(text, ',')) {
    const std::string name = compare::trimmed(part);
    if (std::ranges::find(known, name) == known.end()) {
      throw Error("there is no " + kind + " \"" + name + "\"" + suggestion(name, known) +
                  "; there are: " + compare::join(known, ", "));
    }
    if (std::ranges::find(chosen, name) == chosen.end()) chosen.push_back(name);
  }
  return chosen;
}

}  // namespace pssmlt::stress
