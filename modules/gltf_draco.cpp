// Meshes of glTF files compressed by Draco (KHR_draco_mesh_compression), through libdraco.
#include "core/plugin/plugin.h"
#include "modules/gltf/draco.h"

#ifdef PSSMLT_HAS_DRACO

#include <draco/compression/decode.h>

#include <stdexcept>

namespace pssmlt::gltf {
namespace {

DracoAttribute values_of(const draco::Mesh& mesh, const draco::PointAttribute& from) {
  DracoAttribute result{from.num_components(), {}};
  const auto width = static_cast<size_t>(result.components);
  result.values.resize(mesh.num_points() * width);
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex at = from.mapped_index(draco::PointIndex(i));
    if (at.value() >= from.size() ||
        !from.ConvertValue<float>(at, from.num_components(), &result.values[i * width]))
      throw std::runtime_error("an attribute cannot be read");
  }
  return result;
}

void decode(std::span<const unsigned char> bytes, const std::map<std::string, int>& attributes,
            DracoMesh& out) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) throw std::runtime_error(decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  out.vertices = mesh->num_points();
  for (const auto& [name, id] : attributes) {
    const draco::PointAttribute* const from =
        id < 0 ? nullptr : mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id));
    if (!from) throw std::runtime_error("there is no attribute " + std::to_string(id));
    out.attributes[name] = values_of(*mesh, *from);
  }
  out.indices.reserve(size_t{3} * mesh->num_faces());
  for (uint32_t i = 0; i < mesh->num_faces(); ++i)
    for (const auto& corner : mesh->face(draco::FaceIndex(i)))
      out.indices.push_back(corner.value());
}

}  // namespace
}  // namespace pssmlt::gltf

PSSMLT_EXPORT void pssmlt_decode_draco(std::span<const unsigned char> bytes,
                                       const std::map<std::string, int>& attributes,
                                       pssmlt::gltf::DracoMesh& out) {
  pssmlt::gltf::decode(bytes, attributes, out);
}

static_assert(std::is_same_v<decltype(pssmlt_decode_draco), pssmlt::gltf::DecodeDraco>);

#endif
