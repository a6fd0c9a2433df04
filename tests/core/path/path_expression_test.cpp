#include "core/path/path_expression.h"

#include <gtest/gtest.h>

#include "core/scene/features.h"

namespace pssmlt {
namespace {

struct Row {
  const char* expression;
  std::vector<std::string> matching, others;
};

const Row table[] = {
    {"L.*E", {"AE", "IE", "PE", "ADE", "PSDSSE"}, {"", "A", "E", "DE", "AXE", "AEE"}},
    {"LS*E", {"AE", "ISE", "PSSE"}, {"ADE", "ASDE"}},
    {"LS+DS*E", {"ASDE", "PSSDSE"}, {"ADE", "SDE", "ASE", "ASDDE"}},
    {"AE|I.*E|PD.*E", {"AE", "IE", "IDSE", "PDE", "PDSE"}, {"ADE", "PE", "PSDE"}},
    {"(A|P)(DS)+E", {"ADSE", "PDSDSE"}, {"AE", "ADE", "IDSE", "ADSDE"}},
    {"L.?D?E", {"AE", "ADE", "ASDE", "IDDE"}, {"ADSE", "ADDDE"}},
    {"L.*D.*E & L.*S.*E", {"ADSE", "ASDE"}, {"ADE", "ASE", "AE"}},
    {" A ( D | S ) * E ", {"AE", "ASDE"}, {"IE"}},
    {"AE&IE", {}, {"AE", "IE"}},
};

TEST(PathExpression, MatchesTable) {
  for (const Row& row : table) {
    const PathExpression e(row.expression);
    for (const auto& path : row.matching) EXPECT_TRUE(e.matches(path)) << row.expression << path;
    for (const auto& path : row.others) EXPECT_FALSE(e.matches(path)) << row.expression << path;
  }
}

// All paths of up to six scattering vertices, from every light.
std::vector<std::string> all_paths() {
  std::vector<std::string> out;
  for (const char light : {'A', 'I', 'P'})
    for (unsigned length = 0; length <= 6; ++length)
      for (unsigned bits = 0; bits < (1u << length); ++bits) {
        std::string path(1, light);
        for (unsigned i = 0; i < length; ++i) path += (bits >> i & 1u) != 0 ? 'S' : 'D';
        out.push_back(path + "E");
      }
  return out;
}

LightLetter letter(char c) {
  return c == 'A' ? LightLetter::area : c == 'I' ? LightLetter::infinite : LightLetter::delta;
}

// Wherever a path is cut, the two ends agree on whether the whole matches.
TEST(PathExpression, JoinsFromBothEndsEqualMatches) {
  for (const Row& row : table) {
    const PathExpression e(row.expression);
    bool all = true;
    for (const std::string& path : all_paths()) {
      const bool expected = e.matches(path);
      all &= expected;
      const size_t vertices = path.size() - 2;
      for (size_t cut = 0; cut <= vertices; ++cut) {
        auto l = e.from_light(letter(path[0]));
        for (size_t i = 1; i <= cut; ++i) l = e.light_step(l, path[i] == 'S');
        auto c = e.from_camera();
        for (size_t i = vertices; i > cut; --i) c = e.camera_step(c, path[i] == 'S');
        EXPECT_EQ(e.joins(l, c), expected) << row.expression << " " << path << " cut " << cut;
        if (expected) {
          EXPECT_FALSE(e.light_dead(l) || e.camera_dead(c)) << row.expression << " " << path;
        }
      }
    }
    EXPECT_EQ(e.accepts_all(), all) << row.expression;
  }
}

TEST(PathExpression, DeadStatesStopHopelessPaths) {
  const PathExpression e("LSE");
  EXPECT_TRUE(e.camera_dead(e.camera_step(e.from_camera(), false)));
  EXPECT_FALSE(e.camera_dead(e.camera_step(e.from_camera(), true)));
  EXPECT_TRUE(e.light_dead(e.light_step(e.from_light(LightLetter::area), false)));
}

TEST(PathExpression, DisjointKnowsTheScene) {
  SceneFeatures scene;
  scene.connectible = true;
  scene.delta_lights = true;
  const PathExpression hits("(A|I).*E"), next("LD.*E"), caustics("LS+D.*E");
  EXPECT_TRUE(PathExpression::disjoint(hits, PathExpression(), scene, 0, 5));
  EXPECT_FALSE(PathExpression::disjoint(next, PathExpression(), scene, 0, 5));
  EXPECT_TRUE(PathExpression::disjoint(next, PathExpression(), scene, 0, 0));
  EXPECT_TRUE(PathExpression::disjoint(caustics, PathExpression(), scene, 0, 65535));
  scene.specular = true;
  EXPECT_FALSE(PathExpression::disjoint(caustics, PathExpression(), scene, 2, 2));
  EXPECT_TRUE(PathExpression::disjoint(caustics, next, scene, 0, 65535));
}

TEST(PathExpression, RefusesBrokenText) {
  for (const std::string text :
       {"", "(", ")", "L.*E)", "(L.*E", "*E", "L.*X", "L||E", "L&", "|", "L+*+?&&E"}) {
    EXPECT_THROW(PathExpression{text}, Error) << text;
  }
  EXPECT_THROW(PathExpression(std::string(2000, 'D')), Error);
  EXPECT_THROW(PathExpression(std::string(300, 'D')), Error);
  EXPECT_THROW(PathExpression(std::string(900, '(')), Error);
  // Needs exponentially many states.
  std::string hard = "L.*D";
  for (int i = 0; i < 40; ++i) hard += ".";
  EXPECT_THROW(PathExpression(hard + "E"), Error);
  try {
    PathExpression("L.*xE");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("'x' at character 4"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace pssmlt
