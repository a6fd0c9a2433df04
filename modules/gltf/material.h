// Materials as directives "principled", with what belongs to the shapes that have them: emission,
// opacity, sets of coordinates.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "modules/gltf/mesh.h"
#include "modules/gltf/texture.h"

namespace pssmlt::gltf {

// What a shape needs besides its mesh.
struct ShapeSurface {
  std::string material;  // its name in the scene
  MeshNeeds needs;
  std::optional<ParameterSet> emission;  // of an area light
  std::optional<FloatValue> alpha;
  std::string medium;  // inside, "" is vacuum
};

class Materials {
 public:
  Materials(const Document& document, const ImportTarget& target)
      : document_(document), target_(target), textures_(document, target) {}
  // Of the file's material, or of its default one (-1), on meshes with or without colours; declares
  // it at the first call. `pointer`: who asks.
  const ShapeSurface& get(int material, bool vertex_colors, const std::string& pointer);
  // Lines for the log: what is left out, and of which materials.
  std::vector<std::string> notes() const;

 private:
  struct Source;  // one of the file's materials while it is translated
  void choose_sets(Source& s) const;
  void opacity(Source& s, ShapeSurface& out);
  void emission(Source& s, ShapeSurface& out);
  void unlit(Source& s, ShapeSurface& out);
  void principled(Source& s, ShapeSurface& out);
  void base(Source& s, ParameterWriter& out);
  void specular(Source& s, ParameterWriter& out);
  void body(Source& s, ParameterWriter& out, ShapeSurface& surface);
  void coat(Source& s, ParameterWriter& out);
  void sheen(Source& s, ParameterWriter& out);
  void anisotropy(Source& s, ParameterWriter& out);
  void absorb(Source& s, const tinygltf::Value& volume, ShapeSurface& surface);
  void leave_out(const Source& s, const std::string& what);

  const Document& document_;
  const ImportTarget& target_;
  Textures textures_;
  std::map<std::pair<int, bool>, ShapeSurface> made_;
  std::map<std::string, std::set<int>> left_out_;  // what, of which materials
};

}  // namespace pssmlt::gltf
