// Shapes and meshes that are none, in the scene or in files of their own.
#include "tests/bad_input/bad_input.h"

namespace pssmlt::test {
namespace {

std::string triangles(const std::string& indices, const std::string& positions) {
  return world("Shape \"trianglemesh\" \"integer indices\" [" + indices + "] \"point3 P\" [" +
               positions + "]");
}

BadInput ply(const std::string& name, const std::string& bytes, std::vector<std::string> words) {
  return {name,
          world("Shape \"plymesh\" \"string filename\" \"mesh.ply\""),
          std::move(words),
          "4:1",
          {{"mesh.ply", bytes}}};
}

std::string ply_header(const std::string& format, const std::string& vertices,
                       const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

BadInput gltf(const std::string& name, const std::string& bytes, std::vector<std::string> words) {
  return {name,
          world("Shape \"gltf\" \"string filename\" \"mesh.gltf\""),
          std::move(words),
          "4:14",
          {{"mesh.gltf", bytes}}};
}

// One triangle; `accessor` is the position accessor, `uri` where its bytes are.
std::string gltf_text(const std::string& accessor, const std::string& uri) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [)" +
         accessor + R"(], "bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": ")" +
         uri + R"("}]})";
}

const char* const good_accessor =
    R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})";

std::vector<BadInput> bad_ply() {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  return {
      {"NoPly", world("Shape \"plymesh\" \"string filename\" \"none.ply\""), {"none.ply"}, "4:17"},
      {"NoPlyName", world("Shape \"plymesh\""), {"filename", "missing"}, "4:1"},
      {"PlyIsFolder", world("Shape \"plymesh\" \"string filename\" \".\""), {"directory"}, "4:17"},
      ply("EmptyPly", "", {"mesh.ply"}),
      ply("NotPly", "solid cube\nfacet normal\n", {"not a PLY file"}),
      ply("PlyHeaderCut", "ply\nformat ascii 1.0\nelement vertex 3\n", {"header does not end"}),
      ply("PlyFormat", ply_header("morse", "3", "1"), {"unknown format"}),
      ply("PlyCut", ply_header("ascii", "3", "1") + "0 0 0\n1 0", {"ends within"}),
      ply("PlyBinaryCut", ply_header("binary_little_endian", "3", "1") + std::string(20, '\0'),
          {"ends within"}),
      ply("PlyManyVertices", ply_header("binary_little_endian", "4000000000", "1"),
          {"ends within"}),
      ply("PlyNegativeCount", ply_header("ascii", "-3", "1") + three, {"mesh.ply"}),
      ply("PlyIndex", ply_header("ascii", "3", "1") + three + "3 0 1 9\n",
          {"index 9", "3 vertices"}),
      ply("PlyNegativeIndex", ply_header("ascii", "3", "1") + three + "3 0 1 -1\n", {"index -1"}),
      ply("PlyTwoCorners", ply_header("ascii", "3", "1") + three + "2 0 1\n", {"2 vertices"}),
      ply("PlyNaN", ply_header("ascii", "3", "1") + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", {"finite"}),
      ply("PlyWord", ply_header("ascii", "3", "1") + "0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n",
          {"zero", "not a number"}),
  };
}

std::vector<BadInput> bad_gltf() {
  return {
      {"NoGltf", world("Shape \"gltf\" \"string filename\" \"none.gltf\""), {"none.gltf"}, "4:14"},
      gltf("EmptyGltf", "", {"mesh.gltf"}),
      gltf("GltfCut", R"({"asset": {"version": "2.0"}, "meshes": [)", {"mesh.gltf"}),
      gltf("GltfGarbage", "glTF\x01\x02\x03 no JSON", {"mesh.gltf"}),
      gltf("GltfNoBuffer", gltf_text(good_accessor, "none.bin"), {"mesh.gltf"}),
      gltf("GltfShortBuffer",
           gltf_text(good_accessor, "data:application/octet-stream;base64,AAAAAA=="),
           {"mesh.gltf"}),
      gltf("GltfAccessorTooLong",
           gltf_text(R"({"bufferView": 0, "componentType": 5126, "count": 300000000,)"
                     R"( "type": "VEC3"})",
                     "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAA"
                     "AAgD8AAAAA"),
           {"mesh.gltf"}),
      gltf("GltfNoSuchView",
           gltf_text(R"({"bufferView": 7, "componentType": 5126, "count": 3, "type": "VEC3"})",
                     "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAA"
                     "AAgD8AAAAA"),
           {"mesh.gltf"}),
      {"GlbCut",
       world("Shape \"gltf\" \"string filename\" \"mesh.glb\""),
       {"mesh.glb"},
       "4:14",
       {{"mesh.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12)}}},
  };
}

}  // namespace

std::vector<BadInput> bad_shapes() {
  const std::string three = "0 0 0 1 0 0 0 1 0";
  std::vector<BadInput> all = {
      {"NoRadius", world("Shape \"sphere\" \"float radius\" 0"), {"radius", "positive"}, "4:16"},
      {"FarAway", world("Translate 1e30 0 0 Shape \"sphere\""), {"too far"}, "4:20"},
      {"FarAwayMesh",
       world("Translate 1e30 0 0 Shape \"trianglemesh\" \"point3 P\" [" + three + "]"),
       {"too far"},
       "4:20"},
      {"TinyInstance",
       world("ObjectBegin \"o\" Shape \"sphere\" ObjectEnd Scale 1e-18 1e-18 1e-18 "
             "ObjectInstance \"o\""),
       {"instance is too small"}},
      {"NegativeRadius",
       world("Shape \"disk\" \"float radius\" -1"),
       {"radius", "positive"},
       "4:14"},
      {"NoSphereLeft", world("Shape \"sphere\" \"float zmin\" 2 \"float zmax\" 3"), {"zmin"}},
      {"IndexTooLarge", triangles("0 1 3", three), {"index 3", "3 vertices"}, "4:22"},
      {"IndexNegative", triangles("0 1 -1", three), {"-1", "negative"}, "4:22"},
      {"IndexOdd", triangles("0 1", three), {"multiple of three"}, "4:22"},
      {"NoVertices", world("Shape \"trianglemesh\""), {"\"P\"", "missing"}, "4:1"},
      {"NormalsTooFew",
       world("Shape \"trianglemesh\" \"point3 P\" [" + three + "] \"normal N\" [0 0 1]"),
       {"1", "3 vertices"},
       "4:53"},
      {"VertexOutOfRange",
       triangles("0 1 2", three) + "Scale 1 100 1\n" +
           "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1e38 0]\n",
       {"range of single precision"},
       "6:22"},
      {"PatchIndex",
       world("Shape \"bilinearmesh\" \"integer indices\" [0 1 2 4] \"point3 P\" [" + three +
             " 1 1 0]"),
       {"index 4", "4 vertices"},
       "4:22"},
      {"PatchIndices",
       world("Shape \"bilinearmesh\" \"integer indices\" [0 1 2] \"point3 P\" [" + three +
             " 1 1 0]"),
       {"multiple of four"},
       "4:22"},
      {"SubdivisionLevels",
       world(
           "Shape \"loopsubdiv\" \"integer levels\" 1000 \"integer indices\" [0 1 2] \"point3 P\" "
           "[" +
           three + "]"),
       {"levels"},
       "4:20"},
      {"SubdivisionIndex",
       world("Shape \"loopsubdiv\" \"integer indices\" [0 1 200] \"point3 P\" [" + three + "]"),
       {"200"},
       "4:20"},
      {"SubdivisionOfOneVertex",
       world("Shape \"loopsubdiv\" \"integer indices\" [0 0 0] \"point3 P\" [0 0 0]"),
       {"indices"},
       "4:20"},
      {"LightWithoutArea",
       world("AreaLightSource \"diffuse\" \"float power\" 10\nShape \"trianglemesh\" \"integer "
             "indices\" [0 0 0] \"point3 P\" [" +
             three + "]"),
       {"no area"},
       "4:27"},
  };
  for (BadInput& bad : bad_ply()) all.push_back(std::move(bad));
  for (BadInput& bad : bad_gltf()) all.push_back(std::move(bad));
  return all;
}

}  // namespace pssmlt::test
