// Files of measurements that are wrong in any way are located errors, never crashes.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/make_plugin.h"
#include "tests/support/measured_files.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;

Rgb lambert(const vec3&, const vec3&) { return Rgb(.2f, .5f, .8f) * inv_pi; }

std::string error_with(const std::string& bytes) {
  const std::string path = own_file("wrong");
  write_bytes(path, bytes);
  return error_of([&] { make_material("measured", {text("filename", path)}); });
}
void expect_refused(const std::string& bytes, const std::string& word) {
  const std::string error = error_with(bytes);
  EXPECT_NE(error.find(word), std::string::npos) << word << ": " << error;
  EXPECT_NE(error.find("test-scene:7:3"), std::string::npos) << error;
}

TEST(MeasuredFiles, WrongTensorFilesAreErrors) {
  const TensorWriter good = tensor_file(lambert, {.size = 4});
  const std::string bytes = good.bytes();
  EXPECT_EQ(error_with(bytes), "");
  // Every truncation fails, with a message.
  for (size_t n = 0; n < bytes.size(); n += n < 600 ? 1 : 97)
    EXPECT_NE(error_with(bytes.substr(0, n)), "") << n;
  expect_refused("", "too short");
  expect_refused(bytes.substr(0, 500), "the file");
  for (const char* name : {"phi_i", "theta_i", "ndf", "sigma", "vndf", "luminance", "rgb"}) {
    TensorWriter missing = good;
    missing.drop(name);
    expect_refused(missing.bytes(), std::string("\"") + name + "\" is missing");
    TensorWriter nan = good;
    nan.set(name, 0, std::numeric_limits<float>::quiet_NaN());
    expect_refused(nan.bytes(), "not finite");
    TensorWriter bytes_only = good;
    bytes_only.field(name).type = 1;
    expect_refused(bytes_only.bytes(), std::string("\"") + name + "\"");
    TensorWriter huge = good;
    huge.field(name).shape[0] = uint64_t{1} << 62;
    expect_refused(huge.bytes(), "beyond the end");
    TensorWriter empty = good;
    empty.field(name).shape[0] = 0;
    expect_refused(empty.bytes(), "is empty");
    TensorWriter flat = good;
    flat.field(name).shape.push_back(1);
    expect_refused(flat.bytes(), "dimensions");
  }
  for (const char* name : {"ndf", "sigma", "vndf", "luminance"}) {
    TensorWriter negative = good;
    negative.set(name, 1, -1.f);
    expect_refused(negative.bytes(), "negative");
  }
  TensorWriter disordered = good;
  disordered.set("theta_i", 1, -3.f);
  expect_refused(disordered.bytes(), "ascend");
  TensorWriter other_directions = good;
  other_directions.field("vndf").shape = {4, 2, 4, 4};
  expect_refused(other_directions.bytes(), "directions");
  TensorWriter thin = good;
  thin.field("ndf").shape = {16, 1};
  expect_refused(thin.bytes(), "nodes");
  std::string version = bytes;
  version[12] = 9;
  expect_refused(version, "version 9.0");
  std::string fields = bytes;
  fields[17] = 127;
  expect_refused(fields, "too many");
}

// What a file may say without being wrong in form: zeros everywhere are black, not a crash.
TEST(MeasuredFiles, ZerosAreBlack) {
  TensorWriter zeros = tensor_file(lambert, {.size = 4});
  for (const char* name : {"ndf", "sigma", "vndf", "luminance", "rgb"})
    std::ranges::fill(zeros.field(name).bytes, '\0');
  for (const std::string& bytes :
       {zeros.bytes(), merl_file([](const vec3&, const vec3&) { return Rgb(0.f); }, {4, 4, 4})}) {
    const std::string path = own_file("zeros");
    write_bytes(path, bytes);
    const auto material = make_material("measured", {text("filename", path)});
    BsdfStorage storage;
    const Bsdf* const bsdf = material->bsdf(Hit(), {}, storage);
    RandomStream random(5, RandomUse::test);
    for (int i = 0; i < 100; ++i) {
      const float lobe = random.next();
      const float x = random.next();
      const float y = random.next();
      const auto s = bsdf->sample(polar(.4f, 1.f), lobe, {x, y}, Transport::radiance);
      if (!s) continue;
      EXPECT_TRUE(is_black(s->weight));
      EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0.f);
    }
  }
}

TEST(MeasuredFiles, WrongMerlFilesAreErrors) {
  const std::string bytes = merl_file(lambert, {4, 3, 5});
  EXPECT_EQ(error_with(bytes), "");
  expect_refused(bytes.substr(0, bytes.size() - 1), "has 1452 bytes, this file 1451");
  expect_refused(bytes + "x", "this file 1453");
  expect_refused(bytes.substr(0, 12), "this file 12");
  expect_refused("nothing of the kind", "neither");
  std::string wrong = bytes;
  const int huge = 2000;
  for (const size_t at : {0u, 4u, 8u}) std::memcpy(wrong.data() + at, &huge, sizeof huge);
  expect_refused(wrong, "2000 x 2000 x 2000");
  wrong = bytes;
  const int negative = -90;
  std::memcpy(wrong.data(), &negative, sizeof negative);
  expect_refused(wrong, "neither");
  for (const double value : {std::nan(""), HUGE_VAL, 1e300}) {
    wrong = bytes;
    std::memcpy(wrong.data() + 100, &value, sizeof value);
    expect_refused(wrong, "not finite");
  }
}

TEST(MeasuredFiles, NeedsItsFile) {
  EXPECT_NE(error_of([] { make_material("measured"); }).find("\"filename\" is missing"),
            std::string::npos);
  EXPECT_NE(error_of([] {
              make_material("measured", {text("filename", "/nowhere/to/be/found")});
            }).find("test-scene:7:3"),
            std::string::npos);
}

}  // namespace
}  // namespace pssmlt
