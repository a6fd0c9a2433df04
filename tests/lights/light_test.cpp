// Lights: parameters, magnitudes and errors.
#include <gtest/gtest.h>

#include "core/base/lat_long.h"
#include "core/base/warp.h"
#include "core/image/image.h"
#include "tests/support/make_endpoint.h"

namespace pssmlt {
namespace {

using namespace test;

Rgb toward(const Light& light, const vec3& reference) {
  const auto t = light.toward(reference, {0.3f, 0.6f});
  return t ? t->value : Rgb(0.f);
}
std::string message(const std::string& text) {
  return error_of([&] { make_light(text); });
}
// Mean weight of emitted rays: the power [W].
double emitted_power(const Light& light, int n = 100'000) {
  RandomStream random(5, RandomUse::test);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const vec2 position = draw2(random);
    const vec2 direction = draw2(random);
    if (const auto e = light.emit(position, dvec2(direction))) sum += luminance(e->weight());
  }
  return sum / n;
}
std::string write(const std::string& name, const Image& image) {
  const std::string file = testing::TempDir() + name;
  write_image(file, image, {}, {});
  return file;
}

TEST(PointLight, ScaleAndPower) {
  const std::string point = "LightSource \"point\" ";
  EXPECT_EQ(toward(*make_light(point), {0.f, 0.f, 2.f}), Rgb(1.f));
  EXPECT_EQ(toward(*make_light(point + "\"rgb I\" [1 2 4] \"float scale\" 3"), {1.f, 0.f, 0.f}),
            Rgb(3.f, 6.f, 12.f));
  const auto powered = make_light(point + "\"float power\" 100");
  EXPECT_NEAR(powered->power(), 100.f, 1e-4f);
  EXPECT_NEAR(emitted_power(*powered), 100.0, 1e-3);
  EXPECT_TRUE(powered->traits().delta_position);
  const auto moved = make_light("Translate 1 2 3 " + point + "\"point3 from\" [1 0 0]");
  EXPECT_EQ(moved->toward({0.f, 0.f, 0.f}, vec2(0.f))->at.position, vec3(2.f, 2.f, 3.f));
  EXPECT_NE(message(point + "\"float scale\" -1").find("test:2:"), std::string::npos);
}

// A spectrum is normalised to unit luminance, whatever its magnitude.
TEST(PointLight, BlackbodyHasUnitLuminance) {
  const auto light = make_light("LightSource \"point\" \"blackbody I\" 5000 \"float scale\" 2");
  EXPECT_NEAR(luminance(toward(*light, {1.f, 0.f, 0.f})), 2.f, 2e-3f);
}

TEST(SpotLight, FalloffAndPower) {
  const std::string spot =
      "LightSource \"spot\" \"float coneangle\" 60 \"float conedeltaangle\" 30 ";
  const auto at = [](float degrees) {
    const float a = degrees * pi / 180.f;
    return vec3(std::sin(a), 0.f, std::cos(a));
  };
  const auto light = make_light(spot);
  EXPECT_EQ(toward(*light, at(29.f)), Rgb(1.f));
  EXPECT_EQ(toward(*light, at(61.f)), Rgb(0.f));
  // Halfway in cosine, the smooth step is 1/2.
  const float half = 0.5f * (std::cos(60.f * pi / 180.f) + std::cos(30.f * pi / 180.f));
  EXPECT_NEAR(toward(*light, {std::sqrt(1.f - half * half), 0.f, half}).x, 0.5f, 1e-4f);
  const auto powered = make_light(spot + "\"float power\" 50");
  EXPECT_NEAR(powered->power(), 50.f, 1e-4f);
  EXPECT_NEAR(emitted_power(*powered), 50.0, 1e-2);
  EXPECT_NE(message("LightSource \"spot\" \"float coneangle\" 200").find("coneangle"),
            std::string::npos);
  EXPECT_NE(message("LightSource \"spot\" \"point3 to\" [0 0 0]").find("\"to\""),
            std::string::npos);
}

// The image's z axis is the light's y axis; red, green and blue count alike.
TEST(GoniometricLight, AxesAndPower) {
  Image image(2, 2, 3);  // texels are octants' pairs: (x < 0 | x > 0) by (z < 0 | z > 0)
  for (int i = 0; i < 12; ++i) image.data[static_cast<size_t>(i)] = static_cast<float>(i / 3 + 1);
  image.data[0] = 3.f;  // with 1 and 1: mean 5/3
  const std::string goniometric = "LightSource \"goniometric\" ";
  const std::string shown =
      goniometric + "\"string filename\" \"" + write("pssmlt-gonio.pfm", image) + "\" ";
  const auto light = make_light("Translate 1 2 3 " + shown + "\"rgb I\" [2 4 6]");
  const vec3 at(1.f, 2.f, 3.f);
  for (const float y : {-0.5f, 0.5f}) {
    EXPECT_LT(
        glm::distance(toward(*light, at + vec3(-1.f, y, -1.f)), Rgb(2.f, 4.f, 6.f) * 5.f / 3.f),
        1e-5f);
    EXPECT_EQ(toward(*light, at + vec3(1.f, y, -1.f)), Rgb(4.f, 8.f, 12.f));
    EXPECT_EQ(toward(*light, at + vec3(-1.f, y, 1.f)), Rgb(6.f, 12.f, 18.f));
    EXPECT_EQ(toward(*light, at + vec3(1.f, y, 1.f)), Rgb(8.f, 16.f, 24.f));
  }
  const auto powered = make_light(shown + "\"float power\" 60");
  EXPECT_NEAR(powered->power(), 60.f, 1e-4f);
  EXPECT_NEAR(emitted_power(*powered), 60.0, 1e-2);
  EXPECT_EQ(toward(*make_light(goniometric + "\"rgb I\" [1 2 4]"), {1.f, 2.f, 0.f}),
            Rgb(1.f, 2.f, 4.f));
  const std::string wide = "\"string filename\" \"" + write("pssmlt-wide.pfm", Image(4, 2, 3));
  EXPECT_NE(message(goniometric + wide + "\"").find("square"), std::string::npos);
  EXPECT_NE(message(goniometric + "\"float scale\" -1").find("scale"), std::string::npos);
}

// Upright, unmirrored, with the angle of view along the shorter side.
TEST(ProjectionLight, ImageAndPower) {
  const std::string projection = "LightSource \"projection\" ";
  const auto show = [&](const Image& image) {
    return projection + "\"string filename\" \"" + write("pssmlt-slide.pfm", image) + "\" ";
  };
  Image wide(2, 1, 3), high(1, 2, 3);
  wide.data = {1.f, 0.f, 0.f, 0.f, 0.f, 2.f};
  high.data = {0.f, 3.f, 0.f, 4.f, 0.f, 0.f};
  const auto slide = make_light(show(wide) + "\"float scale\" 2");
  EXPECT_EQ(toward(*slide, {-1.f, 0.f, 1.f}), Rgb(2.f, 0.f, 0.f));
  EXPECT_EQ(toward(*slide, {1.98f, -0.98f, 1.f}), Rgb(0.f, 0.f, 4.f));
  EXPECT_EQ(toward(*slide, {2.02f, 0.f, 1.f}), Rgb(0.f));
  EXPECT_EQ(toward(*slide, {0.f, 1.02f, 1.f}), Rgb(0.f));
  EXPECT_EQ(toward(*slide, {0.f, 0.f, -1.f}), Rgb(0.f));
  const auto upright = make_light(show(high));
  EXPECT_EQ(toward(*upright, {0.f, 1.9f, 1.f}), Rgb(0.f, 3.f, 0.f));
  EXPECT_EQ(toward(*upright, {0.f, -1.9f, 1.f}), Rgb(4.f, 0.f, 0.f));
  const auto narrow = make_light(show(high) + "\"float fov\" 53.1301");  // half as wide
  EXPECT_EQ(toward(*narrow, {0.f, 0.98f, 1.f}), Rgb(0.f, 3.f, 0.f));
  EXPECT_EQ(toward(*narrow, {0.f, 1.02f, 1.f}), Rgb(0.f));
  // White through one face of a cube.
  Image white(3, 3, 3);
  for (float& v : white.data) v = 1.f;
  EXPECT_NEAR(make_light(show(white))->power(), 2.f * pi / 3.f, 1e-5f);
  const auto powered = make_light(show(wide) + "\"float power\" 60");
  EXPECT_NEAR(powered->power(), 60.f, 1e-4f);
  EXPECT_NEAR(emitted_power(*powered), 60.0, 0.2);
  EXPECT_NE(message(projection).find("filename is needed"), std::string::npos);
  EXPECT_NE(message(show(wide) + "\"float fov\" 180").find("fov"), std::string::npos);
  EXPECT_NE(message(show(Image(2, 2, 3)) + "\"float power\" 1").find("black"), std::string::npos);
}

TEST(DistantLight, Illuminance) {
  const auto light = make_light(
      "LightSource \"distant\" \"point3 from\" [0 5 0] \"point3 to\" [0 0 0]"
      " \"float illuminance\" 7 \"float scale\" 2");
  const auto t = light->toward({1.f, 2.f, 3.f}, vec2(0.5f));
  EXPECT_EQ(t->wi, vec3(0.f, 1.f, 0.f));
  EXPECT_EQ(t->distance, infinity);
  EXPECT_EQ(t->value, Rgb(14.f));
  EXPECT_TRUE(light->traits().infinite && light->traits().delta_direction);
}

TEST(InfiniteLight, ConstantAndIlluminance) {
  const std::string infinite = "LightSource \"infinite\" ";
  EXPECT_EQ(make_light(infinite)->background({0.f, 1.f, 0.f}), Rgb(1.f));
  EXPECT_EQ(
      make_light(infinite + "\"rgb L\" [1 2 3] \"float scale\" 2")->background({1.f, 0.f, 0.f}),
      Rgb(2.f, 4.f, 6.f));
  const auto bright = make_light(infinite + "\"float illuminance\" 10");
  EXPECT_NEAR(bright->background({0.f, 0.f, 1.f}).x, 10.f / pi, 1e-5f);
  bright->prepare({vec3(1.f, 2.f, 3.f), 2.f});
  EXPECT_NEAR(bright->power(), 10.f / pi * 4.f * pi * pi * 4.f, 1e-2f);
  EXPECT_NEAR(emitted_power(*bright), bright->power(), 1e-3 * bright->power());
}

// Positions of rays from infinity fill the disk around the scene.
TEST(InfiniteLight, PositionsFillTheDisk) {
  const auto light = make_light("LightSource \"infinite\"");
  const vec3 center(1.f, 2.f, 3.f);
  light->prepare({center, 2.f});
  RandomStream random(3, RandomUse::test);
  double sum = 0.0;
  constexpr int n = 20'000;
  for (int i = 0; i < n; ++i) {
    const vec2 u = draw2(random);
    const auto e = light->emit(u, dvec2(draw2(random)));
    const vec3 d = e->from.position - center;
    const float along = glm::dot(d, e->direction);
    EXPECT_NEAR(along, -2.f, 1e-4f);
    const float r2 = length_squared(d) - along * along;
    EXPECT_LE(r2, 4.001f);
    sum += r2;
    EXPECT_EQ(e->from.normal, e->direction);
  }
  // Uniform on the disk: mean r^2 = R^2 / 2, variance R^4 / 12; five sigma.
  EXPECT_NEAR(sum / n, 2.0, 5.0 * std::sqrt(16.0 / 12.0 / n));
}

TEST(InfiniteLight, ImageAxesAndErrors) {
  Image image(2, 2, 3);  // texels are octants' pairs: (x < 0 | x > 0) by (y < 0 | y > 0)
  for (int i = 0; i < 12; ++i) image.data[static_cast<size_t>(i)] = static_cast<float>(i / 3 + 1);
  const std::string text = "LightSource \"infinite\" \"string filename\" \"" +
                           write("pssmlt-octants.pfm", image) + "\" \"float scale\" 2";
  const auto light = make_light(text);
  for (const float z : {-0.5f, 0.5f}) {
    EXPECT_EQ(light->background(glm::normalize(vec3(-1.f, -1.f, z))), Rgb(2.f));
    EXPECT_EQ(light->background(glm::normalize(vec3(1.f, -1.f, z))), Rgb(4.f));
    EXPECT_EQ(light->background(glm::normalize(vec3(-1.f, 1.f, z))), Rgb(6.f));
    EXPECT_EQ(light->background(glm::normalize(vec3(1.f, 1.f, z))), Rgb(8.f));
  }
  // The map turns with the light.
  EXPECT_EQ(
      make_light("Rotate 180 0 0 1 " + text)->background(glm::normalize(vec3(1.f, 1.f, 0.3f))),
      Rgb(2.f));
  EXPECT_NE(message(text + " \"rgb L\" [1 1 1]").find("together"), std::string::npos);
  const std::string wide = write("pssmlt-wide.pfm", Image(4, 2, 3));
  EXPECT_NE(message("LightSource \"infinite\" \"string filename\" \"" + wide + "\"").find("square"),
            std::string::npos);
  EXPECT_NE(message("LightSource \"infinite\" \"string filename\" \"none.exr\"").find("test:2:"),
            std::string::npos);
}

// Every direction is found where its texel is: the map and its inverse agree at texel centres.
// Rows are latitudes from +z down, columns longitudes from +x to +y.
TEST(InfiniteLight, LongitudeAndLatitude) {
  Image image(4, 2, 3);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = 1.f + static_cast<float>(i / 3);
  const std::string sky = "LightSource \"infinite\" \"string mapping\" \"equirectangular\"";
  const std::string file =
      " \"string filename\" \"" + write("pssmlt-longitudes-test.pfm", image) + "\"";
  const auto light = make_light(sky + file);
  const auto value = [&](const vec3& d) { return light->background(glm::normalize(d)).x; };
  EXPECT_EQ(value({1.f, .5f, .5f}), 1.f);
  EXPECT_EQ(value({-.5f, 1.f, .5f}), 2.f);
  EXPECT_EQ(value({.5f, -1.f, .5f}), 4.f);
  EXPECT_EQ(value({.5f, -1.f, -.5f}), 8.f);
  // A row of the horizon covers what it covers: the sine of its latitudes.
  light->prepare({vec3(0.f), 1.f});
  EXPECT_NEAR(light->power(), 4.f * pi * pi * 4.5f, 1e-3f);
  // The true illuminance: no half pixels, which belong to equal-area maps.
  const auto lit = make_light(sky + file + " \"float illuminance\" 5");
  lit->prepare({vec3(0.f), 1.f});
  EXPECT_NEAR(lit->background({0.f, 0.f, 1.f}).x / light->background({0.f, 0.f, 1.f}).x,
              5.f / (pi * 2.5f), 2e-2f);
}

// What LatLong says of directions and of its own density.
TEST(InfiniteLight, LongitudesAndInverseAgree) {
  const LatLong map(7);
  RandomStream random(3, RandomUse::test);
  double covered = 0.0;
  constexpr int n = 20'000;
  for (int i = 0; i < n; ++i) {
    const vec2 u = draw2(random);
    const dvec2 uv(u);
    const dvec2 back = map.square(map.direction(uv));
    EXPECT_NEAR(back.x, uv.x, 1e-9);
    EXPECT_NEAR(back.y, uv.y, 1e-6);
    covered += map.weight_at(uv.y) * (map.direction(uv).z > 0.5 ? 1.0 : 0.0);
  }
  EXPECT_NEAR(covered / n, 0.25, 0.02);  // a cap of a quarter of the sphere
}

TEST(InfiniteLight, MapAndInverseAgree) {
  constexpr int size = 64;
  Image image(size, size, 3);
  RandomStream random(2, RandomUse::test);
  for (float& v : image.data) v = 0.5f + random.next();
  const auto light = make_light("LightSource \"infinite\" \"string filename\" \"" +
                                write("pssmlt-noise.pfm", image) + "\"");
  light->prepare({vec3(0.f), 1.f});
  for (int i = 0; i < 20'000; ++i) {
    const auto t = light->toward(vec3(0.f), draw2(random));
    ASSERT_TRUE(t.has_value());
    // Density is proportional to luminance, so their ratio is the same everywhere.
    EXPECT_NEAR(luminance(t->value) / t->pdf_toward, light->power() / pi, 1e-3f * light->power());
  }
}

TEST(AreaLight, SidesPowerAndImage) {
  const std::string square =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]"
      "\"point3 P\" [0 0 0 2 0 0 2 2 0 0 2 0] \"point2 uv\" [0 0 1 0 1 1 0 1]";
  const auto one =
      make_light("AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2 " + square);
  EXPECT_EQ(toward(*one, {1.f, 1.f, 1.f}), Rgb(2.f, 4.f, 6.f));
  EXPECT_EQ(toward(*one, {1.f, 1.f, -1.f}), Rgb(0.f));
  const auto reversed = make_light("ReverseOrientation AreaLightSource \"diffuse\" " + square);
  EXPECT_EQ(toward(*reversed, {1.f, 1.f, 1.f}), Rgb(0.f));
  EXPECT_EQ(toward(*reversed, {1.f, 1.f, -1.f}), Rgb(1.f));
  for (const char* sides : {"false", "true"}) {
    const auto powered = make_light(std::string("AreaLightSource \"diffuse\" \"float power\" 60 ") +
                                    "\"bool twosided\" " + sides + " " + square);
    EXPECT_NEAR(powered->power(), 60.f, 1e-3f);
    EXPECT_NEAR(emitted_power(*powered), 60.0, 1e-2);
  }
  Image image(2, 2, 3);  // bright in the upper left corner, which is u = 0, v = 1
  for (int c = 0; c < 3; ++c) image.pixel(0, 0)[c] = 4.f;
  const std::string file = write("pssmlt-emission.pfm", image);
  const auto textured =
      make_light("AreaLightSource \"diffuse\" \"string filename\" \"" + file + "\" " + square);
  EndpointPoint at{{0.f, 2.f, 0.f}, {0.f, 0.f, 1.f}, {0.1f, 0.9f}, 0};
  EXPECT_EQ(textured->evaluate(at, {0.f, 0.f, 1.f}).value, Rgb(4.f));
  at.uv = {0.9f, 0.1f};
  EXPECT_EQ(textured->evaluate(at, {0.f, 0.f, 1.f}).value, Rgb(0.f));
  at.uv = {0.5f, 0.5f};
  EXPECT_NEAR(textured->evaluate(at, {0.f, 0.f, 1.f}).value.x, 1.f, 1e-6f);
  // Five sigma: each ray weighs between 0 and 4 times the mean.
  EXPECT_NEAR(emitted_power(*textured), textured->power(), 5.0 * 2.0 * textured->power() / 316.0);
}

