// glTF files as scenes that are broken or hostile: each names the file and the place in it.
#include "tests/bad_input/bad_input.h"

namespace pssmlt::test {
namespace {

// Parts of a file with one triangle, which a case replaces one of.
struct Parts {
  std::string nodes = R"([{"mesh": 0}])";
  std::string primitive = R"({"attributes": {"POSITION": 0}})";
  std::string accessors =
      R"([{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}])";
  std::string views = R"([{"buffer": 0, "byteLength": 36}])";
  // (0,0,0) (1,0,0) (0,1,0)
  std::string buffers = R"([{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
                        R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])";
  std::string more = {};  // members of the whole, with a comma before

  std::string text() const {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" +
           nodes + R"(, "meshes": [{"primitives": [)" + primitive + R"(]}], "accessors": )" +
           accessors + R"(, "bufferViews": )" + views + R"(, "buffers": )" + buffers + more + "}";
  }
};

BadInput file(const std::string& name, const std::string& bytes, std::vector<std::string> words,
              const std::string& ending = "gltf") {
  const std::string path = "model." + ending;
  words.push_back(path);
  return {name,
          "-",
          std::move(words),
          "",
          {{path, bytes}},
          {path, "-o", "out.pfm", "--threads", "1", "--spp", "1", "--size", "8x8"}};
}

BadInput accessor(const std::string& name, const std::string& text,
                  std::vector<std::string> words) {
  Parts parts;
  parts.accessors = "[" + text + "]";
  return file(name, parts.text(), std::move(words));
}
BadInput primitive(const std::string& name, const std::string& text,
                   std::vector<std::string> words) {
  Parts parts;
  parts.primitive = text;
  return file(name, parts.text(), std::move(words));
}
BadInput nodes(const std::string& name, const std::string& text, std::vector<std::string> words) {
  Parts parts;
  parts.nodes = text;
  return file(name, parts.text(), std::move(words));
}
BadInput views(const std::string& name, const std::string& text, std::vector<std::string> words) {
  Parts parts;
  parts.views = text;
  return file(name, parts.text(), std::move(words));
}
BadInput with(const std::string& name, const std::string& more, std::vector<std::string> words,
              const std::string& material = "") {
  Parts parts;
  parts.more = ", " + more;
  if (!material.empty())
    parts.primitive = R"({"attributes": {"POSITION": 0}, "material": )" + material + "}";
  return file(name, parts.text(), std::move(words));
}

std::string binary(uint32_t length, uint32_t chunk, const std::string& json) {
  std::string bytes = "glTF";
  const auto add = [&](uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (8 * i));
  };
  add(2);
  add(length);
  add(chunk);
  bytes += "JSON" + json;
  return bytes;
}

std::vector<BadInput> bad_accessors() {
  return {
      accessor("GltfCountTooLarge",
               R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})",
               {"accessors[0]: reaches beyond its buffer view"}),
      accessor("GltfCountHuge",
               R"({"bufferView": 0, "componentType": 5126, "count": 4294967295, "type": "VEC3"})",
               {"too many vertices"}),
      accessor("GltfCountWithoutData",
               R"({"componentType": 5126, "count": 2000000000, "type": "VEC3"})",
               {"accessors[0]", "without data"}),
      accessor("GltfCountNegative",
               R"({"bufferView": 0, "componentType": 5126, "count": -3, "type": "VEC3"})", {}),
      accessor(
          "GltfOffsetOutside",
          R"({"bufferView": 0, "byteOffset": 400, "componentType": 5126, "count": 3, "type": "VEC3"})",
          {"accessors[0]"}),
      accessor("GltfPairsForPositions",
               R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"})",
               {"accessors[0]", "2 components", "POSITION"}),
      accessor("GltfNoView",
               R"({"bufferView": 9, "componentType": 5126, "count": 3, "type": "VEC3"})",
               {"bufferViews[9] does not exist"}),
      accessor("GltfSparseOutside",
               R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse":
               {"count": 1, "indices": {"bufferView": 0, "byteOffset": 12, "componentType": 5125},
                "values": {"bufferView": 0}}})",
               {"accessors[0].sparse.indices", "out of range"}),
      accessor("GltfSparseNegative",
               R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "sparse":
               {"count": 1, "indices": {"bufferView": 0, "byteOffset": -8, "componentType": 5125},
                "values": {"bufferView": 0}}})",
               {"accessors[0].sparse.indices", "negative"}),
      views("GltfViewOutside", R"([{"buffer": 0, "byteOffset": 20, "byteLength": 36}])",
            {"bufferViews[0]: reaches beyond its buffer"}),
      views("GltfViewOfNoBuffer", R"([{"buffer": 3, "byteLength": 36}])",
            {"bufferViews[0]: buffers[3] does not exist"}),
  };
}

