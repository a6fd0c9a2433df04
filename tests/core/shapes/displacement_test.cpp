// Displaced meshes: short edges, no cracks, the heights and normals that the texture asks for.
#include "core/shapes/displacement.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/make_plugin.h"

namespace pssmlt {
namespace {

// h = height sin(wave x) sin(wave y) of the texture coordinates or the position.
class Waves final : public Texture<float> {
 public:
  Waves(float height, float wave, bool by_uv) : height_(height), wave_(wave), by_uv_(by_uv) {}
  float evaluate(const Hit& hit) const override {
    const vec2 at = by_uv_ ? hit.uv : vec2(hit.position) + hit.position.z;
    return height_ * std::sin(wave_ * at.x) * std::sin(wave_ * at.y);
  }

 private:
  float height_, wave_;
  bool by_uv_;
};

MeshData displaced(const MeshData& mesh, std::shared_ptr<const Texture<float>> height, float edge,
                   const Transform& transform = {}) {
  const ParameterSet none;
  test::Resolver resolver;
  Parameters p(none, {}, "shape", &resolver);
  p.set_transform(transform);
  return displace(mesh, {std::move(height), edge}, p);
}

// A cube of two triangles a side, whose corners are shared by place only.
MeshData cube(bool with_uv) {
  MeshData data;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.f, 1.f}) {
      const auto first = static_cast<uint32_t>(data.mesh.positions.size());
      for (const vec2& c : {vec2(-1.f), vec2(1.f, -1.f), vec2(1.f), vec2(-1.f, 1.f)}) {
        vec3 p(0.f);
        p[axis] = side;
        p[(axis + 1) % 3] = side * c.x;
        p[(axis + 2) % 3] = c.y;
        data.mesh.positions.push_back(p);
        if (with_uv) data.mesh.uvs.push_back(0.5f * c + 0.5f + 2.f * side);
      }
      data.mesh.triangles.emplace_back(first, first + 1, first + 2);
      data.mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
  }
  return data;
}

MeshData square() {
  MeshData data;
  data.mesh.positions = {{0.f, 0.f, 0.f}, {1.f, 0.f, 0.f}, {1.f, 1.f, 0.f}, {0.f, 1.f, 0.f}};
  data.mesh.uvs = {{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}};
  data.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return data;
}

// How many directed edges have no partner in the other direction, by place.
size_t open_edges(const TriangleMesh& m) {
  const auto key = [&](uint32_t i) {
    const vec3& p = m.positions[i];
    return std::array<float, 3>{p.x + 0.f, p.y + 0.f, p.z + 0.f};
  };
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> count;
  for (const glm::uvec3& t : m.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto a = key(t[k]), b = key(t[(k + 1) % 3]);
      ++count[{a, b}];
      --count[{b, a}];
    }
  }
  size_t open = 0;
  for (const auto& [edge, n] : count) open += n != 0;
  return open;
}

TEST(Displacement, EdgesAreShortInRenderSpace) {
  const auto flat = constant_texture(0.f);
  const MeshData mesh = displaced(square(), flat, .1f, Transform::scale({2.0, 1.0, 1.0}));
  const TriangleMesh& m = mesh.mesh;
  float longest = 0.f;
  for (const glm::uvec3& t : m.triangles)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, glm::length((m.positions[t[k]] - m.positions[t[(k + 1) % 3]]) *
                                              vec3(2.f, 1.f, 1.f)));
  EXPECT_LE(longest, .1f * (1.f + 1e-6f));
  EXPECT_GT(m.triangles.size(), 2u * 20u * 10u / 2u);
  EXPECT_LT(m.triangles.size(), 20'000u);
  double area = 0.0;
  for (const glm::uvec3& t : m.triangles)
    area +=
        0.5 *
        static_cast<double>(
            glm::cross(m.positions[t.y] - m.positions[t.x], m.positions[t.z] - m.positions[t.x]).z);
  EXPECT_NEAR(area, 1.0, 1e-6);
}

// Corners meet three sides whose normals, and with coordinates whose heights, differ.
TEST(Displacement, SeamsStayClosed) {
  for (const bool with_uv : {false, true}) {
    const MeshData mesh =
        displaced(cube(with_uv), std::make_shared<Waves>(.2f, 7.f, with_uv), .11f);
    EXPECT_GT(mesh.mesh.triangles.size(), 5000u);
    EXPECT_EQ(open_edges(mesh.mesh), 0u) << with_uv;
  }
}

TEST(Displacement, HeightsAndNormalsAreTheTextures) {
  constexpr float height = .05f, wave = 9.f;
  const MeshData mesh = displaced(square(), std::make_shared<Waves>(height, wave, true), .01f);
  const TriangleMesh& m = mesh.mesh;
  for (size_t i = 0; i < m.positions.size(); ++i) {
    const vec3& p = m.positions[i];
    EXPECT_EQ(vec2(p), m.uvs[i]);
    EXPECT_NEAR(p.z, height * std::sin(wave * p.x) * std::sin(wave * p.y), 1e-6f);
    // At the border normals are of one side only.
    if (p.x < .02f || p.y < .02f || p.x > .98f || p.y > .98f) continue;
    const vec3 n =
        glm::normalize(vec3(-height * wave * std::cos(wave * p.x) * std::sin(wave * p.y),
                            -height * wave * std::sin(wave * p.x) * std::cos(wave * p.y), 1.f));
    EXPECT_GT(glm::dot(m.normals[i], n), 1.f - 1e-4f);
  }
}

// Given normals, even against the order of the indices, say where outside is.
TEST(Displacement, GivenNormalsLead) {
  MeshData mesh = square();
  mesh.mesh.normals.assign(4, vec3(0.f, 0.f, -2.f));
  mesh = displaced(mesh, constant_texture(.25f), .5f);
  for (const vec3& p : mesh.mesh.positions) EXPECT_NEAR(p.z, -.25f, 1e-6f);
  for (const vec3& n : mesh.mesh.normals) EXPECT_NEAR(n.z, -1.f, 1e-6f);
}

TEST(Displacement, RefusesWhatItCannotDo) {
  const auto message = [](std::shared_ptr<const Texture<float>> height, float edge) {
    return test::error_of([&] { displaced(square(), std::move(height), edge); });
  };
  EXPECT_NE(message(constant_texture(0.f), 1e-5f).find("2^26"), std::string::npos);
  EXPECT_NE(message(constant_texture(infinity), .5f).find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
