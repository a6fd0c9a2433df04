// Textures: values, mappings, filters, and refusals with a place.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/equal_area.h"
#include "core/image/encoding.h"
#include "core/image/image.h"
#include "core/texture_mapping.h"
#include "tests/support/hits.h"
#include "tests/support/make_plugin.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;
using namespace test;

TEST(Constant, Values) {
  EXPECT_EQ(make_texture<float>("constant")->evaluate(Hit()), 1.f);
  EXPECT_EQ(make_texture<float>("constant", {number("value", 3.f)})->evaluate(Hit()), 3.f);
  const auto colour = make_texture<Rgb>("constant", {rgb("value", 0.1f, 0.2f, 4.f)});
  EXPECT_NEAR(colour->evaluate(Hit()).z, 4.f, 1e-6f);
  EXPECT_TRUE(colour->constant());
}

TEST(ScaleAndMix, CombineOthers) {
  Resolver resolver;
  resolver.floats["three"] = constant_texture(3.f);
  resolver.colours["red"] = constant_texture(Rgb(1.f, 0.f, 0.f));
  resolver.floats["broken"] = constant_texture(std::numeric_limits<float>::quiet_NaN());
  const auto scaled =
      make_texture<Rgb>("scale", {texture("tex", "red"), texture("scale", "three")}, &resolver);
  EXPECT_EQ(scaled->evaluate(Hit()), Rgb(3.f, 0.f, 0.f));
  EXPECT_TRUE(scaled->constant());
  EXPECT_EQ(make_texture<float>("scale")->evaluate(Hit()), 1.f);
  EXPECT_EQ(make_texture<float>("mix")->evaluate(Hit()), 0.5f);
  const auto mixed =
      make_texture<Rgb>("mix", {texture("tex1", "red"), number("amount", 0.25f)}, &resolver);
  EXPECT_EQ(mixed->evaluate(Hit()), Rgb(1.f, 0.25f, 0.25f));
  const auto broken = make_texture<float>("mix", {texture("amount", "broken")}, &resolver);
  EXPECT_TRUE(std::isnan(broken->evaluate(Hit())));
  EXPECT_NE(error_of([] { make_texture<float>("scale", {number("sacle", 1.f)}); }), "");
}

TEST(Checkerboard, SquaresAndCubes) {
  const auto squares =
      make_texture<float>("checkerboard", {number("uscale", 2.f), number("vscale", 4.f)});
  EXPECT_EQ(squares->evaluate(at_uv(0.1f, 0.1f)), 1.f);
  EXPECT_EQ(squares->evaluate(at_uv(0.6f, 0.1f)), 0.f);
  EXPECT_EQ(squares->evaluate(at_uv(0.6f, 0.3f)), 1.f);
  EXPECT_EQ(squares->evaluate(at_uv(-0.1f, 0.1f)), 0.f);
  const auto cubes =
      make_texture<Rgb>("checkerboard", {integer("dimension", 3), rgb("tex2", 0.f, 0.f, 1.f)},
                        nullptr, Transform::translate(dvec3(10., 0., 0.)));
  EXPECT_EQ(cubes->evaluate(at_point({10.5f, 0.5f, 0.5f})), Rgb(1.f));
  EXPECT_EQ(cubes->evaluate(at_point({11.5f, 0.5f, 0.5f})), Rgb(0.f, 0.f, 1.f));
  EXPECT_EQ(cubes->evaluate(at_point({11.5f, 0.5f, -0.5f})), Rgb(1.f));
  EXPECT_NE(error_of([] {
              make_texture<float>("checkerboard", {integer("dimension", 4)});
            }).find("test-scene:7:3"),
            std::string::npos);
}

TextureMapping2D mapping(const ParameterSet& set, const Transform& transform = {}) {
  Parameters p(set, {}, "texture", nullptr);
  p.set_transform(transform);
  return TextureMapping2D(p);
}

