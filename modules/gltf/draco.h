// Meshes compressed by Draco (KHR_draco_mesh_compression). The library lies behind a module of its
// own, which is loaded by the first such mesh, and not built where the library is missing.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pssmlt::gltf {

struct DracoAttribute {
  int components = 0;
  std::vector<float> values;  // normalized integers as fractions
};
struct DracoMesh {
  size_t vertices = 0;
  std::vector<uint32_t> indices;  // three a triangle
  std::map<std::string, DracoAttribute> attributes;
};

// Module "gltf_draco". attributes: names and Draco's numbers of those wanted. Throws
// std::runtime_error with the reason.
inline constexpr const char* draco_symbol = "pssmlt_decode_draco";
using DecodeDraco = void(std::span<const unsigned char> bytes,
                         const std::map<std::string, int>& attributes, DracoMesh& out);

// Whether the module is there; loads it.
bool has_draco();
DracoMesh decode_draco(std::span<const unsigned char> bytes,
                       const std::map<std::string, int>& attributes);

}  // namespace pssmlt::gltf
