// Rays from the camera and rays from the lights give the same picture: lights that show an image
// and cameras that see all around, on rooms of their own, by blocks of 8 x 8 pixels.
//
// False alarms: below 10^-6 for each test. Power: 0.99 against an error of 2 % that all blocks
// have, and of 20 % in one block alone, computed from the errors measured and asserted.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/image/image.h"
#include "tests/correctness/classes.h"
#include "tests/correctness/scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt::test {
namespace {

constexpr int edge = 8;      // of a block [pixels]
constexpr int renders = 24;  // of each technique, at least
constexpr Demand demand{2.5e-7, .2, .02};
constexpr Precision reference_goal{.01, .0011};

// Random pixels, some of them black.
std::string slide_file() {
  Image image(8, 8, 3);
  RandomStream random(21, RandomUse::test);
  for (size_t i = 0; i < image.data.size(); i += 3) {
    const bool is_black = random.next() < 0.2f;
    for (size_t c = 0; c < 3; ++c) image.data[i + c] = is_black ? 0.f : 0.2f + random.next();
  }
  const std::string file = test::own_file("agreement-slide.pfm");
  write_image(file, image, {}, {});
  return file;
}

constexpr const char* frame_of_32 = R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
PixelFilter "triangle" "float xradius" 1.5 "float yradius" 1.5
)";

std::string lit_by_images() {
  const std::string file = "\"string filename\" \"" + slide_file() + "\"";
  return std::string(frame_of_32) + R"(
LookAt 0 1 -3.2  0 1 0  0 1 0
Camera "perspective" "float fov" 34
Integrator "path" "integer maxdepth" 3
WorldBegin
)" + room +
         R"(
AttributeBegin
  Translate .2 1.3 -.3  Rotate 30 1 2 3
  LightSource "goniometric" "rgb I" [ .5 .4 .3 ] )" +
         file + R"(
AttributeEnd
AttributeBegin
  Translate .3 .8 -.7  Rotate -25 0 1 0
  LightSource "projection" "float scale" 1.5 )" +
         file + R"(
AttributeEnd
)";
}

// Light from outside through the room's open wall, and from a lamp that is not seen.
std::string lit_through(const std::string& portal) {
  return std::string(frame_of_32) + R"(
LookAt 0 1 -3.2  0 1 0  0 1 0
Camera "perspective" "float fov" 34
Integrator "path" "integer maxdepth" 2
WorldBegin
)" + room +
         R"(
LightSource "infinite" "rgb L" [ .3 .3 .4 ] )" +
         portal + R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 2 1 1 ]
  Translate .3 .6 -.2
  Shape "sphere" "float radius" .3 "float alpha" 0
AttributeEnd
)";
}

std::string seen_all_around(const std::string& mapping) {
  return std::string(frame_of_32) + R"(
Translate 0 -.9 .1
Camera "spherical" "string mapping" ")" +
         mapping + R"("
Integrator "path" "integer maxdepth" 2
WorldBegin
)" + room +
         R"(
LightSource "point" "rgb I" [ .2 .3 .6 ] "point3 from" [ -.6 .5 -.6 ]
LightSource "infinite" "rgb L" [ .3 .3 .4 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
)";
}

// A room behind lenses, and the irradiance of a part of its floor and of a ball in it.
std::string seen_by(const std::string& camera, const std::string& film) {
  std::string frame = frame_of_32;
  frame.insert(frame.find('"', frame.find("rgb") + 4), film);
  return frame + camera + R"(
Integrator "path" "integer maxdepth" 2
WorldBegin
)" + room +
         R"(
LightSource "point" "rgb I" [ .2 .3 .6 ] "point3 from" [ -.6 1.4 -.6 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
  Shape "bilinearmesh" "point3 P" [ -.3 1.98 -.3  .3 1.98 -.3  -.3 1.98 .3  .3 1.98 .3 ]
AttributeEnd
)";
}

std::string behind_lenses() {
  const std::string file = test::own_file("agreement-lens.dat");
  std::ofstream(file) << "60 8 1.6 50\n-90 3 1 50\n0 60 0 36\n";
  return seen_by("LookAt 0 1 -3.2  0 1 0  0 1 0\nCamera \"realistic\" \"string lensfile\" \"" +
                     file + "\" \"float aperturediameter\" 24 \"float focusdistance\" 3\n",
                 "\"float diagonal\" 40 ");
}

// `more`: paths that both find besides what they say before they know the camera.
void expect_same_picture(const std::string& scene, const std::string& more = "") {
  Job job{.scene = scene, .sampler = "independent"};
  for (const char* other : {"bdpt", "light"}) {
    job.set = {"integrator.paths=" + both(sees("path") + more, sees(other) + more)};
    job.integrator = "path";
    const Blocks truth = render_to_precision(job, renders, edge, reference_goal, 2048);
    job.integrator = other;
    expect_agreement(
        render_to_precision(job, renders, edge, left_over(demand, truth, renders), 4096), truth,
        demand, other);
  }
}

TEST(EndpointAgreement, LightsThatShowImages) { expect_same_picture(lit_by_images()); }
TEST(EndpointAgreement, PortalAndHiddenLamp) {
  const std::string portal = R"("point3 portal" [ -1 0 -1  1 0 -1  1 2 -1  -1 2 -1 ])";
  expect_same_picture(lit_through(portal));
  Job job{.scene = lit_through(""), .integrator = "path", .sampler = "independent"};
  const Blocks without = render_to_precision(job, renders, edge, reference_goal, 2048);
  job.scene = lit_through(portal);
  expect_agreement(
      render_to_precision(job, renders, edge, left_over(demand, without, renders), 4096), without,
      demand, "portal");
}
TEST(EndpointAgreement, EqualAreaPanorama) { expect_same_picture(seen_all_around("equalarea")); }
TEST(EndpointAgreement, LongitudesPanorama) {
  expect_same_picture(seen_all_around("equirectangular"));
}
TEST(EndpointAgreement, BehindLenses) { expect_same_picture(behind_lenses()); }
TEST(EndpointAgreement, IrradianceOfTheFloor) {
  expect_same_picture(
      seen_by("Camera \"irradiance\" \"string surface\" \"rectangle\" \"vector3 normal\" [ 0 1 0 ]"
              " \"point3 position\" [ 0 .01 0 ] \"float width\" 1.6 \"float height\" 1.6\n",
              ""),
      "|PE");
}
TEST(EndpointAgreement, IrradianceOfABall) {
  expect_same_picture(
      seen_by("Camera \"irradiance\" \"string surface\" \"sphere\" \"vector3 normal\" [ 0 1 0 ]"
              " \"point3 position\" [ .2 1 .1 ] \"float radius\" .2\n",
              ""),
      "|PE");
}

}  // namespace
}  // namespace pssmlt::test
