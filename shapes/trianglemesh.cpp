// Triangles written in the scene: vertices, indices, and optional normals, tangents and texture
// coordinates per vertex.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 6.5.
#include "core/plugin/plugin.h"
#include "core/shapes/mesh_shape.h"

namespace pssmlt {
namespace {

MeshData read(Parameters& p) {
  MeshData data;
  std::vector<int> indices = p.integers(
      "indices", "", "Three vertices a triangle; may be left out for a single triangle.");
  data.mesh.positions = p.points3("P", "m", "Positions of the vertices.");
  data.mesh.normals = p.normals("N", "Shading normals of the vertices.");
  data.mesh.uvs = p.points2("uv", "", "Texture coordinates of the vertices.");
  data.tangents = p.vectors3("S", "Tangents of the vertices.");
  data.mesh.second_uvs = p.points2("uv1", "", "A second set of texture coordinates (uvset 1).");
  data.mesh.colors =
      p.rgbs("color", "", "Colours of the vertices, for the texture \"vertexcolor\".");
  data.mesh.opacities =
      p.numbers("coloralpha", "", "Opacities of the vertices, for the texture \"vertexcolor\".");
  p.integers("faceIndices", "", "A number per triangle for textures per face; none exist here.");
  if (p.describing()) return data;
  if (data.mesh.positions.empty()) p.fail("P", "vertex positions \"P\" are missing or empty");
  if (indices.empty()) {
    if (data.mesh.positions.size() != 3)
      p.fail("indices", "vertex indices \"indices\" are missing or empty");
    indices = {0, 1, 2};
  }
  data.mesh.triangles = triangles_of(indices, p);
  return data;
}

class TriangleMeshShape final : public MeshShape {
 public:
  static constexpr const char* summary = "Triangles written in the scene";
  explicit TriangleMeshShape(Parameters& p) : MeshShape(read(p), p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "trianglemesh", pssmlt::TriangleMeshShape)
