// Whole files as scenes: cameras, lights, what stands in where a file has none, extensions, and
// files that are wrong.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/base/random.h"
#include "tests/gltf/asset.h"

namespace pssmlt::test {
namespace {

struct Rendered {
  std::vector<std::string> log;
  Image image;
  bool says(const std::string& words) const {
    return std::ranges::any_of(
        log, [&](const std::string& line) { return line.find(words) != std::string::npos; });
  }
};

Rendered render_file(const std::string& path, ivec2 size, double spp = 16) {
  Rendered r;
  BuildOptions options;
  options.defaults = default_plugins();
  options.size = size;
  RenderSettings settings;
  settings.spp = spp;
  settings.threads = 1;
  settings.seed = 1;
  r.image = render(build_scene(parse_file(path, &r.log), options), settings).image;
  return r;
}

int punctual(Asset& asset, const std::string& type, double intensity) {
  tinygltf::Light light;
  light.type = type;
  light.intensity = intensity;
  light.color = {1., .8, .6};
  light.spot.innerConeAngle = .2;
  light.spot.outerConeAngle = .5;
  asset.model.lights.push_back(light);
  return static_cast<int>(asset.model.lights.size()) - 1;
}

tinygltf::Node with_light(int light) {
  tinygltf::Node n;
  n.extensions["KHR_lights_punctual"] = object({{"light", tinygltf::Value(light)}});
  return n;
}

const std::string dark_stage = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Scale -1 1 1
LookAt 0 0 4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
)";
const std::string metal =
    "MakeNamedMaterial \"m\" \"string type\" \"principled\" \"rgb basecolor\" [ 1 1 1 ] \"float "
    "metallic\" 1 \"float roughness\" 1 NamedMaterial \"m\"\n";

TEST(GltfScene, PointSpotAndDirectionalLights) {
  const std::pair<const char*, const char*> cases[] = {
      {"point", "LightSource \"point\" \"rgb I\" [ 1 .8 .6 ] \"float scale\" 20"},
      {"spot",
       "LightSource \"spot\" \"rgb I\" [ 1 .8 .6 ] \"float scale\" 20 \"point3 to\" [ 0 0 -1 ] "
       "\"float coneangle\" 28.64788975654116 \"float conedeltaangle\" 17.188733853924695"},
      {"directional",
       "LightSource \"distant\" \"rgb L\" [ 1 .8 .6 ] \"float scale\" 20 \"point3 to\" [ 0 0 -1 "
       "]"}};
  for (const auto& [type, text] : cases) {
    Asset asset;
    asset.place(asset.mesh(asset.square()));
    tinygltf::Node n = with_light(punctual(asset, type, 20.));
    n.translation = {.2, .3, 3};
    n.scale = {2, 2, 2};  // of no effect on lights
    asset.node(n);
    const std::string expected = dark_stage + metal + square_text + "Translate .2 .3 3\n" + text;
    EXPECT_LT(
        difference(picture(dark_stage + importing(asset.save("model.gltf"))), picture(expected)),
        1e-3)
        << type;
  }
}

TEST(GltfScene, CameraOfTheFile) {
  Asset asset;
  asset.place(asset.mesh(asset.square()));
  asset.node(with_light(punctual(asset, "directional", 3.)));
  tinygltf::Camera camera;
  camera.type = "perspective";
  camera.perspective.yfov = .7;
  camera.perspective.aspectRatio = 1.5;
  camera.perspective.znear = .1;
  asset.model.cameras.push_back(camera);
  tinygltf::Node n;
  n.camera = 0;
  n.translation = {.5, .2, 4};
  n.scale = {3, 3, 3};  // ignored
  asset.node(n);
  n.name = "second";
  n.translation = {0, 0, 9};
  asset.node(n);
  const Rendered r = render_file(asset.save("model.gltf"), {24, 16});
  EXPECT_TRUE(r.says("the first camera is used"));
  EXPECT_TRUE(r.says("candela"));
  const std::string text = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Scale -1 1 1
LookAt .5 .2 4  .5 .2 0  0 1 0
Camera "perspective" "float fov" 40.10704565915762
WorldBegin
LightSource "distant" "rgb L" [ 1 .8 .6 ] "float scale" 3 "point3 to" [ 0 0 -1 ]
)";
  EXPECT_LT(difference(r.image, picture(text + metal + square_text)), 2e-3);
}

TEST(GltfScene, OrthographicCamera) {
  Asset asset;
  asset.place(asset.mesh(asset.square()));
  asset.node(with_light(punctual(asset, "directional", 3.)));
  tinygltf::Camera camera;
  camera.type = "orthographic";
  camera.orthographic.xmag = 1.8;
  camera.orthographic.ymag = 1.2;
  camera.orthographic.zfar = 10;
  camera.orthographic.znear = .1;
  asset.model.cameras.push_back(camera);
  tinygltf::Node n;
  n.camera = 0;
  n.translation = {.3, 0, 4};
  asset.node(n);
  const Rendered r = render_file(asset.save("model.glb"), {24, 16});
  const std::string text = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Scale -1 1 1
LookAt .3 0 4  .3 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -1.8 1.8 -1.2 1.2 ]
WorldBegin
LightSource "distant" "rgb L" [ 1 .8 .6 ] "float scale" 3 "point3 to" [ 0 0 -1 ]
)";
  EXPECT_LT(difference(r.image, picture(text + metal + square_text)), 2e-3);
}

