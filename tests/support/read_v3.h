// Reads scenes in pbrt-v3's format from text.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/dialect/pbrt_v3.h"
#include "core/scene/parser.h"

namespace pssmlt::test {

inline SceneDescription read_v3(const std::string& text, std::vector<std::string>* log = nullptr,
                                const std::string& directory = "") {
  return parse_string(text, "old", directory, log, {.dialect = &pbrt_v3()});
}
// `world`: what stands after WorldBegin.
inline SceneDescription world_v3(const std::string& world,
                                 std::vector<std::string>* log = nullptr) {
  return read_v3("WorldBegin\n" + world + "\nWorldEnd\n", log);
}

inline const Parameter* parameter(const Directive& d, std::string_view name) {
  const auto found = std::ranges::find(d.parameters, name, &Parameter::name);
  return found == d.parameters.end() ? nullptr : &*found;
}
inline float number(const Directive& d, std::string_view name) {
  const Parameter* const p = parameter(d, name);
  if (p == nullptr || p->floats.size() != 1) throw std::out_of_range(std::string(name));
  return p->floats[0];
}
inline std::string text(const Directive& d, std::string_view name) {
  const Parameter* const p = parameter(d, name);
  if (p == nullptr || p->strings.empty()) throw std::out_of_range(std::string(name));
  return p->strings[0];
}
inline std::vector<float> numbers(const Directive& d, std::string_view name) {
  const Parameter* const p = parameter(d, name);
  return p == nullptr ? std::vector<float>() : p->floats;
}

// What reading the scene complains of; "" if it does not.
inline std::string complaint(const std::string& world) {
  try {
    world_v3(world);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace pssmlt::test
