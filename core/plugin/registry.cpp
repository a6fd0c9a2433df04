#include "core/plugin/registry.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <sstream>

#include "core/camera.h"
#include "core/filter.h"
#include "core/integrator.h"
#include "core/light.h"
#include "core/material.h"
#include "core/sampler.h"
#include "core/scene/suggest.h"
#include "core/shape.h"

namespace pssmlt {
namespace fs = std::filesystem;

struct Registry::Impl {
  std::vector<std::string> path;
  std::map<std::string, const PluginDescriptor*> loaded;  // by file
  std::mutex mutex;
};

namespace {

// Where this library lies: plugins are beside it, in the build tree as when installed.
std::string own_plugin_folder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<void*>(&own_plugin_folder), &info) == 0 || !info.dli_fname) return "";
  std::error_code ignored;
  const fs::path file = fs::canonical(info.dli_fname, ignored);
  return (file.parent_path() / "pssmlt").string();
}

bool is_plugin_file(const fs::path& file) { return file.extension() == ".so"; }

// A name from a scene must stay inside its kind's folder.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.find('/') == std::string::npos && name[0] != '.';
}

}  // namespace

Registry& Registry::instance() {
  static Registry registry;
  return registry;
}

Registry::Registry() : impl_(std::make_shared<Impl>()) {
  if (const char* variable = std::getenv("PSSMLT_PLUGIN_PATH")) {
    std::istringstream folders(variable);
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (!folder.empty()) impl_->path.push_back(folder);
    }
  }
  impl_->path.push_back(own_plugin_folder());
}

void Registry::add_path(const std::string& folder) {
  impl_->path.insert(impl_->path.begin(), folder);
}

void Registry::add_subfolder(const std::string& name) {
  impl_->path.push_back(own_plugin_folder() + "/" + name);
}

const PluginDescriptor* Registry::load(const std::string& file, const Location& where) {
  const std::lock_guard lock(impl_->mutex);
  if (const auto found = impl_->loaded.find(file); found != impl_->loaded.end()) {
    return found->second;
  }
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw Error(where, "cannot load plugin " + file + ": " + dlerror());
  const void* const symbol = dlsym(handle, "pssmlt_plugin_descriptor");
  if (!symbol) throw Error(where, file + " is not a pssmlt plugin (no descriptor)");
  const auto* const descriptor = static_cast<const PluginDescriptor*>(symbol);
  // The number comes first in the descriptor, so that it can be read whatever the rest looks like.
  if (descriptor->abi != abi_version) {
    throw Error(where, file + " was built for plugin interface " + std::to_string(descriptor->abi) +
                           ", this program has " + std::to_string(abi_version) +
                           ": rebuild the plugin");
  }
  if (std::string_view(descriptor->compiler) != __VERSION__) {
    throw Error(where, file + " was built with compiler " + descriptor->compiler +
                           ", this program with " + __VERSION__ + ": rebuild the plugin");
  }
  impl_->loaded[file] = descriptor;
  return descriptor;
}

FoundPlugin Registry::find(const std::string& kind, const std::string& name,
                           const Location& where) {
  if (!is_plain_name(name)) throw Error(where, "'" + name + "' is not a name of a " + kind);
  for (const std::string& folder : impl_->path) {
    const std::string file = folder + "/" + kind + "/" + name + ".so";
    std::error_code ignored;
    if (fs::exists(file, ignored)) return {load(file, where), "", "", file};
  }
  // Rare: an alias, declared inside a plugin of another name.
  const std::vector<std::string> known = names(kind);
  for (const std::string& other : known) {
    FoundPlugin candidate = find(kind, other, where);
    for (int i = 0; i < candidate.descriptor->alias_count; ++i) {
      const PluginAlias& alias = candidate.descriptor->aliases[i];
      if (name != alias.name) continue;
      candidate.alias = name;
      candidate.sampler = alias.sampler;
      return candidate;
    }
  }
  throw Error(where,
              kind + " \"" + name + "\" is unknown or not supported yet" + suggestion(name, known));
}

std::vector<std::string> Registry::names(const std::string& kind) const {
  std::set<std::string> found;
  for (const std::string& folder : impl_->path) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / kind, ignored)) {
      if (is_plugin_file(entry.path())) found.insert(entry.path().stem().string());
    }
  }
  return {found.begin(), found.end()};
}

std::vector<std::string> Registry::kinds() const {
  std::set<std::string> found;
  for (const std::string& folder : impl_->path) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      const std::string kind = entry.path().filename().string();
      if (entry.is_directory(ignored) && kind != "module" && !names(kind).empty()) {
        found.insert(kind);
      }
    }
  }
  return {found.begin(), found.end()};
}

std::vector<std::string> Registry::loaded() const {
  const std::lock_guard lock(impl_->mutex);
  std::vector<std::string> files;
  for (const auto& [file, descriptor] : impl_->loaded) files.push_back(file);
  return files;
}

void* Registry::module(const std::string& name, const std::string& symbol) {
  for (const std::string& folder : impl_->path) {
    const std::string file = folder + "/module/" + name + ".so";
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw Failure("cannot load module " + file + ": " + dlerror());
    void* const found = dlsym(handle, symbol.c_str());
    if (!found) throw Failure("module " + file + " has no function " + symbol);
    return found;
  }
  throw Failure("module " + name + " is not installed");
}

std::vector<ParameterDoc> describe(const PluginDescriptor& descriptor) {
  std::vector<ParameterDoc> docs;
  Parameters parameters = Parameters::describing(docs);
  const RasterFrame frame;
  PluginArguments arguments;
  arguments.frame = &frame;
  const std::string kind = descriptor.kind;
  const bool has_create = descriptor.create != nullptr;
  void* const made =
      (has_create ? descriptor.create : descriptor.create_rgb)(parameters, arguments);
  if (kind == "Integrator") delete static_cast<Integrator*>(made);
  if (kind == "Sampler") delete static_cast<Sampler*>(made);
  if (kind == "Shape") delete static_cast<Shape*>(made);
  if (kind == "Light" || kind == "AreaLight") delete static_cast<Light*>(made);
  if (kind == "Camera") delete static_cast<Camera*>(made);
  if (kind == "Material") delete static_cast<Material*>(made);
  if (kind == "Filter") delete static_cast<Filter*>(made);
  if (kind == "Texture" && has_create) delete static_cast<Texture<float>*>(made);
  if (kind == "Texture" && !has_create) delete static_cast<Texture<Rgb>*>(made);
  return docs;
}

}  // namespace pssmlt
