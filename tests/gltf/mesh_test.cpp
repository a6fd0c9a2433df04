// Meshes from glTF files against the same triangles in text: the same pictures, to the bit where
// nothing is computed on the way.
#include <gtest/gtest.h>

#include "tests/gltf/asset.h"

#ifdef PSSMLT_HAS_DRACO
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

namespace pssmlt::test {
namespace {

const std::string grey =
    "MakeNamedMaterial \"m\" \"string type\" \"principled\" \"rgb basecolor\" "
    "[ 1 1 1 ] \"float metallic\" 1 \"float roughness\" 1 NamedMaterial \"m\"\n";

Image expected() {
  static const Image image = picture(stage + grey + square_text);
  return image;
}

double against_text(const Asset& asset, const std::string& name = "model.gltf") {
  return difference(picture(stage + importing(asset.save(name))), expected());
}

TEST(GltfMesh, IndexedTriangles) {
  Asset asset;
  asset.place(asset.mesh(asset.square()));
  EXPECT_EQ(against_text(asset), 0.0);
  EXPECT_EQ(against_text(asset, "model.glb"), 0.0);
}

TEST(GltfMesh, StripsFansAndListsWithoutIndices) {
  const std::vector<float> strip = {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0};
  const std::vector<float> fan = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  const std::vector<float> list = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0};
  const std::pair<int, std::vector<float>> cases[] = {{TINYGLTF_MODE_TRIANGLE_STRIP, strip},
                                                      {TINYGLTF_MODE_TRIANGLE_FAN, fan},
                                                      {TINYGLTF_MODE_TRIANGLES, list}};
  for (const auto& [mode, positions] : cases) {
    Asset asset;
    tinygltf::Primitive p;
    p.mode = mode;
    p.attributes["POSITION"] = asset.vectors(positions);
    asset.place(asset.mesh(p));
    EXPECT_LT(against_text(asset), 1e-3) << mode;
  }
}

TEST(GltfMesh, QuantizedPositionsUnderAScale) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  // Normalized shorts, three of every four: -1 is -32767.
  const auto one = static_cast<int16_t>(32767), minus = static_cast<int16_t>(-32767);
  const std::vector<int16_t> stored = {minus, minus, 0, 0, one,   minus, 0, 0,
                                       one,   one,   0, 0, minus, one,   0, 0};
  p.attributes["POSITION"] =
      asset.accessor(stored, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_SHORT, true);
  auto& a = asset.model.accessors.back();
  a.type = TINYGLTF_TYPE_VEC3;
  a.count = 4;
  asset.model.bufferViews[static_cast<size_t>(a.bufferView)].byteStride = 8;
  asset.model.meshes.emplace_back().primitives.push_back(p);
  tinygltf::Node n;
  n.mesh = 0;
  n.scale = {.5, .5, .5};
  asset.use("KHR_mesh_quantization");
  asset.model.extensionsRequired.push_back("KHR_mesh_quantization");
  asset.node(n);
  const std::string half = "AttributeBegin Scale .5 .5 .5\n" + square_text + "AttributeEnd\n";
  EXPECT_LT(difference(picture(stage + importing(asset.save("model.gltf"))),
                       picture(stage + grey + half)),
            1e-3);
}

TEST(GltfMesh, SparseElementsReplaceTheStoredOnes) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  auto& a = asset.model.accessors[static_cast<size_t>(p.attributes["POSITION"])];
  // The stored corner is elsewhere; the sparse one puts it where it belongs.
  float* const stored = reinterpret_cast<float*>(
      asset.model.buffers[0].data.data() +
      asset.model.bufferViews[static_cast<size_t>(a.bufferView)].byteOffset);
  stored[6] = 0.f;
  const uint8_t which = 2;
  const float corner[3] = {1, 1, 0};
  const int indices = asset.view(&which, 1);
  const int values = asset.view(corner, sizeof corner);
  auto& sparse = asset.model.accessors[static_cast<size_t>(p.attributes["POSITION"])].sparse;
  sparse.isSparse = true;
  sparse.count = 1;
  sparse.indices = {0, indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE};
  sparse.values = {values, 0};
  asset.place(asset.mesh(p));
  EXPECT_EQ(against_text(asset), 0.0);
}

TEST(GltfMesh, NodesAreMultipliedAndSharedMeshesBecomeObjects) {
  Asset asset;
  const int mesh = asset.mesh(asset.square());
  tinygltf::Node child;
  child.mesh = mesh;
  child.translation = {1, 0, 0};
  const int first = asset.node(child, false);
  child.translation = {-1, 0, 0};
  child.rotation = {0, 0.70710678118654752, 0, 0.70710678118654752};
  const int second = asset.node(child, false);
  tinygltf::Node parent;
  parent.scale = {.4, .4, .4};
  parent.children = {first, second};
  asset.node(parent);
  const std::string path = asset.save("model.gltf");
  const std::string text = "ObjectBegin \"o\"\n" + square_text +
                           "ObjectEnd\nAttributeBegin Scale .4 .4 .4 AttributeBegin "
                           "Translate 1 0 0 ObjectInstance \"o\" AttributeEnd "
                           "Translate -1 0 0 Rotate 90 0 1 0 ObjectInstance \"o\" AttributeEnd\n";
  EXPECT_LT(difference(picture(stage + importing(path)), picture(stage + grey + text)), 1e-3);
  const SceneDescription scene = parse_file(path, nullptr);
  EXPECT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_TRUE(scene.shapes.empty());
}

