// Parameters as if they were written in a scene's text.
#pragma once

#include "core/scene/parameters.h"

namespace pssmlt::gltf {

class ParameterWriter {
 public:
  explicit ParameterWriter(Location where) : where_(std::move(where)) {}

  ParameterWriter& number(const char* name, double value) {
    add(ParameterType::Float, name).floats = {static_cast<float>(value)};
    return *this;
  }
  ParameterWriter& integer(const char* name, int value) {
    add(ParameterType::Integer, name).ints = {value};
    return *this;
  }
  ParameterWriter& flag(const char* name, bool value) {
    add(ParameterType::Bool, name).bools = {static_cast<uint8_t>(value)};
    return *this;
  }
  ParameterWriter& text(const char* name, std::string value) {
    add(ParameterType::String, name).strings = {std::move(value)};
    return *this;
  }
  ParameterWriter& texture(const char* name, std::string value) {
    add(ParameterType::Texture, name).strings = {std::move(value)};
    return *this;
  }
  ParameterWriter& rgb(const char* name, const vec3& value) {
    return floats(ParameterType::Rgb, name, {value.x, value.y, value.z});
  }
  ParameterWriter& point(const char* name, const vec3& value) {
    return floats(ParameterType::Point3, name, {value.x, value.y, value.z});
  }
  ParameterWriter& floats(ParameterType type, const char* name, std::vector<float> values) {
    add(type, name).floats = std::move(values);
    return *this;
  }
  ParameterWriter& integers(const char* name, std::vector<int> values) {
    add(ParameterType::Integer, name).ints = std::move(values);
    return *this;
  }
  ParameterSet take() { return std::move(set_); }

 private:
  Parameter& add(ParameterType type, const char* name) {
    // glTF's colours are linear Rec.709.
    static const auto space = std::make_shared<const std::string>("srgb");
    Parameter p{};
    p.type = type;
    p.name = name;
    p.where = where_;
    p.color_space = space;
    set_.push_back(std::move(p));
    return set_.back();
  }
  Location where_;
  ParameterSet set_;
};

}  // namespace pssmlt::gltf
