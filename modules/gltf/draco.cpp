#include "modules/gltf/draco.h"

#include "core/plugin/registry.h"

namespace pssmlt::gltf {
namespace {

DecodeDraco* find() {
  return reinterpret_cast<DecodeDraco*>(Registry::instance().module("gltf_draco", draco_symbol));
}

}  // namespace

bool has_draco() {
  try {
    return find() != nullptr;
  } catch (const Failure&) {
    return false;
  }
}

DracoMesh decode_draco(std::span<const unsigned char> bytes,
                       const std::map<std::string, int>& attributes) {
  DracoMesh mesh;
  find()(bytes, attributes, mesh);
  return mesh;
}

}  // namespace pssmlt::gltf
