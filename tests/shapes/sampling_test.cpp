// Every shape: points sampled over the area and toward a reference follow the densities that the
// shape states of them, and the surface is the one that rays meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/image/image.h"
#include "tests/support/all_hits.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;

struct Case {
  const char* name;
  std::string text;
  vec3 reference;
  double area;      // closed form [m^2]; 0: not known
  int patches = 1;  // of shapes that are no meshes; 0: do not map them to their parameters
};

constexpr double pi_d = std::numbers::pi;
constexpr const char* house =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 0 1 4 1 2 4]"
    "\"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0  0 0 1.5]";

// A black texel, dim ones and a bright one.
std::string emission_file() {
  static const std::string path = [] {
    Image image(4, 3, 3);
    std::ranges::fill(image.data, .1f);
    for (int c = 0; c < 3; ++c) image.pixel(3, 0)[c] = 2.f, image.pixel(0, 2)[c] = 0.f;
    const std::string file = own_file("sampling-emission.pfm");
    write_image(file, image, {}, {});
    return file;
  }();
  return path;
}

std::vector<Case> cases() {
  return {
      {"Sphere", "Shape \"sphere\" \"float radius\" 0.8", {2.f, 0.5f, 1.f}, 4 * pi_d * 0.64},
      {"SphereNear", "Shape \"sphere\"", {1.02f, 0.f, 0.f}, 4 * pi_d},
      {"SphereInside", "Shape \"sphere\"", {0.3f, 0.2f, -0.4f}, 4 * pi_d},
      {"SphereReversed", "ReverseOrientation Shape \"sphere\"", {0.f, -2.f, 0.3f}, 4 * pi_d},
      {"SpherePartial",
       "Shape \"sphere\" \"float zmin\" -0.3 \"float zmax\" 0.8 \"float phimax\" 200",
       {1.f, 2.f, 0.5f},
       200.0 / 180.0 * pi_d * 1.1},
      {"SphereMoved",
       "Translate 1 2 3 Rotate 40 1 2 3 Scale 2 2 -2 Shape \"sphere\"",
       {-3.f, 2.f, 1.f},
       16 * pi_d},
      // Oblate spheroid with half axes 2, 2, 1.
      {"Ellipsoid",
       "Rotate 30 1 0 0 Scale 2 2 1 Shape \"sphere\"",
       {3.f, 1.f, 2.f},
       2 * pi_d * 4 * (1 + 0.25 / (std::sqrt(3.0) / 2) * std::atanh(std::sqrt(3.0) / 2))},
      {"Disk",
       "Shape \"disk\" \"float radius\" 1.5 \"float height\" 0.5",
       {0.5f, 0.2f, 2.f},
       pi_d * 2.25},
      {"Ring",
       "Shape \"disk\" \"float innerradius\" 0.5 \"float phimax\" 250",
       {0.5f, 0.2f, -1.f},
       250.0 / 360.0 * pi_d * 0.75},
      {"DiskStretched", "Scale 3 1 1 Shape \"disk\"", {0.5f, 0.2f, -1.f}, 3 * pi_d},
      {"Cylinder", "Shape \"cylinder\"", {2.f, 1.f, 0.5f}, 4 * pi_d},
      {"CylinderInside",
       "Shape \"cylinder\" \"float phimax\" 300",
       {0.2f, 0.1f, 0.f},
       300.0 / 360.0 * 4 * pi_d},
      {"CylinderStretched",
       "Rotate 20 0 1 0 Scale 0.5 2 1 Shape \"cylinder\"",
       {2.f, 3.f, 0.5f},
       0},
      {"Triangle", "Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 0 1 0]", {1.f, 1.f, 1.f}, 1},
      {"Mesh", house, {2.f, 1.f, 1.f}, 0},
      {"PatchRectangle",
       "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 1 0 2 1 0]",
       {1.f, 1.f, 1.f},
       2},
      {"PatchPlanar",
       "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0.5 1 0 1 1.5 0]",
       {1.f, 1.f, 1.f},
       0},
      {"PatchCurved",
       "Scale 1 -1 1 Shape \"bilinearmesh\" \"point3 P\" [0 0 0 2 0 1 0 2 1 2 2 0]",
       {1.f, -1.f, 2.f},
       0},
      {"PatchesWithUv",
       "Shape \"bilinearmesh\" \"integer indices\" [0 1 2 3 1 4 3 5]"
       "\"point3 P\" [0 0 0 1 0 0.5 0 1 0.5 1 1 0 2 0 0 2 1 0.7]"
       "\"point2 uv\" [0 0 0.5 0.1 0 1 0.6 1 1 0 1 1]",
       {1.f, -1.f, 2.f},
       0,
       0},
      {"Patches",
       "Shape \"bilinearmesh\" \"integer indices\" [0 1 2 3 1 4 3 5]"
       "\"point3 P\" [0 0 0 1 0 0.5 0 1 0.5 1 1 0 2 0 0 2 1 0.7]",
       {1.f, -1.f, 2.f},
       0,
       2},
      {"PatchesByEmission",
       "Shape \"bilinearmesh\" \"integer indices\" [0 1 2 3 1 4 3 5]"
       "\"point3 P\" [0 0 0 1 0 0.5 0 1 0.5 1 1 0 2 0 0 2 1 0.7]"
       "\"string emissionfilename\" \"" +
           emission_file() + "\"",
       {1.f, -1.f, 2.f},
       0,
       2}};
}