TEST(GltfMesh, MorphTargetsAtTheirWeights) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  // Half of the square, and what is missing as a target of weight one half.
  p.attributes["POSITION"] = asset.vectors({-1, -1, 0, 0, -1, 0, 0, 1, 0, -1, 1, 0});
  p.targets = {{{"POSITION", asset.vectors({0, 0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0})}}};
  const int mesh = asset.mesh(p);
  asset.model.meshes[0].weights = {.5};
  asset.place(mesh);
  EXPECT_EQ(against_text(asset), 0.0);
}

TEST(GltfMesh, SkinsStandWhereTheirJointsAre) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  p.attributes["POSITION"] = asset.vectors({-1, -3, 0, 1, -3, 0, 1, 1, 0, -1, 1, 0});
  const std::vector<uint8_t> joints = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  p.attributes["JOINTS_0"] =
      asset.accessor(joints, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
  p.attributes["WEIGHTS_0"] =
      asset.vectors({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, TINYGLTF_TYPE_VEC4);
  const int mesh = asset.mesh(p);
  tinygltf::Node low, high, body;
  low.translation = {0, 5, 0};
  high.translation = {0, -1, 0};
  tinygltf::Skin skin;
  skin.joints = {asset.node(low), asset.node(high)};
  // Inverse bind matrices: the first joint was at y = 3, the second at y = -1.
  skin.inverseBindMatrices = asset.vectors({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -3, 0, 1,
                                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1,  0, 1},
                                           TINYGLTF_TYPE_MAT4);
  asset.model.skins.push_back(skin);
  body.mesh = mesh;
  body.skin = 0;
  body.translation = {7, 7, 7};  // has no effect on a skin
  asset.node(body);
  EXPECT_EQ(against_text(asset), 0.0);
}

TEST(GltfMesh, ColoursOfVertices) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  const std::vector<uint8_t> colors = {255, 0, 0,   255, 0,   255, 0,   255,
                                       0,   0, 255, 255, 255, 255, 255, 255};
  p.attributes["COLOR_0"] =
      asset.accessor(colors, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, true);
  asset.place(asset.mesh(p));
  const std::string text =
      "Texture \"v\" \"spectrum\" \"vertexcolor\" MakeNamedMaterial \"m\" \"string type\" "
      "\"principled\" \"texture basecolor\" \"v\" \"float metallic\" 1 \"float roughness\" 1 "
      "NamedMaterial \"m\" " +
      square_text + "\"rgb color\" [ 1 0 0  0 1 0  0 0 1  1 1 1 ]";
  const Image image = picture(stage + importing(asset.save("model.gltf")));
  EXPECT_LT(difference(image, picture(stage + text)), 1e-5);
  EXPECT_GT(difference(image, expected()), .05);
}

TEST(GltfMesh, PointsAndLinesAreLeftOutWithALine) {
  Asset asset;
  tinygltf::Primitive p = asset.square();
  p.mode = TINYGLTF_MODE_LINE;
  asset.place(asset.mesh(p));
  asset.place(asset.mesh(asset.square()));
  std::vector<std::string> log;
  parse_file(asset.save("model.gltf"), &log);
  const bool said = std::ranges::any_of(log, [](const std::string& line) {
    return line.find("1 primitive without triangles") != std::string::npos;
  });
  EXPECT_TRUE(said);
}

#ifdef PSSMLT_HAS_DRACO
TEST(GltfMesh, Draco) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float c[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), c[0], c[1], c[2]);
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(1), c[0], c[2], c[3]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::ExpertEncoder encoder(*mesh);
  draco::EncoderBuffer bytes;
  ASSERT_TRUE(encoder.EncodeToBuffer(&bytes).ok());

  Asset asset;
  tinygltf::Primitive p;
  p.mode = TINYGLTF_MODE_TRIANGLES;
  tinygltf::Accessor a;  // without data: they are in the compressed view
  a.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  a.type = TINYGLTF_TYPE_VEC3;
  a.count = 4;
  a.bufferView = -1;
  a.byteOffset = 0;
  a.sparse.isSparse = false;
  asset.model.accessors.push_back(a);
  a.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  a.type = TINYGLTF_TYPE_SCALAR;
  a.count = 6;
  asset.model.accessors.push_back(a);
  p.attributes["POSITION"] = 0;
  p.indices = 1;
  const int unique = static_cast<int>(mesh->attribute(id)->unique_id());
  p.extensions["KHR_draco_mesh_compression"] =
      object({{"bufferView", tinygltf::Value(asset.view(bytes.data(), bytes.size()))},
              {"attributes", object({{"POSITION", tinygltf::Value(unique)}})}});
  asset.model.extensionsRequired.push_back("KHR_draco_mesh_compression");
  asset.use("KHR_draco_mesh_compression");
  asset.place(asset.mesh(p));
  EXPECT_LT(against_text(asset), 1e-3);
}
#endif

}  // namespace
}  // namespace pssmlt::test
