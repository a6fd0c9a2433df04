// A smooth surface from a coarse triangle mesh by Loop subdivision, levels times, then pushed to
// its limit (core/shapes/loop_subdivision.h). Costs four times the triangles a level.
#include "core/plugin/plugin.h"
#include "core/shapes/loop_subdivision.h"
#include "core/shapes/mesh_shape.h"

namespace pssmlt {
namespace {

constexpr int most_levels = 10;
constexpr size_t most_triangles = 200'000'000;

MeshData subdivided(SubdivisionMesh mesh, int levels) {
  for (int i = 0; i < levels; ++i) mesh = subdivide(mesh);
  const LimitSurface limit = limit_surface(mesh);
  MeshData data;
  for (const dvec3& p : limit.positions) data.mesh.positions.emplace_back(p);
  data.mesh.normals = limit.normals;
  data.mesh.triangles = std::move(mesh.triangles);
  return data;
}

MeshData read(Parameters& p) {
  const int levels = p.integer("levels", 3, "", "How often every triangle is divided in four.");
  const std::vector<int> indices = p.integers("indices", "", "Three vertices a triangle.");
  const std::vector<vec3> positions = p.points3("P", "m", "Positions of the vertices.");
  constexpr std::array<std::string_view, 1> schemes{"loop"};
  p.choice("scheme", "loop", schemes, "Subdivision scheme.");
  if (p.describing()) return {};
  if (positions.empty()) p.fail("P", "vertex positions \"P\" are missing or empty");
  if (indices.empty()) p.fail("indices", "vertex indices \"indices\" are missing or empty");
  if (levels < 0 || levels > most_levels)
    p.fail("levels", "\"levels\" must lie between 0 and " + std::to_string(most_levels));
  SubdivisionMesh mesh;
  mesh.triangles = triangles_of(indices, p);
  if (mesh.triangles.size() > most_triangles >> (2 * levels))
    p.fail("levels",
           "\"levels\" would make more than " + std::to_string(most_triangles) + " triangles");
  for (const vec3& v : positions) mesh.positions.emplace_back(v);
  const std::string fault = check_for_subdivision(mesh);
  if (!fault.empty()) p.fail("indices", fault);
  return subdivided(std::move(mesh), levels);
}

class LoopSubdivision final : public MeshShape {
 public:
  static constexpr const char* summary = "Smooth surface by Loop subdivision";
  explicit LoopSubdivision(Parameters& p) : MeshShape(read(p), p) {}
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "loopsubdiv", pssmlt::LoopSubdivision)
