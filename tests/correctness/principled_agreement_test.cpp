// Rays from the camera and rays from the lights agree on the principled material, lobes of which
// reflect, pass and refract by wavelength, and on lights whose emission a texture varies, by blocks
// of pixels.
//
// False alarms: below 10^-6 a test. Power: 0.99 against an error of 4 % that all blocks have, and
// of 30 % in one block alone, computed from the errors measured and asserted.
#include <gtest/gtest.h>

#include "tests/correctness/classes.h"
#include "tests/correctness/scenes.h"
#include "tests/support/agreement.h"

namespace pssmlt::test {
namespace {

constexpr int edge = 8;      // of a block [pixels]
constexpr int renders = 24;  // of each technique, at least
constexpr Demand demand{4e-7, .3, .04};
constexpr Precision reference_goal{.016, .002};

std::string furnished_room() {
  return std::string(R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
PixelFilter "triangle" "float xradius" 1.5 "float yradius" 1.5
LookAt 0 1 -3.2  0 1 0  0 1 0
Camera "perspective" "float fov" 34
Integrator "path" "integer maxdepth" 4
WorldBegin
)") + room +
         R"(
AttributeBegin
  Texture "slide" "spectrum" "checkerboard" "float uscale" 3 "float vscale" 3
    "rgb tex1" [ 9 8 7 ] "rgb tex2" [ 2 1 3 ]
  AreaLightSource "diffuse" "texture L" "slide"
  Shape "bilinearmesh" "point3 P" [ -.4 1.98 -.4  .4 1.98 -.4  -.4 1.98 .4  .4 1.98 .4 ]
    "point2 uv" [ 0 0  1 0  0 1  1 1 ]
AttributeEnd
AttributeBegin
  Translate -.6 .4 .2
  Material "principled" "rgb basecolor" [ .8 .5 .2 ] "float metallic" .6 "float roughness" .5
    "float anisotropy" .7 "float clearcoat" .8 "float clearcoatroughness" .4
  Shape "sphere" "float radius" .32
AttributeEnd
AttributeBegin
  Translate .1 .4 .1
  Material "principled" "rgb basecolor" [ .9 .9 .7 ] "float transmission" .9 "float roughness" .55
    "float thickness" 1 "float ior" 1.4 "float dispersion" 2
    "rgb sheencolor" [ .2 .3 .4 ] "float sheenroughness" .5
  Shape "sphere" "float radius" .32
AttributeEnd
AttributeBegin
  Material "principled" "rgb basecolor" [ .5 .8 .6 ] "float transmission" .8 "float roughness" .6
  Shape "bilinearmesh" "point3 P" [ .5 .1 -.2  .9 .1 .2  .5 .9 -.2  .9 .9 .2 ]
AttributeEnd
)";
}

TEST(PrincipledAgreement, AcrossTechniques) {
  Job job{.scene = furnished_room(), .sampler = "independent"};
  for (const char* other : {"bdpt", "light"}) {
    job.set = {"integrator.paths=" + both(sees("path"), sees(other))};
    job.integrator = "path";
    const Blocks truth = render_to_precision(job, renders, edge, reference_goal, 2048);
    job.integrator = other;
    expect_agreement(
        render_to_precision(job, renders, edge, left_over(demand, truth, renders), 4096), truth,
        demand, other);
  }
}

}  // namespace
}  // namespace pssmlt::test
