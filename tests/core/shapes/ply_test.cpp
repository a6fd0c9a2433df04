// PLY files of every kind give the same mesh; broken ones are errors, whatever is broken.
#include "core/shapes/ply.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/base/random.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

enum class Order { Ascii, Little, Big };

// Writes the values of a PLY file's body.
class Body {
 public:
  explicit Body(Order order) : order_(order) {}
  template <typename T>
  Body& put(T value) {
    if (order_ == Order::Ascii) {
      text_ += std::to_string(value) + " ";
      return *this;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (order_ == Order::Big) std::reverse(bytes, bytes + sizeof(T));
    text_.append(bytes, sizeof(T));
    return *this;
  }
  Body& line() {
    if (order_ == Order::Ascii) text_ += "\n";
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  Order order_;
  std::string text_;
};

std::string format_of(Order order) {
  return order == Order::Ascii    ? "ascii"
         : order == Order::Little ? "binary_little_endian"
                                  : "binary_big_endian";
}

// Five vertices with extras of every type, a triangle, a quad and a pentagon, an unknown element.
std::string sample(Order order) {
  std::string file = "ply\nformat " + format_of(order) +
                     " 1.0\ncomment made by hand\nobj_info none\n"
                     "element vertex 5\nproperty float x\nproperty double y\nproperty float z\n"
                     "property uchar red\nproperty float nx\nproperty float ny\nproperty float nz\n"
                     "property float s\nproperty float t\n"
                     "element other 2\nproperty list uchar short stuff\nproperty int8 more\n"
                     "element face 3\nproperty short flags\n"
                     "property list uint8 int vertex_indices\nproperty list int double weights\n"
                     "end_header\n";
  Body b(order);
  for (int i = 0; i < 5; ++i) {
    b.put(float(i)).put(double(i * i)).put(0.5f).put(uint8_t(200));
    b.put(0.f).put(0.f).put(1.f).put(float(i) / 4.f).put(0.25f).line();
  }
  b.put(uint8_t(2)).put(int16_t(-1)).put(int16_t(-2)).put(int8_t(3)).line();
  b.put(uint8_t(0)).put(int8_t(-3)).line();
  for (int count = 3; count <= 5; ++count) {
    b.put(int16_t(7)).put(uint8_t(count));
    for (int i = 0; i < count; ++i) b.put(int32_t(i));
    b.put(int32_t(1)).put(2.5).line();
  }
  return file + b.text();
}

void expect_sample(const MeshData& data) {
  const TriangleMesh& m = data.mesh;
  ASSERT_EQ(m.positions.size(), 5u);
  EXPECT_EQ(m.positions[3], vec3(3.f, 9.f, 0.5f));
  ASSERT_EQ(m.normals.size(), 5u);
  EXPECT_EQ(m.normals[1], vec3(0.f, 0.f, 1.f));
  ASSERT_EQ(m.uvs.size(), 5u);
  EXPECT_EQ(m.uvs[2], vec2(0.5f, 0.25f));
  const std::vector<glm::uvec3> expected{{0, 1, 2}, {0, 1, 2}, {0, 2, 3},
                                         {0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_EQ(m.triangles, expected);
}

std::string error(const std::string& text) {
  const Location where{std::make_shared<const std::string>("scene.txt"), 3, 5};
  try {
    parse_ply(text, "mesh.ply", where);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Ply, AllFormatsGiveTheSameMesh) {
  for (const Order order : {Order::Ascii, Order::Little, Order::Big})
    expect_sample(parse_ply(sample(order), "mesh.ply", {}));
}

TEST(Ply, GzippedAndPlainFilesAreRead) {
  const std::string plain = test::own_file("test.ply");
  const std::string packed = test::own_file("test.ply.gz");
  const std::string text = sample(Order::Little);
  std::ofstream(plain, std::ios::binary) << text;
  const gzFile file = gzopen(packed.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  gzclose(file);
  expect_sample(read_ply(plain, {}));
  expect_sample(read_ply(packed, {}));
}

// Every proper prefix of the file is an error at the scene's place, never a crash or a mesh.
TEST(Ply, TruncatedFilesAreErrors) {
  for (const Order order : {Order::Ascii, Order::Little, Order::Big}) {
    const std::string text = sample(order);
    // The last number of an ASCII file may be cut short and still be one.
    const size_t end = order == Order::Ascii ? text.find_last_of('2') : text.size();
    for (size_t n = 0; n < end; ++n) {
      const std::string message = error(text.substr(0, n));
      ASSERT_EQ(message.find("scene.txt:3:5: PLY file 'mesh.ply': "), 0u) << n << message;
    }
  }
}

// Flipped bytes: an error or a mesh whose indices are in range, never a crash or a huge allocation.
TEST(Ply, DamagedFilesDoNotCrash) {
  RandomStream random(7, RandomUse::test);
  for (const Order order : {Order::Ascii, Order::Little, Order::Big}) {
    const std::string text = sample(order);
    for (int i = 0; i < 5000; ++i) {
      std::string damaged = text;
      const size_t at = random.bits() % damaged.size();
      damaged[at] = static_cast<char>(random.bits());
      try {
        const MeshData data = parse_ply(damaged, "mesh.ply", {});
        for (const glm::uvec3& t : data.mesh.triangles)
          EXPECT_LT(std::max({t.x, t.y, t.z}), data.mesh.positions.size());
      } catch (const Error&) {
      }
    }
  }
}

TEST(Ply, WhatIsWrongIsSaid) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertex =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string points = "0 0 0 1 0 0 0 1 0\n";
  EXPECT_EQ(error(head + vertex + face + "end_header\n" + points + "3 0 1 2"), "");
  const auto says = [](const std::string& text, const char* words) {
    EXPECT_NE(error(text).find(words), std::string::npos) << error(text);
  };
  says("solid stl", "not a PLY file");
  says("ply\nformat ascii2 1.0\n" + vertex + face + "end_header\n", "unknown format");
  says("ply\n" + vertex + face + "end_header\n", "no format");
  says(head + face + "end_header\n3 0 1 2", "no vertices");
  says(head + vertex + "end_header\n" + points, "no faces");
  says(head + vertex + face + "end_header\n" + points + "3 0 1 3", "index 3");
  says(head + vertex + face + "end_header\n" + points + "3 0 1 -1", "index");
  says(head + vertex + face + "end_header\n" + points + "2 0 1", "2 vertices");
  says(head + vertex + face + "end_header\n" + points + "3 0 x 1", "not a number");
  says(head + "element vertex 3\nproperty float x\nproperty float z\n" + face + "end_header\n" +
           points,
       "lack x, y or z");
  says(head + "element vertex 3\nproperty real x\n" + face + "end_header\n", "bad header line");
  says(
      "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\nproperty float x\n"
      "property float y\nproperty float z\n" +
          face + "end_header\nabc",
      "ends within its 99999999999 elements");
}

}  // namespace
}  // namespace pssmlt
