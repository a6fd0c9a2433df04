#include "core/plugin/plugin_name.h"

#include <cctype>

namespace pssmlt {

std::string PluginNamed::plugin_name() const {
  if (name_ == nullptr) return "unnamed";
  std::string text;
  // "AreaLight" is an area light.
  for (const char* c = kind_; *c != '\0'; ++c) {
    const auto letter = static_cast<unsigned char>(*c);
    if (std::isupper(letter) != 0 && !text.empty()) text += ' ';
    text += static_cast<char>(std::tolower(letter));
  }
  return text + " \"" + name_ + "\"";
}

}  // namespace pssmlt
