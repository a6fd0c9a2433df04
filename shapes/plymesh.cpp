// A mesh from a PLY file: ASCII or binary, gzipped or not; polygons become triangles.
//
// Parameters and format: pbrt.org/fileformat-v4 and core/shapes/ply.h; displaced meshes:
// core/shapes/displacement.h.
#include <algorithm>

#include "core/plugin/plugin.h"
#include "core/shapes/displacement.h"
#include "core/shapes/mesh_shape.h"
#include "core/shapes/ply.h"

namespace pssmlt {
namespace {

// What MeshShape refuses is left as it is.
bool can_be_displaced(const TriangleMesh& m) {
  const size_t count = m.positions.size();
  const auto fits = [&](size_t size) { return size == 0 || size == count; };
  const auto in_range = [&](const glm::uvec3& t) {
    return t.x < count && t.y < count && t.z < count;
  };
  return fits(m.normals.size()) && fits(m.uvs.size()) &&
         std::ranges::all_of(m.positions, is_finite) && std::ranges::all_of(m.triangles, in_range);
}

MeshData read(Parameters& p) {
  const std::string file = p.file("filename", "The PLY file.");
  Displacement displacement;
  displacement.height = p.optional_float_texture(
      "displacement", "How far the surface is moved along its normal [m in the mesh's space].");
  displacement.edge_length =
      p.number("displacement.edgelength", 1.f, "m", "Longest edge of a displaced mesh.");
  if (p.describing()) return {};
  if (!(displacement.edge_length > 0.f))
    p.fail("displacement.edgelength", "\"displacement.edgelength\" must be positive");
  if (file.empty()) p.fail("filename", "\"filename\" is missing");
  MeshData data = read_ply(file, p.where());
  if (!displacement.height || !can_be_displaced(data.mesh)) return data;
  return displace(std::move(data), displacement, p);
}

class PlyMesh final : public MeshShape {
 public:
  static constexpr const char* summary = "Mesh from a PLY file";
  explicit PlyMesh(Parameters& p) : MeshShape(read(p), p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "plymesh", pssmlt::PlyMesh)