// The surface's own parameters as one square, in which densities have no singularities: elements
// side by side in x, and within each the coordinates of fill(), a triangle stretched to a square.
class SurfaceMap {
 public:
  explicit SurfaceMap(const Shape& shape, int patches)
      : shape_(shape),
        elements_(shape.mesh() ? static_cast<double>(shape.mesh()->triangles.size()) : patches) {}

  struct Point {
    SurfaceSample at;
    double jacobian;  // area of the surface over area of the square [m^2]
  };
  Point point(const dvec2& square) const {
    Hit hit;
    hit.element = static_cast<uint32_t>(square.x * elements_);
    const double u = square.x * elements_ - hit.element;
    if (shape_.mesh()) {
      const double v = u * square.y;
      shape_.fill(vec2(dvec2(u - v, v)), hit);
      const auto [p0, e1, e2] = edges(hit.element);
      return {point_of(hit), elements_ * u * glm::length(glm::cross(e1, e2))};
    }
    shape_.fill(vec2(dvec2(u, square.y)), hit);
    return {point_of(hit),
            elements_ * static_cast<double>(glm::length(glm::cross(hit.dpdu, hit.dpdv)))};
  }
  dvec2 square(const SurfaceSample& s) const {
    if (!shape_.mesh()) return {(s.element + static_cast<double>(s.uv.x)) / elements_, s.uv.y};
    const auto [p0, e1, e2] = edges(s.element);
    const dvec3 d = dvec3(s.position) - p0, n = glm::cross(e1, e2);
    const double n2 = glm::dot(n, n);
    const double b1 = glm::dot(glm::cross(d, e2), n) / n2, b2 = glm::dot(glm::cross(e1, d), n) / n2;
    const double u = std::min(std::max(b1 + b2, 1e-12), 1.0 - 1e-12);
    return {(s.element + u) / elements_, std::min(std::max(b2 / u, 0.0), 1.0)};
  }

 private:
  std::array<dvec3, 3> edges(uint32_t element) const {
    const TriangleMesh& m = *shape_.mesh();
    const glm::uvec3& t = m.triangles[element];
    const dvec3 p0(m.positions[t.x]);
    return {p0, dvec3(m.positions[t.y]) - p0, dvec3(m.positions[t.z]) - p0};
  }
  const Shape& shape_;
  double elements_;
};

class ShapeSampling : public testing::TestWithParam<Case> {
 protected:
  ShapeSampling()
      : shape_(make_shape(GetParam().text)),
        reference_(GetParam().reference),
        map_(*shape_, GetParam().patches) {}
  std::shared_ptr<Shape> shape_;
  vec3 reference_;
  SurfaceMap map_;
};

TEST_P(ShapeSampling, AreaIsTheClosedForm) {
  if (GetParam().area > 0.0) {
    EXPECT_NEAR(shape_->area() / GetParam().area, 1.0, 2e-5);
  }
}