TEST(TextureMapping, Coordinates) {
  const auto uv = mapping({number("uscale", 2.f), number("vdelta", 0.5f)});
  EXPECT_EQ(uv.map(at_uv(0.25f, 0.25f)), vec2(0.5f, 0.75f));
  const auto spherical = mapping({text("mapping", "spherical")});
  const vec2 side = spherical.map(at_point({0.f, 2.f, 0.f}));
  EXPECT_NEAR(side.x, 0.5f, 1e-6f);
  EXPECT_NEAR(side.y, 0.25f, 1e-6f);
  EXPECT_NEAR(spherical.map(at_point({0.f, 0.f, -3.f})).x, 1.f, 1e-6f);
  const auto cylindrical = mapping({text("mapping", "cylindrical")});
  EXPECT_NEAR(cylindrical.map(at_point({0.f, 2.f, 7.f})).x, 0.75f, 1e-6f);
  EXPECT_EQ(cylindrical.map(at_point({0.f, 2.f, 7.f})).y, 7.f);
  const auto planar =
      mapping({text("mapping", "planar"), floats(ParameterType::Vector3, "v1", {0.f, 0.f, 2.f}),
               number("udelta", 1.f)},
              Transform::scale(dvec3(2.)));
  EXPECT_EQ(planar.map(at_point({1.f, 4.f, 3.f})), vec2(4.f, 2.f));
}

TEST(TextureMapping, FootprintsAreStepsOfAPixel) {
  Hit hit = at_uv(0.3f, 0.6f);
  hit.footprint = 0.1f;
  // A sheared parametrisation: position = (u, u + 2 v).
  hit.dpdu = {1.f, 1.f, 0.f};
  hit.dpdv = {0.f, 2.f, 0.f};
  const TextureFootprint f = mapping({number("uscale", 3.f)}).footprint(hit);
  for (const vec2& axis : {f.axis0, f.axis1}) {
    const vec3 step = axis.x / 3.f * hit.dpdu + axis.y * hit.dpdv;
    EXPECT_NEAR(glm::length(step), 0.1f, 1e-5f);
  }
  // Across the seam of the angle the step stays small.
  Hit seam = at_point({-1.f, 0.001f, 0.f});
  seam.ng = {-1.f, 0.f, 0.f};
  seam.dpdu = {0.f, 1.f, 0.f};
  seam.footprint = 0.01f;
  const TextureFootprint s = mapping({text("mapping", "cylindrical")}).footprint(seam);
  EXPECT_LT(glm::length(s.axis0), 0.011f);
  EXPECT_LT(glm::length(s.axis1), 0.011f);
}

