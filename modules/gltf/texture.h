// Textures as directives "imagemap", and what multiplies them.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "core/image/embedded_file.h"
#include "core/scene/import.h"
#include "modules/gltf/document.h"
#include "modules/gltf/parameters.h"

namespace pssmlt::gltf {

// A texture as a material refers to it; index -1: none.
struct TextureReference {
  int index = -1, set = 0;
  dvec2 offset{0.0}, scale{1.0};
  double rotation = 0.0;  // [rad], KHR_texture_transform's
  explicit operator bool() const { return index >= 0; }
};
TextureReference texture_reference(int index, int set, const tinygltf::ExtensionMap& extensions);
// Of an extension's object.
TextureReference texture_reference(const tinygltf::Value& object, const char* name);

// A value of a material: a constant, or a texture's name.
struct FloatValue {
  double constant = 1.0;
  std::string texture;
};
struct ColorValue {
  vec3 constant{1.f};
  std::string texture;
};
void write(ParameterWriter& out, const char* name, const FloatValue& value);
void write(ParameterWriter& out, const char* name, const ColorValue& value);

class Textures {
 public:
  Textures(const Document& document, const ImportTarget& target)
      : document_(document), target_(target) {}

  // Directives are placed at `where`, named after `name`; `sets`: which of the file's sets of
  // coordinates the meshes will carry, first and second.
  struct Context {
    Location where;
    std::string pointer, name;
    std::array<int, 2> sets;
  };
  // One channel ("r", ...) of a texture times a factor.
  FloatValue channel(const Context& context, const char* role, const TextureReference& texture,
                     const char* channel, double factor);
  // Its colour times a factor; encoded: stored as sRGB.
  ColorValue color(const Context& context, const char* role, const TextureReference& texture,
                   const vec3& factor, bool encoded);
  // Products with what meshes carry a vertex.
  ColorValue by_vertex_color(const Context& context, const char* role, const ColorValue& value);
  FloatValue by_vertex_opacity(const Context& context, const char* role, const FloatValue& value);
  // 1 from `cutoff` on, else 0.
  FloatValue threshold(const Context& context, const char* role, const FloatValue& value,
                       double cutoff);

 private:
  std::string declare(const Context& context, const char* role, const char* type, bool color,
                      ParameterSet parameters);
  // Parameters of an imagemap but for channel, encoding and factor.
  ParameterWriter image_map(const Context& context, const TextureReference& texture);
  // What an imagemap calls the image.
  std::string image_name(int texture, const std::string& pointer);
  std::string embedded(int image);

  const Document& document_;
  const ImportTarget& target_;
  std::map<int, std::string> images_;
};

}  // namespace pssmlt::gltf
