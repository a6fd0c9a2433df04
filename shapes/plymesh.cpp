// A mesh from a PLY file: ASCII or binary, gzipped or not; polygons become triangles.
//
// Parameters and format: pbrt.org/fileformat-v4 and core/shapes/ply.h. Displacement of meshes is
// not supported.
#include "core/plugin/plugin.h"
#include "core/shapes/mesh_shape.h"
#include "core/shapes/ply.h"

namespace pssmlt {
namespace {

MeshData read(Parameters& p) {
  const std::string file = p.file("filename", "The PLY file.");
  if (p.describing()) return {};
  for (const char* unsupported : {"displacement", "edgelength"})
    if (p.has(unsupported)) p.fail(unsupported, "displaced meshes are not supported yet");
  if (file.empty()) p.fail("filename", "\"filename\" is missing");
  return read_ply(file, p.where());
}

class PlyMesh final : public MeshShape {
 public:
  static constexpr const char* summary = "Mesh from a PLY file";
  explicit PlyMesh(Parameters& p) : MeshShape(read(p), p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "plymesh", pssmlt::PlyMesh)