// Far from the origin and large: all of it is seen, and it is lit.
TEST(GltfScene, WithoutCameraAndLightAllIsSeen) {
  Asset asset;
  tinygltf::Node n;
  n.mesh = asset.mesh(asset.square(asset.material({})));
  n.translation = {100, 20, -50};
  n.scale = {7, 7, 7};
  asset.node(n);
  const Rendered r = render_file(asset.save("model.gltf"), {32, 32}, 64);
  EXPECT_TRUE(r.says("there is no camera"));
  EXPECT_TRUE(r.says("there is no light"));
  EXPECT_TRUE(r.says("doubleSided"));
  // The sky has radiance 1; the metal loses some of it by single scattering.
  int darker = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const bool on_square = r.image.pixel(x, y)[1] < .97f;
      darker += on_square ? 1 : 0;
      if (x < 2 || y < 2 || x > 29 || y > 29) {
        EXPECT_FALSE(on_square) << x << " " << y;
      }
    }
  EXPECT_GT(darker, 100);
}

TEST(GltfScene, ImportedTwiceIntoAText) {
  Asset asset;
  asset.place(asset.mesh(asset.square()));
  const std::string path = asset.save("model.gltf");
  const std::string twice = "AttributeBegin Translate -.6 0 0 Scale .5 .5 .5\n" + importing(path) +
                            "AttributeEnd AttributeBegin Translate .6 0 0 Scale .5 .5 .5\n" +
                            importing(path) + "AttributeEnd\n";
  const std::string text = "AttributeBegin Translate -.6 0 0 Scale .5 .5 .5\n" + square_text +
                           "AttributeEnd AttributeBegin Translate .6 0 0 Scale .5 .5 .5\n" +
                           square_text + "AttributeEnd\n";
  EXPECT_EQ(difference(picture(stage + twice), picture(stage + metal + text)), 0.0);
}

TEST(GltfScene, InstancesOfOneNode) {
  Asset asset;
  tinygltf::Node n;
  n.mesh = asset.mesh(asset.square());
  n.scale = {.4, .4, .4};
  const int moved = asset.vectors({-1, 0, 0, 1, 0, 0});
  n.extensions["EXT_mesh_gpu_instancing"] =
      object({{"attributes", object({{"TRANSLATION", tinygltf::Value(moved)}})}});
  asset.node(n);
  const std::string text = "ObjectBegin \"o\"\n" + square_text +
                           "ObjectEnd\nScale .4 .4 .4 Translate -1 0 0 ObjectInstance \"o\" "
                           "Translate 2 0 0 ObjectInstance \"o\"\n";
  EXPECT_LT(difference(picture(stage + importing(asset.save("model.gltf"))),
                       picture(stage + metal + text)),
            1e-3);
}

// Bytes changed at random: an Error or a scene, never a crash. Digits become other digits, so that
// most files stay JSON and lie about counts, offsets and indices.
TEST(GltfScene, ChangedBytesAreErrorsOrScenes) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  p.targets = {{{"POSITION", asset.vectors(std::vector<float>(12))}}};
  const std::vector<uint8_t> joints(16);
  p.attributes["JOINTS_0"] =
      asset.accessor(joints, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
  p.attributes["WEIGHTS_0"] = asset.vectors(std::vector<float>(16, .25f), TINYGLTF_TYPE_VEC4);
  tinygltf::Node n = with_light(punctual(asset, "spot", 3.));
  n.mesh = asset.mesh(p);
  n.skin = 0;
  asset.node(n);
  tinygltf::Skin skin;
  skin.joints = {0};
  asset.model.skins.push_back(skin);
  for (const char* name : {"model.gltf", "model.glb"}) {
    std::ifstream in(asset.save(name), std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    RandomStream random(17, RandomUse::test);
    int scenes = 0, errors = 0;
    for (int i = 0; i < 1500; ++i) {
      std::string bad = good;
      for (int k = 0; k < 1 + i % 3; ++k) {
        auto at = static_cast<size_t>(random.next() * static_cast<float>(bad.size() - 1));
        const float r = random.next();
        if (i % 2 == 0) at = std::min(bad.find_first_of("0123456789", at), bad.size() - 1);
        bad[at] = i % 2 == 0 ? "0123456789-"[static_cast<int>(r * 11.f)]
                             : static_cast<char>(static_cast<int>(r * 256.f));
      }
      asset.folder.write(std::string("bad-") + name, bad);
      try {
        parse_file((asset.folder.path() / (std::string("bad-") + name)).string(), nullptr);
        ++scenes;
      } catch (const Error&) {
        ++errors;
      }
    }
    EXPECT_GT(scenes, 50) << name;
    EXPECT_GT(errors, 50) << name;
  }
}

TEST(GltfScene, ExtensionsThatAreNotKnown) {
  Asset asset;
  asset.place(asset.mesh(asset.square()));
  asset.use("EXT_invented");
  std::vector<std::string> log;
  parse_file(asset.save("used.gltf"), &log);
  EXPECT_TRUE(std::ranges::any_of(log, [](const std::string& line) {
    return line.find("EXT_invented is not supported") != std::string::npos;
  }));
  asset.model.extensionsRequired.push_back("EXT_invented");
  try {
    parse_file(asset.save("required.gltf"), nullptr);
    ADD_FAILURE() << "not refused";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("extensionsRequired[0]: the extension EXT_invented"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace pssmlt::test