// Points of a cut-out count by their opacity when they are chosen, fully when a ray met them.
TEST(AreaLight, CutOutsWeightChosenPoints) {
  const auto light =
      make_light("AreaLightSource \"diffuse\" Shape \"sphere\"", constant_texture(0.25f));
  EXPECT_EQ(toward(*light, {3.f, 0.f, 0.f}), Rgb(0.25f));
  EXPECT_EQ(light->evaluate({{1.f, 0.f, 0.f}, {1.f, 0.f, 0.f}, {}, 0}, {1.f, 0.f, 0.f}).value,
            Rgb(1.f));
  EXPECT_NEAR(emitted_power(*light), 0.25 * light->power(), 1e-3);
}

// Cut out everywhere, the shape is not seen but emits in full.
TEST(AreaLight, AllCutOutIsHidden) {
  const auto light =
      make_light("AreaLightSource \"diffuse\" Shape \"sphere\"", constant_texture(0.f));
  EXPECT_EQ(toward(*light, {3.f, 0.f, 0.f}), Rgb(1.f));
  EXPECT_FALSE(light->traits().hittable());
  EXPECT_NEAR(emitted_power(*light), light->power(), 1e-3 * light->power());
  EXPECT_TRUE(make_light("AreaLightSource \"diffuse\" Shape \"sphere\"")->traits().hittable());
}

}  // namespace
}  // namespace pssmlt
