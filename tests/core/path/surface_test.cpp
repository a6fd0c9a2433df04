// Scattering where shading and geometric normals differ, against the definition.
#include "core/path/surface.h"

#include <gtest/gtest.h>

#include "app/defaults.h"
#include "core/scene/builder.h"
#include "core/scene/parser.h"

namespace pssmlt {
namespace {

// A triangle in the plane z = 0 whose vertices all carry a tilted normal.
constexpr const char* tilted = R"(
Camera "perspective"
WorldBegin
LightSource "point"
Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]
Shape "trianglemesh" "integer indices" [0 1 2]
  "point3 P" [-9 -9 0  9 -9 0  0 9 0]
  "normal N" [0.5 0 1  0.5 0 1  0.5 0 1]
)";

TEST(Surface, ImportanceHasTheAdjointOfShadingNormals) {
  BuildOptions options;
  options.defaults = default_plugins();
  const BuiltScene built = build_scene(parse_string(tilted, "tilted"), options);
  Surface s;
  const vec3 wo = glm::normalize(vec3(0.2f, 0.3f, 1.f));
  ASSERT_TRUE(built.scene->intersect({wo, -wo, infinity}, 0.f, s.hit));
  ASSERT_TRUE(s.shade(*built.scene, wo, {}));
  const vec3 ns = s.frame().n, ng = s.hit.ng;
  EXPECT_NEAR(glm::dot(ns, ng), 1.f / std::sqrt(1.25f), 1e-5f);
  for (const vec3& direction : {vec3(0.7f, 0.1f, 0.5f), vec3(-0.2f, 0.6f, 0.9f), vec3(0, 0, 1)}) {
    const vec3 wi = glm::normalize(direction);
    const float f = 0.6f * inv_pi;
    const float from_camera = f * std::abs(glm::dot(wi, ns));
    // Veach 1997, eq. 5.19: f* = f |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|), times the cosine |wi.ns|.
    const float from_light =
        f * std::abs(glm::dot(wo, ns)) * std::abs(glm::dot(wi, ng)) / std::abs(glm::dot(wo, ng));
    EXPECT_NEAR(s.f_cos(wi, Transport::radiance).y, from_camera, 1e-6f);
    EXPECT_NEAR(s.f_cos(wi, Transport::importance).y, from_light, 1e-6f);
    EXPECT_GT(std::abs(from_light - from_camera), 1e-3f) << "the test tells nothing";
  }
}

}  // namespace
}  // namespace pssmlt
