// Bilinear patches: four corners each, p(0,0) p(1,0) p(0,1) p(1,1).
//
// Patches that are parallelograms (walls, lamps) become pairs of triangles, which are the same
// surface and faster, unless their points are chosen by an image; all others are kept as patches,
// curved or not (core/shapes/patch_shape.h).
#include <algorithm>
#include <memory>

#include "core/light_image.h"
#include "core/plugin/plugin.h"
#include "core/shapes/mesh_shape.h"
#include "core/shapes/patch_shape.h"

namespace pssmlt {
namespace {

// Luminances, each the largest around it, since lamps interpolate.
Distribution2D read_emission(const std::string& file, const PatchData& data, const Parameters& p) {
  if (!data.uvs.empty())
    p.fail("emissionfilename",
           "an image of emission needs the patches' own coordinates, no \"uv\"");
  const LightImage image = read_light_image(p, file);
  std::vector<float> weights;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      float most = 0.f;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image.width - 1); ++i)
          most = std::max(most, luminance(image.at(i, j)));
      weights.push_back(most);
    }
  }
  return {std::span<const float>(weights), image.width, image.height};
}

PatchData read(Parameters& p) {
  PatchData data;
  std::vector<int> indices =
      p.integers("indices", "", "Four vertices a patch; may be left out for a single patch.");
  data.positions = p.points3("P", "m", "Positions of the vertices.");
  data.normals = p.normals("N", "Shading normals of the vertices.");
  data.uvs = p.points2("uv", "", "Texture coordinates of the vertices.");
  const std::string emission = p.file(
      "emissionfilename",
      "Image of the emission over (u, v): where points of a lamp are chosen, not what it emits.");
  p.integers("faceIndices", "", "A number per patch for textures per face; none exist here.");
  if (p.describing()) return data;
  if (data.positions.empty()) p.fail("P", "vertex positions \"P\" are missing or empty");
  const size_t count = data.positions.size();
  if (indices.empty() && count == 4) indices = {0, 1, 2, 3};
  if (indices.empty()) p.fail("indices", "vertex indices \"indices\" are missing or empty");
  if (indices.size() % 4 != 0) p.fail("indices", "the number of indices is no multiple of four");
  if (!data.normals.empty() && data.normals.size() != count)
    p.fail("N", "there must be as many normals as vertices");
  if (!data.uvs.empty() && data.uvs.size() != count)
    p.fail("uv", "there must be as many texture coordinates as vertices");
  if (!emission.empty()) data.emission = read_emission(emission, data, p);
  data.quads.resize(indices.size() / 4);
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0 || static_cast<size_t>(indices[i]) >= count)
      p.fail("indices", "index " + std::to_string(indices[i]) + " is out of range: there are " +
                            std::to_string(count) + " vertices");
    data.quads[i / 4][i % 4] = static_cast<uint32_t>(indices[i]);
  }
  return data;
}

// True if the fourth corner is where the other three put it, to the rounding of decimal input.
template <typename V>
bool affine(const std::vector<V>& values, const Quad& q) {
  const V difference = (values[q[3]] - values[q[1]]) - (values[q[2]] - values[q[0]]);
  V magnitude(0.f);
  for (const uint32_t i : q) magnitude = glm::max(magnitude, glm::abs(values[i]));
  for (int k = 0; k < V::length(); ++k)
    if (!(std::abs(difference[k]) <= 4.f * 0x1p-24f * magnitude[k])) return false;
  return true;
}

bool all_parallelograms(const PatchData& data) {
  for (const Quad& q : data.quads)
    if (!affine(data.positions, q) || (!data.uvs.empty() && !affine(data.uvs, q))) return false;
  return data.normals.empty();
}

// Four vertices a patch, since neighbours differ in texture coordinates.
MeshData as_triangles(const PatchData& data) {
  MeshData mesh;
  TriangleMesh& m = mesh.mesh;
  for (const Quad& q : data.quads) {
    const auto first = static_cast<uint32_t>(m.positions.size());
    for (uint32_t k = 0; k < 4; ++k) {
      m.positions.push_back(data.positions[q[k]]);
      m.uvs.push_back(data.uvs.empty() ? vec2(k & 1u, k >> 1u) : data.uvs[q[k]]);
    }
    m.triangles.emplace_back(first, first + 1, first + 3);
    m.triangles.emplace_back(first, first + 3, first + 2);
  }
  return mesh;
}

std::unique_ptr<Shape> make(Parameters& p) {
  PatchData data = read(p);
  if (p.describing()) return nullptr;
  if (all_parallelograms(data) && !(data.emission.sum() > 0.0))
    return std::make_unique<MeshShape>(as_triangles(data), p);
  return std::make_unique<PatchShape>(std::move(data), p);
}

class BilinearMesh final : public Shape {
 public:
  static constexpr const char* summary = "Bilinear patches of four corners each";
  explicit BilinearMesh(Parameters& p) : shape_(make(p)) {}

  const TriangleMesh* mesh() const override { return shape_->mesh(); }
  Bounds bounds() const override { return shape_->bounds(); }
  std::optional<UserHit> intersect(const Ray& ray, float t_min) const override {
    return shape_->intersect(ray, t_min);
  }
  void fill(const vec2& where, Hit& hit) const override { shape_->fill(where, hit); }
  float grain() const override { return shape_->grain(); }
  void refine(const dvec3& origin, const dvec3& direction, Hit& hit) const override {
    shape_->refine(origin, direction, hit);
  }
  float area() const override { return shape_->area(); }
  SurfaceSample sample_area(const vec2& u) const override { return shape_->sample_area(u); }
  std::optional<SurfaceSample> sample_toward(const vec3& reference, const vec2& u) const override {
    return shape_->sample_toward(reference, u);
  }
  bool may_face(const vec3& reference) const override { return shape_->may_face(reference); }
  DirectionCone normals() const override { return shape_->normals(); }
  float pdf_area(const SurfaceSample& at) const override { return shape_->pdf_area(at); }
  float pdf_toward(const vec3& reference, const SurfaceSample& at) const override {
    return shape_->pdf_toward(reference, at);
  }

 private:
  std::unique_ptr<Shape> shape_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Shape, "bilinearmesh", pssmlt::BilinearMesh)
