// A walk over the registered shapes: rays and samples see the same surface. A new shape is tested
// without a line here if it has defaults, four points or a PLY or glTF file to start from.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "tests/support/all_hits.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/mesh_files.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

// The first of some usual descriptions that the shape accepts.
std::shared_ptr<const Shape> default_shape(const std::string& name) {
  const std::string start = "Shape \"" + name + "\" ";
  const std::string points = "\"point3 P\" [-.5 -.5 0  .5 -.5 .3  -.5 .5 .2  .5 .5 .6] ";
  const std::string triangles = "\"integer indices\" [0 1 2 2 1 3] ";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n";
  std::vector<std::string> candidates;
  if (has_parameter("shape", name, "filename")) {
    const std::string file = start + "\"string filename\" \"";
    candidates = {file + write_file("pssmlt-walk.ply", ply) + "\"",
                  "Translate -10 0 0 " + file + write_file("pssmlt-walk.gltf", gltf("44")) + "\""};
  } else if (has_parameter("shape", name, "P")) {
    candidates = {start + points + triangles, start + points};
  } else {
    candidates = {start};
  }
  for (const std::string& text : candidates) {
    try {
      return make_shape(text);
    } catch (const Error&) {  // the next may do
    }
  }
  return nullptr;
}

class AnyShape : public testing::TestWithParam<std::string> {
 protected:
  static double density(const Shape& shape, const vec3& from, const vec3& direction) {
    double sum = 0.0;
    for (const Hit& hit : all_hits(shape, {from, direction, infinity})) {
      const SurfaceSample at{
          .position = hit.position, .normal = hit.ng, .uv = hit.uv, .element = hit.element};
      sum += static_cast<double>(shape.pdf_toward(from, at));
    }
    return sum;
  }
};

// The solid angle of the shape: by uniform directions that meet it, and as the mean of 1 / density
// over directions that it draws itself. The latter is right only if the density is that of the
// draw, and rays find what is drawn. Two comparisons a shape at 1e-9.
TEST_P(AnyShape, SolidAngleIsFoundBothWays) {
  const auto shape = default_shape(GetParam());
  ASSERT_NE(shape, nullptr) << "give this shape a usual description in default_shape()";
  EXPECT_GT(shape->area(), 0.f);
  constexpr int samples = 40000;
  RandomStream random(11, RandomUse::test);
  for (const vec3& from : {vec3(.4f, -1.6f, 2.f), vec3(-.2f, .3f, -1.9f)}) {
    int met = 0, missed = 0;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < samples; ++i) {
      if (density(*shape, from, uniform_sphere(draw2(random))) > 0.0) ++met;
      const auto s = shape->sample_toward(from, draw2(random));
      const double p = s ? density(*shape, from, glm::normalize(s->position - from)) : 0.0;
      if (s && !(p > 0.0)) ++missed;
      const double value = p > 0.0 ? 1.0 / p : 0.0;
      sum += value;
      squares += value * value;
    }
    const double sphere = 4.0 * std::numbers::pi, share = static_cast<double>(met) / samples;
    const double mean = sum / samples;
    const double variance =
        (squares / samples - mean * mean + sphere * sphere * share * (1.0 - share)) / samples;
    EXPECT_NEAR(mean, sphere * share, 6.2 * std::sqrt(variance));
    EXPECT_GT(share, 0.0);
    EXPECT_LE(missed, samples / 1000) << "drawn points at the rim that rounding hides";
  }
}

// Where may_face() says no, no sampled point shows its outside; about half of all points around a
// flat shape are behind it.
TEST_P(AnyShape, FacesWhatItSays) {
  const auto shape = default_shape(GetParam());
  ASSERT_NE(shape, nullptr);
  RandomStream random(12, RandomUse::test);
  int behind = 0;
  for (int i = 0; i < 2000; ++i) {
    const float distance = 3.f * random.next();
    const vec3 reference = distance * uniform_sphere(draw2(random));
    if (shape->may_face(reference)) continue;
    ++behind;
    for (int k = 0; k < 8; ++k) {
      const SurfaceSample s = shape->sample_area(draw2(random));
      ASSERT_LE(glm::dot(s.normal, reference - s.position), 0.f);
    }
  }
  const bool triangle = shape->mesh() && shape->mesh()->triangles.size() == 1;
  EXPECT_GT(behind, triangle ? 700 : -1);
}

// What the choice among many lights goes by: sampled points are in the box, their normals in the
// cone, to the rounding of both.
TEST_P(AnyShape, StaysInItsBounds) {
  const auto shape = default_shape(GetParam());
  ASSERT_NE(shape, nullptr);
  const Bounds box = shape->bounds();
  const DirectionCone cone = shape->normals();
  RandomStream random(13, RandomUse::test);
  for (int i = 0; i < 2000; ++i) {
    const SurfaceSample s = shape->sample_area(draw2(random));
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(s.position[k], box.min[k] - 1e-5f);
      EXPECT_LE(s.position[k], box.max[k] + 1e-5f);
    }
    EXPECT_GE(glm::dot(s.normal, cone.axis), cone.cosine - 1e-4f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, AnyShape, testing::ValuesIn(Registry::instance().names("shape")),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace pssmlt::test
