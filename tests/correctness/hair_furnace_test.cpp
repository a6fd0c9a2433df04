// White hair under a white sky cannot be seen, whatever the roughness, the form of the curves and
// the number of fibres that light passes on its way.
//
// False alarms: below 10^-6, 33 comparisons at 3e-8. Errors of half a per cent of a block are
// found.
#include <gtest/gtest.h>

#include "tests/support/agreement.h"

namespace pssmlt::test {
namespace {

std::string tuft() {
  std::string text = R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
PixelFilter "box"
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 30
Integrator "path" "integer maxdepth" 200
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
)";
  const char* const kinds[] = {R"("string type" "flat")",
                               R"("string type" "cylinder" "bool sheet" false)",
                               R"("string type" "ribbon" "normal N" [ .3 0 -1  1 .2 -1 ])"};
  for (int i = 0; i < 18; ++i)
    text += fmt::format(
        "Material \"hair\" \"rgb sigma_a\" [ 0 0 0 ] \"float beta_m\" {} \"float beta_n\" {}\n"
        "Shape \"curve\" {} \"float width\" .15 \"point3 P\" [ {} -1 0  0 -.3 {}  {} .4 0  0 1 .2 "
        "]\n",
        .1 + .05 * i, .95 - .05 * i, kinds[i % 3], .1 * (i - 9), .1 * (i % 4), .15 * (9 - i));
  return text;
}

TEST(HairFurnace, WhiteHairIsNotSeen) {
  constexpr int renders = 32;
  const Job job{.scene = tuft(), .integrator = "path", .sampler = "independent", .spp = 128};
  const Blocks blocks = summarise(render_blocks(job, renders, 4));
  const double limit = student_limit(3e-8, renders - 1);
  for (const Estimate& e : blocks.estimates) {
    EXPECT_NEAR(e.mean, 1.0, limit * e.error() + 2e-4);
    EXPECT_LT(limit * e.error(), 2e-2);
  }
  EXPECT_LT(limit * blocks.estimates.back().error(), 5e-3);
}

}  // namespace
}  // namespace pssmlt::test
