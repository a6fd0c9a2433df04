// The vertices of one primitive, from accessors or from a mesh that Draco compressed.
#pragma once

#include <memory>

#include "modules/gltf/document.h"
#include "modules/gltf/draco.h"

namespace pssmlt::gltf {

class Attributes {
 public:
  Attributes(const Document& document, const tinygltf::Primitive& primitive,
             const std::string& pointer);

  bool has(const std::string& name) const;
  int components(const std::string& name) const;
  // Of the attribute, which must be there, one tuple a vertex. Throws Error if their number is not
  // that of the positions.
  std::vector<float> floats(const std::string& name, int components) const;
  size_t vertices() const { return vertices_; }
  // Of the triangles, strips or fans; all of them are vertices.
  std::vector<uint32_t> indices() const;
  // One of a morph target's, by the accessor's index.
  std::vector<float> target(int accessor, const std::string& name) const;

 private:
  int accessor(const std::string& name) const { return primitive_.attributes.at(name); }
  std::vector<float> checked(std::vector<float> values, int components,
                             const std::string& name) const;
  void decompress(const tinygltf::Value& extension);

  const Document& document_;
  const tinygltf::Primitive& primitive_;
  std::string pointer_;
  std::unique_ptr<DracoMesh> draco_;
  size_t vertices_ = 0;
};

}  // namespace pssmlt::gltf
