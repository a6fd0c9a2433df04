// What is compared: integrators under samplers with parameters, by a short name, in full or from a
// file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/builder.h"

namespace pssmlt::compare {

struct Technique {
  std::string name;
  std::optional<std::string> integrator, sampler;  // nullopt: the scene's own
  std::vector<std::string> set;                    // "integrator.maxdepth=8", as --set takes them
};

// A short name:
//   INTEGRATOR            under the default sampler ("path", "bdpt", guests' too), or under the one
//                         that an alias implies ("mlt")
//   SAMPLER(INTEGRATOR)   "pssmlt(path)"; an alias stands for the sampler that it implies:
//   "mlt(path)" scene                 as the scene file says
// or in full, each part optional but one:
//   NAME=integrator:bdpt,maxdepth=8;sampler:pssmlt,sigma=0.02
// Plugins are looked up in the registry. Throws Error, with a suggestion for unknown names.
Technique parse_technique(const std::string& text);

// Comma-separated short names.
std::vector<Technique> parse_technique_list(const std::string& text);

// One technique a line in either form; "#" begins a comment. Throws Error with file and line.
std::vector<Technique> read_techniques(const std::string& file);

// Throws Error if two have the same name.
void check_names_differ(const std::vector<Technique>& techniques);

// `base` with the technique's plugins and parameters.
BuildOptions options_for(const Technique& technique, const BuildOptions& base);

}  // namespace pssmlt::compare
