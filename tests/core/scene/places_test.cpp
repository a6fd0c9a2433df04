// What loading says of places that floats cannot hold.
#include <gtest/gtest.h>

#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

bool warns(const std::string& world, const std::string& text) {
  const std::string scene =
      "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n" +
      world;
  for (const std::string& line : build_text({.scene = scene}).warnings) {
    if (line.find(text) != std::string::npos) return true;
  }
  return false;
}

std::string triangle_at(double x) {
  const auto number = [](double v) { return std::to_string(v) + " "; };
  return "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point3 P\" [ " + number(x) +
         "0 0 " + number(x + 1) + "0 0 " + number(x) + "1 0 ]\n";
}

TEST(Places, FarCoordinatesAreTold) {
  const std::string text = "far from the origin";
  EXPECT_TRUE(warns(triangle_at(1e6), text));
  EXPECT_TRUE(warns(triangle_at(5e4), text));
  EXPECT_FALSE(warns(triangle_at(1e3), text));
  EXPECT_FALSE(warns("Translate 1e6 0 0\n" + triangle_at(0), text));
  EXPECT_FALSE(warns("Translate 1e6 0 0\nShape \"sphere\"\n", text));
}

const std::string glass = "Material \"dielectric\"\n";
std::string disk(double height) {
  return "Shape \"disk\" \"float radius\" 2 \"float height\" " + std::to_string(height) + "\n";
}

TEST(Places, TouchingGlassIsTold) {
  const std::string text = "so close to each other";
  EXPECT_TRUE(warns(glass + disk(0) + disk(0), text));
  EXPECT_TRUE(warns(glass + disk(.5) + disk(0) + "ReverseOrientation\n" + disk(0), text));
  EXPECT_FALSE(warns(glass + disk(0) + disk(.01), text));
  EXPECT_FALSE(warns(disk(0) + disk(0), text));  // paint upon paint is the same from both sides
  EXPECT_FALSE(warns(glass + disk(0), text));
  EXPECT_FALSE(warns(glass + "Shape \"sphere\"\nTranslate 2 0 0\nShape \"sphere\"\n", text));
}

}  // namespace
}  // namespace pssmlt::test
