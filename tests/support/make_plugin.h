// Makes materials and textures for tests without a scene file.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/material.h"
#include "core/plugin/registry.h"

namespace pssmlt::test {

inline Parameter named(ParameterType type, const std::string& name) {
  Parameter p;
  p.type = type;
  p.name = name;
  static const auto file = std::make_shared<const std::string>("test-scene");
  p.where = {file, 7, 3};
  static const auto space = std::make_shared<const std::string>("srgb");
  p.color_space = space;
  return p;
}
inline Parameter floats(ParameterType type, const std::string& name, std::vector<float> values) {
  Parameter p = named(type, name);
  p.floats = std::move(values);
  return p;
}
inline Parameter number(const std::string& name, float value) {
  return floats(ParameterType::Float, name, {value});
}
inline Parameter rgb(const std::string& name, float r, float g, float b) {
  return floats(ParameterType::Rgb, name, {r, g, b});
}
inline Parameter strings(ParameterType type, const std::string& name,
                         std::vector<std::string> values) {
  Parameter p = named(type, name);
  p.strings = std::move(values);
  return p;
}
inline Parameter text(const std::string& name, const std::string& value) {
  return strings(ParameterType::String, name, {value});
}
inline Parameter texture(const std::string& name, const std::string& value) {
  return strings(ParameterType::Texture, name, {value});
}
inline Parameter integer(const std::string& name, int value) {
  Parameter p = named(ParameterType::Integer, name);
  p.ints = {value};
  return p;
}
inline Parameter flag(const std::string& name, bool value) {
  Parameter p = named(ParameterType::Bool, name);
  p.bools = {value};
  return p;
}

// What the plugins under test may refer to by name.
class Resolver final : public SceneResolver {
 public:
  std::map<std::string, std::shared_ptr<const Texture<float>>> floats;
  std::map<std::string, std::shared_ptr<const Texture<Rgb>>> colours;
  std::map<std::string, std::shared_ptr<const Material>> materials;

  std::shared_ptr<const Texture<float>> float_texture(const std::string& name,
                                                      const Location&) override {
    return floats.at(name);
  }
  std::shared_ptr<const Texture<Rgb>> rgb_texture(const std::string& name,
                                                  const Location&) override {
    return colours.at(name);
  }
  std::string resolve_path(const std::string& name) const override { return name; }
  std::shared_ptr<const Material> material(const std::string& name, const Location&) override {
    return materials.at(name);
  }
};

inline std::shared_ptr<const Material> make_material(const std::string& type,
                                                     const ParameterSet& set = {},
                                                     Resolver* resolver = nullptr) {
  static Resolver none;
  const FoundPlugin found = Registry::instance().find("material", type, {});
  Parameters p(set, {}, "material \"" + type + "\"", resolver ? resolver : &none);
  return make_plugin<Material>(found, p);
}

template <typename T>
std::shared_ptr<const Texture<T>> make_texture(const std::string& type,
                                               const ParameterSet& set = {},
                                               Resolver* resolver = nullptr,
                                               const Transform& transform = {}) {
  static Resolver none;
  const FoundPlugin found = Registry::instance().find("texture", type, {});
  Parameters p(set, {}, "texture \"" + type + "\"", resolver ? resolver : &none);
  p.set_transform(transform);
  const auto create =
      std::is_same_v<T, float> ? found.descriptor->create : found.descriptor->create_rgb;
  std::shared_ptr<const Texture<T>> made(static_cast<Texture<T>*>(create(p, {})));
  p.check_all_read();
  return made;
}

// The message of the Error that `what` throws; "" if it throws none.
template <typename F>
std::string error_of(F&& what) {
  try {
    what();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace pssmlt::test