class ImageMapTest : public testing::Test {
 protected:
  ImageMapTest() : folder_(fs::temp_directory_path() / ("pssmlt-map-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~ImageMapTest() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // 8-bit RGB, upper row first.
  std::string ppm(const std::string& name, int width, int height,
                  const std::vector<uint8_t>& bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file << "P6\n" << width << " " << height << "\n255\n";
    for (const uint8_t b : bytes) file.put(static_cast<char>(b));
    return path(name);
  }
  // Upper row black, red; lower row green, white.
  std::string corners() const {
    return ppm("corners.ppm", 2, 2, {0, 0, 0, 255, 0, 0, 0, 255, 0, 255, 255, 255});
  }
  fs::path folder_;
};

TEST_F(ImageMapTest, UpperRowIsAtTheTop) {
  const auto map = make_texture<Rgb>("imagemap", {text("filename", corners())});
  EXPECT_EQ(map->evaluate(at_uv(0.25f, 0.75f)), Rgb(0.f));
  EXPECT_EQ(map->evaluate(at_uv(0.75f, 0.75f)), Rgb(1.f, 0.f, 0.f));
  EXPECT_EQ(map->evaluate(at_uv(0.25f, 0.25f)), Rgb(0.f, 1.f, 0.f));
  EXPECT_EQ(map->evaluate(at_uv(0.75f, 0.25f)), Rgb(1.f));
  EXPECT_EQ(map->evaluate(at_uv(0.5f, 0.5f)), Rgb(0.5f, 0.5f, 0.25f));
  EXPECT_TRUE(std::isnan(map->evaluate(at_uv(NAN, 0.5f)).x));
}

TEST_F(ImageMapTest, WrapsAndPointFilter) {
  const auto value = [&](const char* wrap, const char* filter, float u, float v) {
    return make_texture<Rgb>("imagemap", {text("filename", corners()), text("wrap", wrap),
                                          text("filter", filter)})
        ->evaluate(at_uv(u, v));
  };
  EXPECT_EQ(value("repeat", "bilinear", 1.25f, -0.25f), Rgb(0.f));
  EXPECT_EQ(value("repeat", "bilinear", 1.f, 0.25f), Rgb(0.5f, 1.f, 0.5f));
  EXPECT_EQ(value("clamp", "bilinear", 5.f, 0.25f), Rgb(1.f));
  EXPECT_EQ(value("clamp", "bilinear", 1e30f, -1e30f), Rgb(1.f));
  EXPECT_EQ(value("black", "bilinear", 1.5f, 0.25f), Rgb(0.f));
  EXPECT_EQ(value("black", "bilinear", 1.f, 0.25f), Rgb(0.5f));
  EXPECT_EQ(value("repeat", "point", 0.49f, 0.9f), Rgb(0.f));
  EXPECT_EQ(value("repeat", "point", 0.51f, 0.9f), Rgb(1.f, 0.f, 0.f));
  EXPECT_EQ(value("repeat", "point", 1e8f, 1e8f), value("repeat", "point", 0.f, 0.f));
}

// Beyond an edge of an equal-area map of the sphere it continues turned by half a turn, so that
// filters see what lies next to each other on the sphere.
TEST_F(ImageMapTest, OctahedralWrapFollowsTheSphere) {
  constexpr int size = 16;
  std::vector<uint8_t> bytes;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const dvec3 d = square_to_sphere({(x + 0.5) / size, (y + 0.5) / size});
      for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<uint8_t>(127.5 * (d[c] + 1.0)));
    }
  const std::string file = ppm("sphere.ppm", size, size, bytes);
  for (const char* filter : {"point", "bilinear", "trilinear", "ewa"}) {
    const auto map =
        make_texture<Rgb>("imagemap", {text("filename", file), text("encoding", "linear"),
                                       text("filter", filter), text("wrap", "octahedralsphere")});
    for (int i = 0; i < 64; ++i) {
      const dvec2 outside(-0.6 + 0.035 * i, 1.7 - 0.037 * i);
      const dvec2 inside = wrap_to_square(outside);
      Hit hit = at_uv(static_cast<float>(outside.x), static_cast<float>(1.0 - outside.y));
      Hit same = at_uv(static_cast<float>(inside.x), static_cast<float>(1.0 - inside.y));
      hit.footprint = same.footprint = 0.05f;
      EXPECT_LT(glm::distance(map->evaluate(hit), map->evaluate(same)), 1e-4f) << filter << i;
      // Bilinear values are near the sphere's own everywhere, across the edges as well.
      const Rgb expected(0.5 * (square_to_sphere(inside) + 1.0));
      EXPECT_LT(glm::distance(map->evaluate(hit), expected), 0.2f) << filter << i;
    }
    EXPECT_TRUE(is_valid(map->evaluate(at_uv(1e30f, -1e30f))));
  }
}

TEST_F(ImageMapTest, EncodingsScaleAndInvert) {
  const std::string grey = ppm("grey.ppm", 1, 1, {128, 128, 128});
  const auto value = [&](ParameterSet set) {
    set.push_back(text("filename", grey));
    return make_texture<Rgb>("imagemap", set)->evaluate(at_uv(0.3f, 0.3f)).x;
  };
  const float stored = 128.f / 255.f, linear = Encoding::srgb().to_linear(stored);
  EXPECT_NEAR(value({}), linear, 1e-6f);
  EXPECT_NEAR(value({text("encoding", "sRGB")}), linear, 1e-6f);
  EXPECT_NEAR(value({text("encoding", "linear")}), stored, 1e-6f);
  EXPECT_NEAR(value({text("encoding", "gamma 2.2")}), std::pow(stored, 2.2f), 1e-6f);
  EXPECT_NEAR(value({number("scale", 3.f)}), 3.f * linear, 1e-6f);
  EXPECT_NEAR(value({flag("invert", true)}), 1.f - linear, 1e-6f);
  EXPECT_EQ(value({flag("invert", true), number("scale", 9.f)}), 0.f);
}

TEST_F(ImageMapTest, FloatIsMeanOrAlpha) {
  const auto mean = make_texture<float>("imagemap", {text("filename", corners())});
  EXPECT_NEAR(mean->evaluate(at_uv(0.75f, 0.75f)), 1.f / 3.f, 1e-6f);
  Image image(1, 1, 4);
  image.channel_names = {"R", "G", "B", "A"};
  image.data = {3.f, 0.f, 0.f, 0.25f};
  write_image(path("alpha.exr"), image, {}, {});
  const ParameterSet set = {text("filename", path("alpha.exr"))};
  EXPECT_EQ(make_texture<float>("imagemap", set)->evaluate(at_uv(0.5f, 0.5f)), 0.25f);
  EXPECT_EQ(make_texture<Rgb>("imagemap", set)->evaluate(at_uv(0.5f, 0.5f)), Rgb(3.f, 0.f, 0.f));
  image.data[3] = 1.f;
  write_image(path("opaque.exr"), image, {}, {});
  const auto opaque = make_texture<float>("imagemap", {text("filename", path("opaque.exr"))});
  EXPECT_EQ(opaque->evaluate(at_uv(0.5f, 0.5f)), 1.f);
}

