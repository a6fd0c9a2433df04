// Curves: sizes of straight ones in closed form, places on bent ones, and errors.
#include <gtest/gtest.h>

#include "tests/support/make_endpoint.h"

namespace pssmlt {
namespace {

using namespace test;

constexpr const char* straight = "\"point3 P\" [0 0 0  1 0 0  2 0 0  3 0 0] ";
constexpr const char* bent = "\"point3 P\" [0 0 0  0 2 0  3 2 1  3 0 2] ";

std::shared_ptr<Shape> curve(const std::string& text) {
  return make_shape("Shape \"curve\" " + text);
}
std::string message(const std::string& text) {
  return error_of([&] { curve(text); });
}

// Mean of the cross section's vertices that are near `u` of the first or last segment's end.
vec3 end_of(const Shape& shape, bool last) {
  const auto& p = shape.mesh()->positions;
  const size_t row = 8;  // without the vertex of the seam
  vec3 sum(0.f);
  const size_t first = last ? p.size() - row : 0;
  for (size_t i = 0; i < row; ++i) sum += p[first + i];
  return sum / static_cast<float>(row);
}

TEST(Curve, StraightOnesHaveTheirArea) {
  for (const char* type : {"flat", "cylinder"}) {
    const auto tube =
        curve(std::string("\"string type\" \"") + type + "\" \"float width\" 0.2 " + straight);
    EXPECT_NEAR(tube->area(), pi * 0.2f * 3.f, 1e-4f) << type;
  }
  const auto ribbon = curve(std::string("\"string type\" \"ribbon\" \"float width\" 0.2 ") +
                            straight + "\"normal N\" [0 0 1  0 0 1]");
  EXPECT_NEAR(ribbon->area(), 0.2f * 3.f, 1e-5f);
  const auto cone = curve(std::string("\"float width0\" 0.2 \"float width1\" 0 ") + straight);
  EXPECT_NEAR(cone->area(), 0.5f * pi * 0.2f * 3.f, 2e-2f);
  // A ribbon that turns by a right angle on its way, between two whose areas are known.
  const auto twisted = curve(std::string("\"string type\" \"ribbon\" \"float width\" 0.2 ") +
                             straight + "\"normal N\" [0 0 1  0 1 0]");
  EXPECT_GT(twisted->area(), 0.6f);
  EXPECT_LT(twisted->area(), 0.6f * 1.002f);
}

TEST(Curve, BeginsAndEndsWhereItShould) {
  const auto bezier = curve(std::string("\"float width\" 0.1 ") + bent);
  EXPECT_LT(glm::distance(end_of(*bezier, false), vec3(0.f)), 1e-5f);
  EXPECT_LT(glm::distance(end_of(*bezier, true), vec3(3.f, 0.f, 2.f)), 1e-5f);
  const auto spline =
      curve(std::string("\"float width\" 0.1 \"string basis\" \"bspline\" ") + bent);
  EXPECT_LT(glm::distance(end_of(*spline, false), vec3(3.f, 10.f, 1.f) / 6.f), 1e-5f);
  EXPECT_LT(glm::distance(end_of(*spline, true), vec3(15.f, 10.f, 6.f) / 6.f), 1e-5f);
  const auto quadratic = curve(
      "\"float width\" 0.1 \"integer degree\" 2 \"point3 P\" [0 0 0  1 2 0  2 0 0  3 -2 0  4 0 1]");
  EXPECT_LT(glm::distance(end_of(*quadratic, true), vec3(4.f, 0.f, 1.f)), 1e-5f);
  const auto spline2 = curve(
      "\"float width\" 0.1 \"integer degree\" 2 \"string basis\" \"bspline\" "
      "\"point3 P\" [0 0 0  1 2 0  2 0 0  4 0 1]");
  EXPECT_LT(glm::distance(end_of(*spline2, false), vec3(0.5f, 1.f, 0.f)), 1e-5f);
  EXPECT_LT(glm::distance(end_of(*spline2, true), vec3(3.f, 0.f, 0.5f)), 1e-5f);
}

// Every vertex of a tube is half its width, within what a polygon differs from a circle, from the
// curve: found by searching the curve's points.
TEST(Curve, TubesFollowTheCurve) {
  const auto tube = curve(std::string("\"float width\" 0.2 ") + bent);
  const dvec3 c[] = {{0., 0., 0.}, {0., 2., 0.}, {3., 2., 1.}, {3., 0., 2.}};
  ASSERT_GT(tube->mesh()->positions.size(), 60u);
  for (size_t i = 0; i < tube->mesh()->positions.size(); ++i) {
    double nearest = 1e9;
    for (int k = 0; k <= 4000; ++k) {
      const double u = k / 4000.0, s = 1.0 - u;
      const dvec3 p =
          s * s * s * c[0] + 3. * s * s * u * c[1] + 3. * s * u * u * c[2] + u * u * u * c[3];
      nearest = std::min(nearest, glm::distance(p, dvec3(tube->mesh()->positions[i])));
    }
    EXPECT_NEAR(nearest, 0.1 * 1.0262, 1e-3);
    // Normals point away from it.
    EXPECT_NEAR(glm::length(tube->mesh()->normals[i]), 1.f, 1e-5f);
  }
}

// As a sheet a tube is a band of pi/2 times its width about the curve, which hides as much as the
// tube, seen from anywhere across it: the mean over whole turns of |cos| is 2/pi.
TEST(Curve, SheetsHideWhatTubesHide) {
  const auto sheet =
      curve("\"bool sheet\" true \"float width\" 0.02 \"point3 P\" [0 0 0  1 0 0  2 0 0  3 0 0] ");
  const TriangleMesh& mesh = *sheet->mesh();
  for (const float angle : {0.f, 0.5f, 1.1f, 2.f}) {
    const vec3 view(0.f, std::cos(angle), std::sin(angle));
    float hidden = 0.f;
    for (const glm::uvec3& t : mesh.triangles) {
      const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      hidden += 0.5f * std::abs(glm::dot(glm::cross(b - a, c - a), view));
    }
    EXPECT_NEAR(hidden, 0.02f * 3.f, 0.02f * 0.02f * 3.f) << angle;
  }
  // v runs across it, so that the frame along the curve has v's axis as its second.
  Hit hit;
  sheet->fill({0.3f, 0.3f}, hit);
  EXPECT_GT(hit.dpdu.x, 0.f);
  EXPECT_NEAR(std::abs(glm::dot(glm::normalize(hit.dpdv), glm::cross(hit.ns, vec3(1, 0, 0)))), 1.f,
              1e-2f);
  const auto ribbon = curve(std::string("\"string type\" \"ribbon\" \"float width\" 0.2 ") +
                            straight + "\"bool sheet\" true \"normal N\" [0 0 1  0 0 1]");
  EXPECT_NEAR(ribbon->area(), 0.2f * 3.f, 1e-5f);  // is one already
}

TEST(Curve, WrongOnesAreErrors) {
  EXPECT_NE(message("").find("\"P\""), std::string::npos);
  EXPECT_NE(message("\"point3 P\" [0 0 0  1 0 0  2 0 0]").find("control points"),
            std::string::npos);
  EXPECT_NE(message("\"integer degree\" 2 \"point3 P\" [0 0 0  1 0 0  2 0 0  3 0 0]")
                .find("control points"),
            std::string::npos);
  EXPECT_NE(message(std::string("\"integer degree\" 4 ") + straight).find("degree"),
            std::string::npos);
  EXPECT_NE(message(std::string("\"string type\" \"ribbon\" ") + straight).find("2 normals"),
            std::string::npos);
  EXPECT_NE(message(std::string("\"normal N\" [0 0 1  0 0 1] ") + straight).find("ribbons"),
            std::string::npos);
  EXPECT_NE(message(std::string("\"float width\" 0 ") + straight).find("width"), std::string::npos);
  EXPECT_NE(message(std::string("\"float width1\" -1 ") + straight).find("negative"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
