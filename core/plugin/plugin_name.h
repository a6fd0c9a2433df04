// Which plugin an object came from, for messages.
#pragma once

#include <string>

namespace pssmlt {

// Base of the kinds whose objects messages name.
class PluginNamed {
 public:
  // Told by the registry; `kind` and `name` are the descriptor's and live as long as it does.
  void name_plugin(const char* kind, const char* name) { kind_ = kind, name_ = name; }
  // `material "diffuse"`; "unnamed" if the registry did not make it.
  std::string plugin_name() const;
  // Goes by another's name: it stands for it.
  void take_name(const PluginNamed& other) { *this = other; }

 protected:
  ~PluginNamed() = default;

 private:
  const char* kind_ = nullptr;
  const char* name_ = nullptr;
};

}  // namespace pssmlt