// Wide footprints see the mean of linear values, in odd sizes as well; narrow ones the full image.
TEST_F(ImageMapTest, WideFootprintsSeeTheMean) {
  std::vector<uint8_t> bytes(3 * 13 * 7);
  double mean = 0.;
  for (size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = i % 3 == 0 ? uint8_t((i * 37) % 256) : uint8_t(0);
    if (i % 3 == 0) mean += double(Encoding::srgb().to_linear(float(bytes[i]) / 255.f)) / 91.;
  }
  const std::string file = ppm("noise.ppm", 13, 7, bytes);
  const auto bilinear = make_texture<Rgb>("imagemap", {text("filename", file)});
  for (const char* filter : {"trilinear", "ewa"}) {
    const auto map =
        make_texture<Rgb>("imagemap", {text("filename", file), text("filter", filter)});
    Hit hit = at_uv(0.31f, 0.67f);
    const Rgb sharp = bilinear->evaluate(hit);
    EXPECT_NEAR(map->evaluate(hit).x, sharp.x, 1e-6f) << filter;
    hit.footprint = 50.f;
    // Each of four levels rounds to 8 bits.
    EXPECT_NEAR(map->evaluate(hit).x, mean, 0.01) << filter;
    hit.footprint = 1e20f;
    EXPECT_NEAR(map->evaluate(hit).x, mean, 0.01) << filter;
    hit.footprint = infinity;
    EXPECT_NEAR(map->evaluate(hit).x, mean, 0.01) << filter;
    hit.dpdv = {0.f, 1e-6f, 0.f};
    hit.footprint = 0.3f;
    EXPECT_TRUE(is_valid(map->evaluate(hit))) << filter;
  }
}

// Stripes along v: an ellipse that is long along the stripes keeps them, a round one does not.
TEST_F(ImageMapTest, EwaKeepsWhatLiesAcrossALongEllipse) {
  std::vector<uint8_t> bytes;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) bytes.push_back((x / 8) % 2 == 0 ? 0 : 255);
  const std::string file = ppm("stripes.ppm", 64, 64, bytes);
  const auto value = [&](const char* filter, float longest = 8.f) {
    Hit hit = at_uv(12.f / 64.f, 0.5f);
    hit.dpdu = {8.f, 0.f, 0.f};
    hit.footprint = 0.25f;  // 2 texels along u, 16 along v
    return make_texture<float>("imagemap", {text("filename", file), text("filter", filter),
                                            number("maxanisotropy", longest)})
        ->evaluate(hit);
  };
  EXPECT_NEAR(value("ewa"), 1.f, 1e-3f);
  EXPECT_LT(value("trilinear"), 0.9f);
  // Not if it may not be longer than wide.
  EXPECT_LT(value("ewa", 1.f), 0.9f);
}

TEST_F(ImageMapTest, RefusalsHaveAPlace) {
  const auto error = [](ParameterSet set) {
    return error_of([&] { make_texture<Rgb>("imagemap", set); });
  };
  const std::string good = corners();
  std::ofstream(path("text.png")) << "hello";
  write_image(path("cut.exr"), Image(64, 64, 3), {}, {});
  fs::resize_file(path("cut.exr"), fs::file_size(path("cut.exr")) / 2);
  const std::vector<ParameterSet> bad = {{text("filename", path("missing.png"))},
                                         {text("filename", path("text.png"))},
                                         {text("filename", path("cut.exr"))},
                                         {text("filename", good), text("filter", "box")},
                                         {text("filename", good), text("wrap", "mirror")},
                                         {text("filename", good), text("encoding", "rec709")},
                                         {text("filename", good), text("mapping", "cubic")},
                                         {text("filename", good), number("maxanisotropy", 0.f)}};
  for (const ParameterSet& set : bad)
    EXPECT_NE(error(set).find("test-scene:7:3"), std::string::npos) << error(set);
  EXPECT_NE(error({}).find("filename"), std::string::npos);
}

}  // namespace
}  // namespace pssmlt
