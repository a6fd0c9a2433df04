// Scenes whose surfaces disagree about the media between them are told so, others are not.
#include "core/scene/media_check.h"

#include <gtest/gtest.h>

#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

const std::string head = R"(
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [ .1 .1 .1 ] "rgb sigma_a" [ 0 0 0 ]
MakeNamedMedium "milk" "string type" "homogeneous" "rgb sigma_s" [ 9 9 9 ] "rgb sigma_a" [ 0 0 0 ]
MediumInterface "" "fog"
LookAt 0 1 -6  0 .6 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
WorldBegin
LightSource "point" "point3 from" [ 0 3 0 ]
MediumInterface "" "fog"
Shape "sphere" "float radius" 20
)";

std::string warning_of(const std::string& text) {
  const BuiltScene built = build_text({.scene = text});
  for (const std::string& line : built.warnings)
    if (line.find("media contradict") != std::string::npos) return line;
  return "";
}

// The room's outer side is where the fog is said to be, so it must be turned inside out.
std::string room(const std::string& content) {
  std::string text = head;
  text.insert(text.rfind("Shape"), "ReverseOrientation\n");
  return text + "ReverseOrientation\n" + content;
}

TEST(MediaCheck, SaysNothingOfScenesThatFit) {
  EXPECT_EQ(warning_of(room("")), "");
  EXPECT_EQ(warning_of(room("Shape \"sphere\"\n")), "");
  EXPECT_EQ(warning_of(room("Material \"dielectric\" MediumInterface \"milk\" \"fog\"\n"
                            "Shape \"sphere\"\n")),
            "");
  // A smaller ball inside the other, and a boundary that cannot be seen.
  EXPECT_EQ(
      warning_of(room("Material \"interface\" MediumInterface \"milk\" \"fog\"\n"
                      "Shape \"sphere\"\nMaterial \"diffuse\"\nMediumInterface \"\" \"milk\"\n"
                      "Shape \"sphere\" \"float radius\" .5\n")),
      "");
}

TEST(MediaCheck, NamesSurfacesThatDisagree) {
  EXPECT_NE(warning_of(head).find("sphere"), std::string::npos);
  const std::string ball =
      warning_of(room("Material \"dielectric\" MediumInterface \"milk\" \"\"\nShape \"sphere\"\n"));
  EXPECT_NE(ball.find("test-scene:1"), std::string::npos) << ball;
  EXPECT_NE(ball.find("disagree about what lies between"), std::string::npos) << ball;
  // The same every time.
  EXPECT_EQ(ball,
            warning_of(
                room("Material \"dielectric\" MediumInterface \"milk\" \"\"\nShape \"sphere\"\n")));
}

TEST(MediaCheck, AsksNothingWhereThereAreNoMedia) {
  const BuiltScene built = build_text({.scene = "WorldBegin\nShape \"sphere\"\n"});
  EXPECT_EQ(contradicting_media(*built.scene), "");
}

}  // namespace
}  // namespace pssmlt::test
