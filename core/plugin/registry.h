// Finds, loads and makes plugins by kind and name: `<plugin path>/<kind>/<name>.so`, loaded when a
// scene first names it. The search path is $PSSMLT_PLUGIN_PATH (colon separated), then the folder
// beside the library.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/plugin/plugin.h"
#include "core/plugin/plugin_name.h"

namespace pssmlt {

// A plugin that has been found, and how the name that was asked for led to it.
struct FoundPlugin {
  const PluginDescriptor* descriptor = nullptr;
  std::string alias;    // the name asked for, if it is an alias; else ""
  std::string sampler;  // sampler that the alias implies, or ""
  std::string file;     // of the shared object
};

class Registry {
 public:
  static Registry& instance();
  // kind: folder name ("integrator", "sampler", "shape", "light", "arealight", "camera",
  // "material", "texture", "filter", ...). Throws Error at `where`: unknown name (with a
  // suggestion), or an ABI that does not fit.
  FoundPlugin find(const std::string& kind, const std::string& name, const Location& where);
  // Names of all plugins of a kind on the path, sorted; loads nothing.
  std::vector<std::string> names(const std::string& kind) const;
  // All kinds with at least one plugin, sorted.
  std::vector<std::string> kinds() const;
  // Files loaded so far (checkpoints hash them).
  std::vector<std::string> loaded() const;
  // Puts a folder in front of the search path.
  void add_path(const std::string& folder);
  // Puts this folder of the plugins beside the library at the end of the search path.
  void add_subfolder(const std::string& name);
  // Loads a module (modules/NAME.so: image input/output, display transforms) and returns a symbol.
  void* module(const std::string& name, const std::string& symbol);

 private:
  Registry();
  const PluginDescriptor* load(const std::string& file, const Location& where);
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

// Makes a plugin of class Kind from its parameters and checks that all of them were read.
template <typename Kind>
std::shared_ptr<Kind> make_plugin(const FoundPlugin& found, Parameters& parameters,
                                  const PluginArguments& arguments = {}) {
  std::shared_ptr<Kind> made(static_cast<Kind*>(found.descriptor->create(parameters, arguments)));
  parameters.check_all_read();
  if constexpr (std::is_base_of_v<PluginNamed, Kind>)
    made->name_plugin(found.descriptor->kind, found.descriptor->name);
  return made;
}

// Parameters of a plugin as its constructor documents them.
std::vector<ParameterDoc> describe(const PluginDescriptor& descriptor);

}  // namespace pssmlt