std::vector<BadInput> bad_trees() {
  return {
      nodes("GltfNodeInItself", R"([{"mesh": 0, "children": [0]}])", {"nodes[0]", "itself"}),
      nodes("GltfNodesInACircle", R"([{"children": [1]}, {"mesh": 0, "children": [0]}])",
            {"nodes[0]", "itself"}),
      nodes("GltfNodeBelowTwo",
            R"([{"children": [1, 2]}, {"children": [3]}, {"children": [3]}, {"mesh": 0}])",
            {"nodes[3]", "below two"}),
      nodes("GltfNoSuchChild", R"([{"children": [7]}])", {"nodes[0]: nodes[7] does not exist"}),
      nodes("GltfNoSuchMesh", R"([{"mesh": 5}])", {"nodes[0]: meshes[5] does not exist"}),
      nodes("GltfNoSuchSkin", R"([{"mesh": 0, "skin": 2}])", {"skins[2] does not exist"}),
      primitive("GltfNoSuchAccessor", R"({"attributes": {"POSITION": 3}})",
                {"meshes[0].primitives[0].attributes", "accessors[3] does not exist"}),
      primitive("GltfFloatsAsIndices", R"({"attributes": {"POSITION": 0}, "indices": 0})",
                {"accessors[0]", "unsigned"}),
      primitive("GltfModeUnknown", R"({"attributes": {"POSITION": 0}, "mode": 9})",
                {"meshes[0].primitives[0]", "mode"}),
      primitive("GltfNormalsDoNotFit",
                R"({"attributes": {"POSITION": 0, "JOINTS_0": 0, "NORMAL": 4}})",
                {"accessors[4] does not exist"}),
      primitive("GltfNoSuchMaterial", R"({"attributes": {"POSITION": 0}, "material": 2})",
                {"meshes[0].primitives[0]: materials[2] does not exist"}),
      with("GltfNoSuchTexture",
           R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 4}}}])",
           {"materials[0]: textures[4] does not exist"}, "0"),
      with("GltfImageMissing",
           R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
           "textures": [{"source": 0}], "images": [{"uri": "none.png"}])",
           {"images[0]", "none.png"}, "0"),
      with("GltfImageIsNone",
           R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
           "textures": [{"source": 0}], "images": [{"bufferView": 0, "mimeType": "image/png"}])",
           {"images[0]"}, "0"),
      with("GltfTextureOfBasis",
           R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
           "textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}])",
           {"textures[0]", "KHR_texture_basisu"}, "0"),
      with("GltfExtensionRequired", R"("extensionsRequired": ["EXT_meshopt_compression"])",
           {"extensionsRequired[0]", "EXT_meshopt_compression"}),
  };
}

}  // namespace

std::vector<BadInput> bad_gltf_scenes() {
  std::vector<BadInput> all = {
      file("GltfSceneEmpty", "", {"empty"}),
      file("GltfSceneText", "not JSON at all", {}),
      file("GltfSceneCut", Parts().text().substr(0, 200), {}),
      file("GltfSceneDeep",
           "{\"extras\": " + std::string(100000, '[') + std::string(100000, ']') + "}", {"nested"}),
      file("GlbCut", binary(5000, 4000, "{}"), {"truncated"}, "glb"),
      file("GlbChunkCut", binary(24, 4000, "{}  "), {"truncated"}, "glb"),
      file("GlbShort", "glTF\2", {"truncated"}, "glb"),
      file("GlbWithoutBytes", binary(22, 2, "{}"), {}, "glb"),
      {"GltfSceneMissing",
       "-",
       {"cannot read", "none.gltf"},
       "",
       {},
       {"none.gltf", "-o", "out.pfm"}},
      {"GltfImportMissing", world("Import \"none.glb\""), {"cannot read", "none.glb"}, ""},
      {"GltfInclude",
       world("Include \"model.gltf\""),
       {"model.gltf"},
       "",
       {{"model.gltf", Parts().text()}}},
  };
  Parts no_bytes;
  no_bytes.buffers = R"([{"byteLength": 36, "uri": "none.bin"}])";
  all.push_back(file("GltfBufferMissing", no_bytes.text(), {"none.bin"}));
  Parts short_buffer;
  short_buffer.buffers =
      R"([{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAA"}])";
  all.push_back(file("GltfBufferShort", short_buffer.text(), {}));
  for (BadInput& bad : bad_accessors()) all.push_back(std::move(bad));
  for (BadInput& bad : bad_trees()) all.push_back(std::move(bad));
  // Strange, but with a right picture: nothing to see.
  Parts nothing;
  nothing.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"}])";
  all.push_back(file("GltfNoVertices", nothing.text(), {"without triangles left out"}));
  all.back().renders = true;
  // tinygltf reads it as none, which is right here.
  all.push_back(
      views("GltfStrideNegative", R"([{"buffer": 0, "byteLength": 36, "byteStride": -4}])", {}));
  all.back().renders = true;
  Parts flat;
  flat.nodes = R"([{"mesh": 0, "scale": [0, 0, 0]}])";
  all.push_back(file("GltfScaledToNothing", flat.text(), {"no shapes"}));
  all.back().renders = true;
  return all;
}

}  // namespace pssmlt::test