// Monte Carlo: the mean of 1/pdf is the area. The limit is on the mean of 1e5 samples.
TEST_P(ShapeSampling, AreaIsTheMeanOfInverseDensities) {
  RandomStream random(3, RandomUse::test);
  double sum = 0.0, sum2 = 0.0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const SurfaceSample s = shape_->sample_area(draw2(random));
    const double area = s.pdf > 0.f ? 1.0 / s.pdf : 0.0;
    sum += area;
    sum2 += area * area;
  }
  const double mean = sum / n, sigma = std::sqrt(std::max(0.0, sum2 / n - mean * mean) / n);
  EXPECT_NEAR(mean, shape_->area(), z_limit * sigma + 2e-3 * shape_->area());
}

TEST_P(ShapeSampling, SamplesStateTheirDensity) {
  RandomStream random(4, RandomUse::test);
  for (int i = 0; i < 2000; ++i) {
    const vec2 u = draw2(random);
    const SurfaceSample s = shape_->sample_area(u);
    ASSERT_GT(s.pdf, 0.f);
    EXPECT_NEAR(shape_->pdf_area(s) / s.pdf, 1.f, 2e-3f);
    EXPECT_NEAR(glm::length(s.normal), 1.f, 1e-5f);
    const auto t = shape_->sample_toward(reference_, u);
    if (!t) continue;
    // Grazing points may turn away by rounding.
    const vec3 d = glm::normalize(reference_ - t->position);
    if (std::abs(glm::dot(d, t->normal)) < 1e-3f) continue;
    EXPECT_NEAR(shape_->pdf_toward(reference_, *t) / t->pdf, 1.f, 2e-3f);
  }
}

TEST_P(ShapeSampling, AreaSamplesFollowTheirDensity) {
  if (GetParam().patches == 0) return;  // texture coordinates hide the parameters
  const auto result = chi_square_2d(
      [&](RandomStream& random) {
        return std::optional(map_.square(shape_->sample_area(draw2(random))));
      },
      [&](const dvec2& square) {
        const auto point = map_.point(square);
        return static_cast<double>(shape_->pdf_area(point.at)) * point.jacobian;
      });
  EXPECT_GT(result.p, false_alarm);
  EXPECT_NEAR(result.integral, 1.0, 2e-3);
}

TEST_P(ShapeSampling, SamplesTowardFollowTheirDensity) {
  if (GetParam().patches == 0) return;  // texture coordinates hide the parameters
  const auto result = chi_square_2d(
      [&](RandomStream& random) -> std::optional<dvec2> {
        const auto s = shape_->sample_toward(reference_, draw2(random));
        if (!s) return std::nullopt;
        return map_.square(*s);
      },
      [&](const dvec2& square) {
        const auto point = map_.point(square);
        const float pdf = shape_->pdf_toward(reference_, point.at);
        const float per_area =
            area_to_solid_angle(1.f, reference_, point.at.position, point.at.normal);
        return per_area > 0.f ? pdf / per_area * point.jacobian : 0.0;
      });
  EXPECT_GT(result.p, false_alarm);
  EXPECT_NEAR(result.integral + result.failures, 1.0, 5e-3);
}

// Rays toward sampled points meet them, within the bound on their rounding and that of the ray.
TEST_P(ShapeSampling, RaysMeetSampledPoints) {
  RandomStream random(5, RandomUse::test);
  int missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const SurfaceSample s = shape_->sample_area(draw2(random));
    const vec3 d = glm::normalize(s.position - reference_);
    const float cosine = std::abs(glm::dot(d, s.normal));
    if (cosine < 1e-2f) continue;
    bool found = false;
    for (const Hit& hit : all_hits(*shape_, {reference_, d, infinity})) {
      if (glm::distance(hit.position, s.position) > 1e-5f / cosine) continue;
      found = true;
      EXPECT_GT(glm::dot(hit.ng, s.normal), 0.99f);
      EXPECT_GT(glm::dot(hit.ng, hit.ns), 0.f);
      EXPECT_LT(glm::distance(hit.uv, s.uv), 1e-3f);
      const vec3 cross = glm::normalize(glm::cross(hit.dpdu, hit.dpdv));
      EXPECT_GT(std::abs(glm::dot(cross, hit.ng)), 0.999f);
    }
    missed += !found;
  }
  EXPECT_LE(missed, 4);  // points on the very edge
}

INSTANTIATE_TEST_SUITE_P(All, ShapeSampling, testing::ValuesIn(cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace pssmlt
