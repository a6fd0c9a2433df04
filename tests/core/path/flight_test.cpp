// Rays through media and past surfaces that only bound them.
#include "core/path/flight.h"

#include <gtest/gtest.h>

#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

// Vacuum to z = 1, "a" to z = 3, "b" inside it from 2 to 2.5, a wall at z = 4.
constexpr const char* layers = R"(
Camera "perspective"
WorldBegin
LightSource "point"
MakeNamedMedium "a" "string type" "homogeneous" "rgb sigma_a" [ .1 .2 .3 ] "rgb sigma_s" [ .4 0 1 ]
MakeNamedMedium "b" "string type" "homogeneous" "rgb sigma_a" [ 1 2 0 ] "rgb sigma_s" [ 0 0 0 ]
AttributeBegin
  Material "interface"
  MediumInterface "" "a"
  Shape "disk" "float height" 1 "float radius" 10
  MediumInterface "a" "b"
  Shape "disk" "float height" 2 "float radius" 10
  MediumInterface "b" "a"
  Shape "disk" "float height" 2.5 "float radius" 10
  MediumInterface "a" ""
  Shape "disk" "float height" 3 "float radius" 10
AttributeEnd
Shape "disk" "float height" 4 "float radius" 10
)";

class Layers : public testing::Test {
 protected:
  Layers() : built_(build_text({.scene = layers})) {}
  const Scene& scene() const { return *built_.scene; }
  static Rgb expected() {
    return glm::exp(-(1.5f * Rgb(.5f, .2f, 1.3f) + .5f * Rgb(1.f, 2.f, 0.f)));
  }
  BuiltScene built_;
  const Ray ray_{vec3(0.f), vec3(0.f, 0.f, 1.f), infinity};
};

TEST_F(Layers, ConnectionsMultiplyWhatTheyCross) {
  const Passage all = passage(scene(), {ray_.origin, ray_.direction, 3.9f}, nullptr);
  EXPECT_EQ(all.visibility, 1.f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(all.transmittance[c], expected()[c], 1e-5f);
  const Passage blocked = passage(scene(), {ray_.origin, ray_.direction, 4.1f}, nullptr);
  EXPECT_EQ(blocked.visibility, 0.f);
  const Passage back = passage(scene(), {vec3(0.f, 0.f, 3.9f), -ray_.direction, 3.9f}, nullptr);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.transmittance[c], expected()[c], 1e-5f);
}

// Flights end in every layer as often as the density says, and their weights are unbiased: the mean
// of the weight of those that get to the wall is the transmittance. Six sigma.
TEST_F(Layers, FlightsEndAsTheirDensitySays) {
  constexpr int flights = 100'000;
  dvec3 sum(0.0), squares(0.0);
  int walls = 0, in_a = 0, in_b = 0;
  for (int i = 0; i < flights; ++i) {
    Surface at;
    Flight flight;
    const EdgeNumbers u{0.f, (static_cast<float>(i) + .5f) / flights};
    const Arrival arrival = fly(scene(), ray_, nullptr, u, at, flight);
    ASSERT_TRUE(arrival == Arrival::surface || arrival == Arrival::medium);
    if (arrival == Arrival::medium) {
      const float z = at.hit.position.z;
      ASSERT_TRUE(z >= 1.f && z <= 3.f);
      EXPECT_NEAR(at.hit.distance, z, 1e-5f);
      EXPECT_EQ(at.hit.primitive, nullptr);
      const bool b = z > 2.f && z < 2.5f;
      ++(b ? in_b : in_a);
      EXPECT_EQ(at.point().extinction, b ? Rgb(1.f, 2.f, 0.f) : Rgb(.1f + .4f, .2f, .3f + 1.f));
      continue;
    }
    ++walls;
    EXPECT_NEAR(at.hit.distance, 4.f, 1e-5f);
    EXPECT_EQ(at.medium, nullptr);
    sum += dvec3(flight.weight());
    squares += dvec3(flight.weight()) * dvec3(flight.weight());
  }
  const double pass = static_cast<double>(mean(expected()));
  // Equidistant numbers: the errors are those of the grid.
  EXPECT_NEAR(static_cast<double>(walls) / flights, pass, 1e-4);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / flights, expected()[c], 1e-3);
  EXPECT_GT(in_a, 1000);
  EXPECT_GT(in_b, 1000);
}

TEST_F(Layers, SurfacesThatBoundMediaCannotBeSeen) {
  Hit hit;
  ASSERT_TRUE(scene().intersect(ray_, 0.f, hit));
  EXPECT_NEAR(hit.position.z, 4.f, 1e-5f);
  EXPECT_NEAR(hit.distance, 4.f, 1e-5f);
  EXPECT_EQ(scene().visibility({ray_.origin, ray_.direction, 3.9f}), 1.f);
  EXPECT_EQ(scene().visibility({ray_.origin, ray_.direction, 4.1f}), 0.f);
}

}  // namespace
}  // namespace pssmlt::test
