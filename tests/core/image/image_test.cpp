#include "core/image/image.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "core/base/error.h"
#include "core/image/encoding.h"
#include "core/image/image_file.h"

namespace pssmlt {
namespace {
namespace fs = std::filesystem;

class ImageTest : public testing::Test {
 protected:
  ImageTest() : folder_(fs::temp_directory_path() / ("pssmlt-image-" + std::to_string(getpid()))) {
    unsetenv("OCIO");
    fs::create_directories(folder_);
  }
  ~ImageTest() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  void truncate(const std::string& name, double share) const {
    fs::resize_file(path(name), static_cast<uintmax_t>(double(fs::file_size(path(name))) * share));
  }
  fs::path folder_;
};

// Neither smooth nor symmetric, so that it does not compress to nothing.
Image gradient(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = 0.5f + 0.5f * std::sin(0.37f * float(i) + 0.01f * float(i % 97));
  return image;
}

template <typename Expected>
std::string message(const std::function<void()>& what) {
  try {
    what();
  } catch (const Expected& e) {
    return e.what();
  }
  return "";
}

TEST_F(ImageTest, ExrKeepsFloatsLayersAndMetadata) {
  Image image = gradient(13, 7, 6);
  image.channel_names = {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B"};
  image.data[5] = 1e20f;
  image.data[6] = -3.f;
  write_image(path("a.exr"), image, {{"pssmlt:seed", "42"}}, {});
  const Image back = read_image(path("a.exr"), "");
  ASSERT_EQ(back.width, 13);
  ASSERT_EQ(back.height, 7);
  ASSERT_EQ(back.channels, 6);
  for (int c = 0; c < 6; ++c) {
    const auto& name = image.channel_names[size_t(c)];
    const auto at = std::ranges::find(back.channel_names, name) - back.channel_names.begin();
    ASSERT_LT(at, 6) << name;
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 13; ++x) ASSERT_EQ(back.pixel(x, y)[at], image.pixel(x, y)[c]);
  }
  std::ifstream file(path("a.exr"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(bytes.find("pssmlt:seed"), std::string::npos);
  const ImageMetadata metadata = read_image_file(path("a.exr")).metadata;
  EXPECT_NE(std::ranges::find(metadata, std::pair<std::string, std::string>("pssmlt:seed", "42")),
            metadata.end());
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageTest, ExrIsTheSameBytesEachTime) {
  for (const char* name : {"a.exr", "b.exr"}) write_image(path(name), gradient(9, 9), {}, {});
  const auto bytes = [&](const char* name) {
    std::ifstream file(path(name), std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(file)), {});
  };
  EXPECT_EQ(bytes("a.exr"), bytes("b.exr"));
}

TEST_F(ImageTest, PfmIsExactAndHdrClose) {
  const Image image = gradient(11, 5);
  write_image(path("a.pfm"), image, {}, {});
  write_image(path("a.hdr"), image, {}, {});
  const Image pfm = read_image(path("a.pfm"), ""), hdr = read_image(path("a.hdr"), "");
  ASSERT_EQ(pfm.data.size(), image.data.size());
  ASSERT_EQ(hdr.data.size(), image.data.size());
  EXPECT_EQ(pfm.data, image.data);
  // A shared exponent of 8 bits: 1/256 of the largest component, rounded.
  for (size_t i = 0; i < image.data.size(); ++i) EXPECT_NEAR(hdr.data[i], image.data[i], 1.f / 128);
}

TEST_F(ImageTest, PngShowsSrgb) {
  Image image(5, 1, 3);
  const float values[5] = {0.f, 0.5f, 1.f, 7.f, -1.f};
  for (int x = 0; x < 5; ++x) std::fill_n(image.pixel(x, 0), 3, values[x]);
  image.pixel(0, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  write_image(path("a.png"), image, {}, {});
  const ImageFile file = read_image_file(path("a.png"));
  ASSERT_TRUE(file.integer);
  ASSERT_EQ(file.bytes.size(), 15u);
  // IEC 61966-2-1: 0.5 is 0.7354, 187.5 of 255.
  EXPECT_NEAR(file.bytes[3], 188, 1);
  EXPECT_EQ(file.bytes[0], 0);
  EXPECT_EQ(file.bytes[6], 255);
  EXPECT_EQ(file.bytes[9], 255);
  EXPECT_EQ(file.bytes[12], 0);
  EXPECT_NEAR(read_image(path("a.png"), "").data[3], 0.5f, 0.01f);
  EXPECT_NEAR(read_image(path("a.png"), "linear").data[3], 188.f / 255.f, 0.01f);
  EXPECT_NEAR(read_image(path("a.png"), "gamma 2").data[3], sqr(188.f / 255.f), 0.01f);
}

TEST_F(ImageTest, PrimariesKeepTheirHue) {
  Image image(3, 1, 3);
  for (int x = 0; x < 3; ++x) image.pixel(x, 0)[x] = 1.f;
  write_image(path("a.png"), image, {}, {});
  const ImageFile file = read_image_file(path("a.png"));
  for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(file.bytes[i], i % 4 == 0 ? 255 : 0, 1) << i;
}

TEST_F(ImageTest, ViewsAreChosenByName) {
  const Image image = gradient(4, 4);
  write_image(path("s.png"), image, {}, {"sRGB"});
  write_image(path("d.png"), image, {}, {});
  write_image(path("a.png"), image, {}, {"ACES 1.0 SDR"});
  EXPECT_EQ(read_image_file(path("s.png")).bytes, read_image_file(path("d.png")).bytes);
  EXPECT_NE(read_image_file(path("s.png")).bytes, read_image_file(path("a.png")).bytes);
  const std::string error = message<Error>([&] { check_view({"filmic"}); });
  EXPECT_NE(error.find("'sRGB', 'ACES 1.0 SDR'"), std::string::npos) << error;
  EXPECT_NE(message<Error>([&] { write_image(path("f.png"), image, {}, {"filmic"}); }), "");
  EXPECT_FALSE(fs::exists(path("f.png")));
  EXPECT_EQ(files(), 3u);
}

TEST_F(ImageTest, ForeignConfigurationIsRespected) {
  std::ofstream(path("config.ocio"))
      << "ocio_profile_version: 2\nroles:\n  scene_linear: lin_rec709\n  default: lin_rec709\n"
         "displays:\n  Screen:\n    - !<View> {name: Doubled, colorspace: twice}\n"
         "colorspaces:\n  - !<ColorSpace>\n    name: lin_rec709\n"
         "  - !<ColorSpace>\n    name: twice\n    from_scene_reference: "
         "!<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}\n";
  setenv("OCIO", path("config.ocio").c_str(), 1);
  Image image(1, 1, 3);
  std::ranges::fill(image.data, 0.25f);
  write_image(path("a.png"), image, {}, {});
  EXPECT_NE(message<Error>([] { check_view({"sRGB"}); }).find("'Doubled'"), std::string::npos);
  setenv("OCIO", path("missing.ocio").c_str(), 1);
  EXPECT_NE(message<Error>([] { check_view({}); }).find("$OCIO"), std::string::npos);
  unsetenv("OCIO");
  EXPECT_EQ(read_image_file(path("a.png")).bytes[0], 128);
}

TEST_F(ImageTest, JpegIsClose) {
  Image image(16, 16, 3);
  std::ranges::fill(image.data, 0.3f);
  write_image(path("a.jpg"), image, {}, {});
  EXPECT_NEAR(read_image(path("a.jpg"), "").data[100], 0.3f, 0.02f);
}

TEST_F(ImageTest, BrokenFilesAreErrors) {
  for (const char* name : {"a.png", "a.exr", "a.jpg", "a.pfm", "a.hdr"}) {
    for (const double share : {0.9, 0.5, 0.02}) {
      write_image(path(name), gradient(64, 64), {}, {});
      truncate(name, share);
      const std::string error = message<Error>([&] { read_image(path(name), ""); });
      EXPECT_NE(error.find(name), std::string::npos) << name << " " << share << " " << error;
    }
  }
  std::ofstream(path("text.png")) << "no image at all";
  EXPECT_NE(message<Error>([&] { read_image(path("text.png"), ""); }), "");
  EXPECT_NE(message<Error>([&] { read_image(path("missing.exr"), ""); }), "");
  EXPECT_NE(message<Error>([&] { read_image(folder_.string(), ""); }), "");
}

TEST_F(ImageTest, UnwritableIsFoundBeforehand) {
  EXPECT_NO_THROW(check_writable(path("a.exr")));
  EXPECT_EQ(files(), 0u);
  for (const char* name : {"a.gif", "a", "no/such/folder/a.exr"})
    EXPECT_NE(message<Error>([&] { check_writable(path(name)); }).find(name), std::string::npos);
  fs::create_directory(path("folder.exr"));
  EXPECT_NE(message<Error>([&] { check_writable(path("folder.exr")); }), "");
  for (const char* name : {"no/a.exr", "no/a.pfm", "no/a.png", "a.gif"})
    EXPECT_NE(message<Failure>([&] { write_image(path(name), gradient(2, 2), {}, {}); }), "")
        << name;
}

TEST_F(ImageTest, FailedWriteLeavesTheOldFile) {
  write_image(path("a.png"), gradient(2, 2), {}, {});
  const auto before = read_image_file(path("a.png")).bytes;
  EXPECT_ANY_THROW(write_image(path("a.png"), gradient(3, 3), {}, {"none"}));
  EXPECT_EQ(read_image_file(path("a.png")).bytes, before);
  EXPECT_EQ(files(), 1u);
}

TEST(Encoding, NamesAndInverses) {
  for (const char* name : {"sRGB", "linear", "gamma 2.2"}) {
    const Encoding e = Encoding::parse(name);
    for (const float v : {0.f, 0.001f, 0.04f, 0.3f, 1.f})
      EXPECT_NEAR(e.from_linear(e.to_linear(v)), v, 1e-5f) << name;
  }
  EXPECT_NEAR(Encoding::srgb().to_linear(0.5f), 0.21404f, 1e-4f);
  for (const char* name : {"", "srgb ", "gamma", "gamma x", "gamma -1", "gamma 0"})
    EXPECT_NE(message<Error>([&] { Encoding::parse(name); }), "") << name;
}

}  // namespace
}  // namespace pssmlt
