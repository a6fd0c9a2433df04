// What moves while the shutter is open.
#include <gtest/gtest.h>

#include "core/base/warp.h"
#include "core/path/flight.h"
#include "tests/support/make_endpoint.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

constexpr const char* moving = R"(
TransformTimes 0 2
Camera "perspective" "float shutteropen" 0 "float shutterclose" 2
WorldBegin
LightSource "point"
AttributeBegin
  Translate 0 0 6
  ActiveTransform EndTime
  Translate 2 1 0
  Rotate 80 1 1 0
  Scale 1 2 1
  ActiveTransform All
  Shape "trianglemesh"
    "point3 P" [ 1 0 0  -1 0 0  0 1 0  0 -1 0  0 0 1  0 0 -1 ]
    "integer indices" [ 0 2 4  2 1 4  1 3 4  3 0 4  2 0 5  1 2 5  3 1 5  0 3 5 ]
AttributeEnd
)";

// The place that Embree finds and the one that is computed from the object's space are the same:
// they interpolate alike.
TEST(MotionBlur, HitsLieOnTheRay) {
  const BuiltScene built = build_text({.scene = moving});
  ASSERT_TRUE(built.scene->features().motion);
  RandomStream random(41, RandomUse::test);
  int found = 0;
  for (int i = 0; i < 4000; ++i) {
    const vec3 target = vec3(1.f, .5f, 6.f) + 2.f * uniform_sphere(draw2(random));
    const vec3 from = 3.f * uniform_sphere(draw2(random));
    const Ray ray{from, glm::normalize(target - from), infinity, random.next()};
    Hit hit;
    if (!built.scene->intersect(ray, 0.f, hit)) continue;
    ++found;
    const vec3 expected = ray.origin + hit.distance * ray.direction;
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(hit.position[k], expected[k], 2e-5f) << ray.time;
  }
  EXPECT_GT(found, 300);  // so many rays meet it at all
}

// Of the ray that is followed at a time, seen from the pose at that time.
TEST(MotionBlur, CamerasMove) {
  const BuiltScene built = build_text({.scene = R"(
ActiveTransform EndTime
Rotate 30 0 1 0
Translate 1 0 -2
ActiveTransform All
Camera "perspective" "float lensradius" .2 "float focaldistance" 3
WorldBegin
LightSource "point"
Shape "sphere")"});
  const Scene& scene = *built.scene;
  ASSERT_TRUE(scene.features().motion);
  RandomStream random(42, RandomUse::test);
  const dvec2 size(scene.frame().resolution);
  for (int i = 0; i < 500; ++i) {
    const vec2 lens = draw2(random);
    const dvec2 raster = dvec2(draw2(random)) * size;
    const float time = random.next();
    const auto e = scene.camera_emit(lens, raster, time);
    ASSERT_TRUE(e);
    const vec3 point = e->from.position + 4.f * e->direction;
    const auto t = scene.camera_toward(point, lens, time);
    ASSERT_TRUE(t);
    EXPECT_NEAR(t->raster.x, raster.x, 2e-2);
    EXPECT_NEAR(t->raster.y, raster.y, 2e-2);
    EXPECT_NEAR(scene.camera_pdf_toward(point, t->at, time) / t->pdf_toward, 1.f, 1e-3f);
  }
  const auto at_rest = scene.camera_emit(vec2(.5f), .5 * size, 0.f);
  const auto at_end = scene.camera_emit(vec2(.5f), .5 * size, 1.f);
  EXPECT_NEAR(glm::dot(at_rest->direction, at_end->direction), std::cos(glm::radians(30.f)), 1e-4f);
}

TEST(MotionBlur, CamerasKeepTheirScale) {
  EXPECT_THROW(build_text({.scene = R"(
ActiveTransform EndTime
Scale 1 2 1
ActiveTransform All
Camera "perspective"
WorldBegin
Shape "sphere")"}),
               Error);
}

// A dark board that travels leaves a trail that is wider and dark by as much in all.
TEST(MotionBlur, TrailsAreAsBrightAsWhatLeavesThem) {
  const auto picture = [](const std::string& motion) {
    return render_text({.scene = R"(
Film "rgb" "integer xresolution" 64 "integer yresolution" 16
PixelFilter "box"
Camera "orthographic" "float screenwindow" [ -4 4 -1 1 ]
Integrator "path" "integer maxdepth" 1
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "diffuse" "rgb reflectance" [ 0 0 0 ]
Translate -1 0 3
)" + motion + R"(
Shape "bilinearmesh" "point3 P" [ -.5 -1 0  .5 -1 0  -.5 1 0  .5 1 0 ])",
                        .integrator = "path",
                        .sampler = "independent",
                        .spp = 256},
                       1)
        .image;
  };
  const Image still = picture("");
  const Image trail = picture("ActiveTransform EndTime Translate 2 0 0 ActiveTransform All");
  const double dark_still = 1.0 - block_means(still, 0)[0];
  const double dark_trail = 1.0 - block_means(trail, 0)[0];
  EXPECT_NEAR(dark_still, 1.0 / 8.0, 1e-3);
  EXPECT_NEAR(dark_trail, dark_still, 3e-3);  // 256 samples in 256 pixels: 6 sigma is 0.005 or so
  // Between x = -1 and 0: it is there for half of the time from -.5 on, and from -1 to -.5 for a
  // share that grows from a quarter to a half.
  const std::vector<double> blocks = block_means(trail, 8);
  EXPECT_NEAR(blocks[3], 1.0 - (.5 * .5 + .5 * .375), .01);
}

}  // namespace
}  // namespace pssmlt::test
