// Small files of meshes, written by tests that read them.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace pssmlt::test {

// A file in the tests' own folder; returns its path.
inline std::string write_file(const std::string& name, const std::string& content) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

// A right triangle in a buffer of base64, under a node that moves and mirrors it.
inline std::string gltf(const std::string& length = "42", const std::string& indices = "1") {
  // indices 0 1 2 (uint16), two bytes of padding, positions (0,0,0) (1,0,0) (0,1,0)
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[-2,1,1]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":)" +
         indices + R"(},"indices":0}]}],
    "accessors":[{"bufferView":0,"componentType":5123,"count":3,"type":"SCALAR"},
                 {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":6},
                   {"buffer":0,"byteOffset":8,"byteLength":36}],
    "buffers":[{"byteLength":)" +
         length +
         R"(,"uri":"data:application/octet-stream;base64,)"
         R"(AAABAAIAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAA="}]})";
}

}  // namespace pssmlt::test
