// Integrators and samplers by what they document of themselves.
#pragma once

#include <string>
#include <vector>

#include "app/stress/case.h"

namespace pssmlt::stress {

// True if the plugin answers to this parameter.
bool has_parameter(const std::string& kind, const std::string& plugin, const std::string& name);
// Settings for small pictures: few chains, few bootstrap samples, as far as the sampler has them.
std::vector<std::string> small_settings(const Pair& pair, int bootstrap = 8192);
// Plugins that fail on purpose (folder stress/ of the plugins), which generated scenes name, are
// found from here on.
void add_faulty_plugins();
// "all", or names separated by commas; in the registry's order. Throws Error, with a suggestion,
// for names that are not there.
std::vector<std::string> chosen_plugins(const std::string& kind, const std::string& text);

}  // namespace pssmlt::stress
