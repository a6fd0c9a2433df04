// Materials, textures and opacity from glTF files against the same in text.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/base/random.h"
#include "tests/gltf/asset.h"

namespace pssmlt::test {
namespace {

// The picture of the square with a material in text: parameters of "principled".
Image of_text(const std::string& parameters, const std::string& before = "") {
  return picture(stage + before + "MakeNamedMaterial \"m\" \"string type\" \"principled\" " +
                 parameters + " NamedMaterial \"m\"\n" + square_text);
}
Image of_material(Asset& asset, const tinygltf::Material& material) {
  asset.place(asset.mesh(asset.square(asset.material(material))));
  return picture(stage + importing(asset.save("model.gltf")));
}

tinygltf::Material plain() {
  tinygltf::Material m;
  m.pbrMetallicRoughness.baseColorFactor = {.8, .4, .2, 1.};
  m.pbrMetallicRoughness.metallicFactor = 0.;
  m.pbrMetallicRoughness.roughnessFactor = .5;
  m.doubleSided = true;
  return m;
}
const std::string plain_text = "\"rgb basecolor\" [ .8 .4 .2 ] \"float roughness\" .5 ";

// A small image of random bytes as a file; its first channel differs from the others.
std::string image_file(const TemporaryFolder& folder, const std::string& name) {
  Image image(8, 8, 3);
  RandomStream random(3, RandomUse::test);
  for (float& v : image.data) v = random.next();
  const std::string path = (folder.path() / name).string();
  write_image(path, image, {}, {});
  return path;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A texture of the asset that shows the image, inside the file's buffer.
int embedded_texture(Asset& asset, const std::string& path) {
  const std::string bytes = bytes_of(path);
  tinygltf::Image image;
  image.bufferView = asset.view(bytes.data(), bytes.size());
  image.mimeType = "image/png";
  asset.model.images.push_back(image);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(asset.model.images.size()) - 1;
  asset.model.textures.push_back(texture);
  return static_cast<int>(asset.model.textures.size()) - 1;
}

std::string image_map(const std::string& name, const std::string& kind, const std::string& path,
                      const std::string& rest = "") {
  return "Texture \"" + name + "\" \"" + kind + "\" \"imagemap\" \"string filename\" \"" + path +
         "\" " + rest + "\n";
}

TEST(GltfMaterial, FactorsAndExtensions) {
  Asset asset;
  tinygltf::Material m = plain();
  m.extensions["KHR_materials_ior"] = object({{"ior", value(1.8)}});
  m.extensions["KHR_materials_specular"] =
      object({{"specularFactor", value(.7)}, {"specularColorFactor", list({1., .5, .2})}});
  m.extensions["KHR_materials_clearcoat"] =
      object({{"clearcoatFactor", value(.6)}, {"clearcoatRoughnessFactor", value(.3)}});
  m.extensions["KHR_materials_sheen"] =
      object({{"sheenColorFactor", list({.2, .3, .4})}, {"sheenRoughnessFactor", value(.5)}});
  m.extensions["KHR_materials_anisotropy"] =
      object({{"anisotropyStrength", value(.5)}, {"anisotropyRotation", value(.5)}});
  EXPECT_LT(difference(
                of_material(asset, m),
                of_text(plain_text +
                        "\"float ior\" 1.8 \"float specular\" .7 \"rgb specularcolor\" [ 1 .5 .2 ] "
                        "\"float clearcoat\" .6 \"float clearcoatroughness\" .3 "
                        "\"rgb sheencolor\" [ .2 .3 .4 ] \"float sheenroughness\" .5 "
                        "\"float anisotropy\" .5 \"float anisotropyrotation\" 28.64788975654116")),
            1e-5);
}

TEST(GltfMaterial, TransmissionThinAndSolid) {
  for (const double thickness : {0., .5}) {
    Asset asset;
    tinygltf::Material m = plain();
    m.extensions["KHR_materials_transmission"] = object({{"transmissionFactor", value(.8)}});
    m.extensions["KHR_materials_volume"] = object({{"thicknessFactor", value(thickness)}});
    EXPECT_EQ(difference(of_material(asset, m),
                         of_text(plain_text + "\"float transmission\" .8 \"float thickness\" " +
                                 std::to_string(thickness))),
              0.0);
  }
}

// Of a body alone: a thin sheet with a dispersion is one without.
TEST(GltfMaterial, Dispersion) {
  const auto shown = [](double thickness, double dispersion) {
    Asset asset;
    tinygltf::Material m = plain();
    m.extensions["KHR_materials_transmission"] = object({{"transmissionFactor", value(.8)}});
    m.extensions["KHR_materials_volume"] = object({{"thicknessFactor", value(thickness)}});
    m.extensions["KHR_materials_dispersion"] = object({{"dispersion", value(dispersion)}});
    return of_material(asset, m);
  };
  const Image body = shown(.5, 2.);
  EXPECT_EQ(difference(body, of_text(plain_text + "\"float transmission\" .8 "
                                                  "\"float thickness\" .5 "
                                                  "\"float dispersion\" 2")),
            0.0);
  EXPECT_GT(difference(body, shown(.5, 0.)), 1e-3);
  EXPECT_EQ(difference(shown(0., 2.), shown(0., 0.)), 0.0);
}

// White light that went attenuationDistance has attenuationColor left; as media are plugins,
// without them the log says that it is left out.
TEST(GltfMaterial, AbsorptionInsideBodiesIsAMedium) {
  Asset asset;
  tinygltf::Material m = plain();
  m.extensions["KHR_materials_transmission"] = object({{"transmissionFactor", value(1.)}});
  m.extensions["KHR_materials_volume"] = object({{"thicknessFactor", value(1.)},
                                                 {"attenuationDistance", value(.5)},
                                                 {"attenuationColor", list({.5, .25, 1.})}});
  asset.place(asset.mesh(asset.square(asset.material(m))));
  std::vector<std::string> log;
  const SceneDescription scene = parse_file(asset.save("model.gltf"), &log);
  const auto media = Registry::instance().names("medium");
  const bool possible = std::ranges::find(media, "homogeneous") != media.end();
  EXPECT_EQ(possible, std::ranges::none_of(log, [](const std::string& line) {
              return line.find("absorption inside bodies is left out") != std::string::npos;
            }));
  if (!possible) GTEST_SKIP() << "there are no media";
  ASSERT_EQ(scene.media.size(), 1u);
  EXPECT_EQ(scene.shapes[0].inside_medium, scene.media[0].name);
  EXPECT_EQ(scene.shapes[0].outside_medium, "");
  const ParameterSet& set = scene.media[0].parameters;
  const auto sigma = std::ranges::find(set, "sigma_a", &Parameter::name);
  ASSERT_NE(sigma, set.end());
  for (size_t c = 0; c < 3; ++c) {
    const float left = std::exp(-.5f * sigma->floats[c]);
    EXPECT_NEAR(left, c == 0 ? .5f : c == 1 ? .25f : 1.f, 1e-5f);
  }
  BuildOptions options;
  options.defaults = default_plugins();
  EXPECT_NO_THROW(build_scene(scene, options));
}

TEST(GltfMaterial, TexturesInTheBufferBesideTheFileAndInLine) {
  const std::string name = "colors.png";
  Asset asset;
  const std::string path = image_file(asset.folder, name);
  const Image expected = of_text("\"texture basecolor\" \"t\" \"float roughness\" .5",
                                 image_map("t", "spectrum", path, "\"string encoding\" \"sRGB\""));
  tinygltf::Material m = plain();
  m.pbrMetallicRoughness.baseColorFactor = {1., 1., 1., 1.};
  m.pbrMetallicRoughness.baseColorTexture.index = embedded_texture(asset, path);
  EXPECT_EQ(difference(of_material(asset, m), expected), 0.0);
  // Beside the file: tinygltf's writer would write it anew, so the JSON is changed by hand.
  std::string json = bytes_of((asset.folder.path() / "model.gltf").string());
  const size_t at = json.find("\"images\"");
  ASSERT_NE(at, std::string::npos);
  const size_t open = json.find('[', at), close = json.find(']', at);
  const std::string beside =
      json.substr(0, open) + "[{\"uri\": \"col%6Frs.png\"}" + json.substr(close);
  asset.folder.write("beside.gltf", beside);
  EXPECT_EQ(difference(picture(stage + importing((asset.folder.path() / "beside.gltf").string())),
                       expected),
            0.0);
}

TEST(GltfMaterial, ChannelsOfMetallicRoughness) {
  Asset asset;
  const std::string path = image_file(asset.folder, "mr.png");
  tinygltf::Material m = plain();
  m.pbrMetallicRoughness.metallicFactor = .9;
  m.pbrMetallicRoughness.roughnessFactor = .8;
  m.pbrMetallicRoughness.metallicRoughnessTexture.index = embedded_texture(asset, path);
  const std::string linear = "\"string encoding\" \"linear\" ";
  EXPECT_EQ(
      difference(of_material(asset, m),
                 of_text("\"rgb basecolor\" [ .8 .4 .2 ] \"texture metallic\" \"b\" "
                         "\"texture roughness\" \"g\"",
                         image_map("b", "float", path,
                                   linear + "\"string channel\" \"b\" \"float scale\" .9") +
                             image_map("g", "float", path,
                                       linear + "\"string channel\" \"g\" \"float scale\" .8"))),
      0.0);
}

// The specification's matrix, applied to the corners by hand in v that grows downward.
TEST(GltfMaterial, TextureTransform) {
  Asset asset;
  const std::string path = image_file(asset.folder, "moved.png");
  tinygltf::Material m = plain();
  m.pbrMetallicRoughness.baseColorFactor = {1., 1., 1., 1.};
  auto& info = m.pbrMetallicRoughness.baseColorTexture;
  info.index = embedded_texture(asset, path);
  const double r = .4, sx = 1.5, sy = .7, ox = .2, oy = -.3;
  info.extensions["KHR_texture_transform"] =
      object({{"offset", list({ox, oy})}, {"scale", list({sx, sy})}, {"rotation", value(r)}});
  std::string uvs = "\"point2 uv\" [";
  for (const auto& [u, v] : {std::pair(0., 1.), {1., 1.}, {1., 0.}, {0., 0.}}) {
    const double x = ox + std::cos(r) * sx * u + std::sin(r) * sy * v;
    const double y = oy - std::sin(r) * sx * u + std::cos(r) * sy * v;
    uvs += " " + std::to_string(x) + " " + std::to_string(1. - y);
  }
  const std::string shape = square_text.substr(0, square_text.find("\"point2 uv\"")) + uvs + " ]\n";
  const std::string text =
      stage + image_map("t", "spectrum", path) +
      "MakeNamedMaterial \"m\" \"string type\" \"principled\" "
      "\"texture basecolor\" \"t\" \"float roughness\" .5 NamedMaterial \"m\"\n" +
      shape;
  EXPECT_LT(difference(of_material(asset, m), picture(text)), 2e-3);
}

TEST(GltfMaterial, WrapsOfEachAxisAndNearestTexels) {
  Asset asset;
  const std::string path = image_file(asset.folder, "wrapped.png");
  tinygltf::Material m = plain();
  m.pbrMetallicRoughness.baseColorFactor = {1., 1., 1., 1.};
  auto& info = m.pbrMetallicRoughness.baseColorTexture;
  info.index = embedded_texture(asset, path);
  info.extensions["KHR_texture_transform"] = object({{"scale", list({3., 3.})}});
  tinygltf::Sampler sampler;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_NEAREST;
  sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  sampler.wrapT = TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
  asset.model.samplers.push_back(sampler);
  asset.model.textures[0].sampler = 0;
  const Image image = of_material(asset, m);
  // v = 3 (1 - v') - 2 upward: the image's rows begin at its top.
  EXPECT_LT(
      difference(image,
                 of_text("\"texture basecolor\" \"t\" \"float roughness\" .5",
                         image_map("t", "spectrum", path,
                                   "\"float uscale\" 3 \"float vscale\" 3 \"float vdelta\" -2 "
                                   "\"string uwrap\" \"clamp\" \"string vwrap\" \"mirror\" "
                                   "\"string filter\" \"point\""))),
      1e-5);
  EXPECT_GT(
      difference(image,
                 of_text("\"texture basecolor\" \"t\" \"float roughness\" .5",
                         image_map("t", "spectrum", path,
                                   "\"float uscale\" 3 \"float vscale\" 3 \"float vdelta\" -2"))),
      .01);
}

TEST(GltfMaterial, SecondSetOfCoordinates) {
  Asset asset;
  const std::string path = image_file(asset.folder, "second.png");
  tinygltf::Material m = plain();
  m.pbrMetallicRoughness.baseColorFactor = {1., 1., 1., 1.};
  m.pbrMetallicRoughness.baseColorTexture.index = embedded_texture(asset, path);
  m.pbrMetallicRoughness.metallicRoughnessTexture.index = 0;
  m.pbrMetallicRoughness.metallicRoughnessTexture.texCoord = 1;
  tinygltf::Primitive p = asset.square(asset.material(m));
  p.attributes["TEXCOORD_1"] = asset.vectors({.5, .5, 1, .5, 1, 0, .5, 0}, TINYGLTF_TYPE_VEC2);
  asset.place(asset.mesh(p));
  const std::string text =
      stage + image_map("c", "spectrum", path) +
      image_map("g", "float", path,
                "\"string channel\" \"g\" \"string encoding\" \"linear\" \"float scale\" .5 "
                "\"float uscale\" .5 "
                "\"float vscale\" .5 \"float udelta\" .5 \"float vdelta\" .5") +
      "MakeNamedMaterial \"m\" \"string type\" \"principled\" \"texture basecolor\" \"c\" "
      "\"texture roughness\" \"g\" NamedMaterial \"m\"\n" +
      square_text;
  EXPECT_LT(difference(picture(stage + importing(asset.save("model.gltf"))), picture(text)), 1e-4);
}

TEST(GltfMaterial, NormalTexture) {
  Asset asset;
  const std::string path = image_file(asset.folder, "normals.png");
  tinygltf::Material m = plain();
  m.normalTexture.index = embedded_texture(asset, path);
  m.normalTexture.scale = .5;
  EXPECT_EQ(difference(of_material(asset, m),
                       of_text(plain_text + "\"texture normals\" \"n\" \"float normalscale\" .5",
                               image_map("n", "spectrum", path, "\"string encoding\" \"linear\""))),
            0.0);
}

TEST(GltfMaterial, MaskAndBlend) {
  Asset masked;
  tinygltf::Material m = plain();
  m.alphaMode = "MASK";
  m.pbrMetallicRoughness.baseColorFactor = {.8, .4, .2, .4};
  // All of it lies below the cutoff: nothing is there.
  EXPECT_LT(
      difference(of_material(masked, m),
                 picture(stage + "Material \"diffuse\" Shape \"sphere\" \"float radius\" 1e-6")),
      1e-3);
  Asset blended;
  m.alphaMode = "BLEND";
  const std::string half = square_text + " \"float alpha\" .4";
  EXPECT_EQ(difference(of_material(blended, m),
                       picture(stage + "MakeNamedMaterial \"m\" \"string type\" \"principled\" " +
                               plain_text + " NamedMaterial \"m\" " + half)),
            0.0);
  Asset opaque;
  m.alphaMode = "OPAQUE";
  EXPECT_EQ(difference(of_material(opaque, m), of_text(plain_text)), 0.0);
}

TEST(GltfMaterial, EmissionAndItsTexture) {
  Asset asset;
  const std::string path = image_file(asset.folder, "lamp.png");
  tinygltf::Material m = plain();
  m.emissiveFactor = {1., .5, .25};
  m.extensions["KHR_materials_emissive_strength"] = object({{"emissiveStrength", value(4.)}});
  m.emissiveTexture.index = embedded_texture(asset, path);
  const std::string text =
      stage + image_map("e", "spectrum", path) +
      "Texture \"p\" \"spectrum\" \"product\" \"texture tex1\" \"e\" \"rgb tex2\" [ 1 .5 .25 ]\n"
      "MakeNamedMaterial \"m\" \"string type\" \"principled\" " +
      plain_text +
      "NamedMaterial \"m\" AreaLightSource \"diffuse\" \"texture L\" \"p\" \"float scale\" 4 "
      "\"bool twosided\" true\n" +
      square_text;
  EXPECT_LT(difference(of_material(asset, m), picture(text)), 1e-5);
}

TEST(GltfMaterial, UnlitEmitsItsColour) {
  Asset asset;
  tinygltf::Material m = plain();
  m.extensions["KHR_materials_unlit"] = object({});
  const std::string text =
      stage +
      "Material \"diffuse\" \"rgb reflectance\" [ 0 0 0 ] AreaLightSource \"diffuse\" "
      "\"rgb L\" [ .8 .4 .2 ] \"bool twosided\" true\n" +
      square_text;
  EXPECT_EQ(difference(of_material(asset, m), picture(text)), 0.0);
}

}  // namespace
}  // namespace pssmlt::test
