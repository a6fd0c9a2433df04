// Images survive packing within the errors that the header promises, and what does not is counted.
#include "app/report/image_pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.h"

namespace {

using pssmlt::Image;
using pssmlt::pack_image;
using pssmlt::Precision;
using pssmlt::unpack_image;

constexpr float infinity = std::numeric_limits<float>::infinity();

Image row(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size()), 1, 1);
  image.data = values;
  return image;
}

// Green of each pixel after a round trip.
std::vector<float> round_trip(const std::vector<float>& values, Precision precision) {
  const Image image = unpack_image(pack_image(row(values), precision));
  std::vector<float> green;
  for (size_t i = 1; i < image.data.size(); i += 3) green.push_back(image.data[i]);
  return green;
}

// Log-normal noise over 20 powers of two, channels unlike each other, an odd width.
Image noise() {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(0.f, 3.f);
  Image image(37, 23, 3);
  for (float& v : image.data) v = std::exp2(normal(random));
  return image;
}

TEST(ImagePack, ExactKeepsElevenBits) {
  const Image image = noise(), back = unpack_image(pack_image(image, Precision::exact));
  ASSERT_EQ(back.width, 37);
  ASSERT_EQ(back.height, 23);
  ASSERT_EQ(back.data.size(), image.data.size());
  for (size_t i = 0; i < image.data.size(); ++i) {
    ASSERT_NEAR(back.data[i], image.data[i], image.data[i] * std::ldexp(1.f, -11)) << i;
  }
}

TEST(ImagePack, HalfFloatsComeBackBitForBit) {
  const std::vector<float> halves = {0.f, 1.f, 0.333251953125f, -2.5f, 1024.f, 6.103515625e-05f};
  EXPECT_EQ(round_trip(halves, Precision::exact), halves);
}

TEST(ImagePack, LogarithmicStaysWithinHalfAStep) {
  const Image image = noise();
  const pssmlt::PackedImage packed = pack_image(image, Precision::logarithmic);
  EXPECT_LE(packed.step, 1.0 / 8);
  EXPECT_EQ(packed.losses.clamped, 0);
  const double bound = std::exp2(packed.step / 2) - 1 + 1e-6;
  const Image back = unpack_image(packed);
  for (size_t i = 0; i < image.data.size(); ++i) {
    ASSERT_LE(std::abs(back.data[i] / image.data[i] - 1.f), bound) << i;
  }
}

TEST(ImagePack, DarkAndBrightPicturesKeepTheirPrecision) {
  for (const float scale : {1e-9f, 1e9f}) {
    const std::vector<float> values = {scale, 0.37f * scale, 0.011f * scale};
    for (const auto precision : {Precision::exact, Precision::logarithmic}) {
      const float bound = precision == Precision::exact ? std::ldexp(1.f, -11) : 0.045f;
      const std::vector<float> back = round_trip(values, precision);
      for (size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(back[i], values[i], bound * values[i]);
      }
      EXPECT_EQ(pack_image(row(values), precision).losses.clamped, 0);
    }
  }
}

TEST(ImagePack, OneFireflyDoesNotCostThePicture) {
  std::vector<float> values(100, 0.5f);
  values[50] = 1e12f;
  const pssmlt::PackedImage packed = pack_image(row(values), Precision::exact);
  EXPECT_EQ(packed.losses.clamped, 3);  // grey: three channels
  const std::vector<float> back = round_trip(values, Precision::exact);
  EXPECT_EQ(back[0], 0.5f);
  EXPECT_GT(back[50], 1e6f);
}

TEST(ImagePack, NonFiniteValuesAreCountedAndSeen) {
  const std::vector<float> values = {1.f, NAN, infinity, -infinity, 2.f};
  const std::vector<float> back = round_trip(values, Precision::exact);
  EXPECT_EQ(back[0], 1.f);
  EXPECT_TRUE(std::isnan(back[1]));
  EXPECT_EQ(back[2], infinity);
  EXPECT_EQ(back[3], -infinity);
  EXPECT_EQ(back[4], 2.f);
  EXPECT_TRUE(std::isnan(round_trip(values, Precision::logarithmic)[2]));
  for (const auto precision : {Precision::exact, Precision::logarithmic}) {
    EXPECT_EQ(pack_image(row(values), precision).losses.non_finite, 9);
  }
}

TEST(ImagePack, ZeroIsZeroAndNegativesAreClampedByTheLogarithm) {
  const std::vector<float> values = {0.f, -1.f, 4.f};
  EXPECT_EQ(round_trip(values, Precision::exact), values);
  const std::vector<float> back = round_trip(values, Precision::logarithmic);
  EXPECT_EQ(back[0], 0.f);
  EXPECT_EQ(back[1], 0.f);
  EXPECT_NEAR(back[2], 4.f, 1e-5f);
  EXPECT_EQ(pack_image(row(values), Precision::logarithmic).losses.clamped, 3);
  const std::vector<float> black(3, 0.f);
  for (const auto precision : {Precision::exact, Precision::logarithmic}) {
    EXPECT_EQ(round_trip(black, precision), black);
  }
}

TEST(ImagePack, ChannelsAreFoundByName) {
  Image image(1, 1, 4);
  image.channel_names = {"A", "B", "G", "R"};
  image.data = {9.f, 3.f, 2.f, 1.f};
  EXPECT_EQ(unpack_image(pack_image(image, Precision::exact)).data,
            (std::vector<float>{1.f, 2.f, 3.f}));
}

TEST(ImagePack, ImpossibleImagesAreRefused) {
  EXPECT_THROW(pack_image(Image(), Precision::exact), pssmlt::Error);
  EXPECT_THROW(pack_image(Image(2, 2, 2), Precision::exact), pssmlt::Error);
  Image short_of_data(2, 2, 3);
  short_of_data.data.pop_back();
  EXPECT_THROW(pack_image(short_of_data, Precision::exact), pssmlt::Error);
  pssmlt::PackedImage broken = pack_image(Image(2, 2, 3), Precision::exact);
  broken.deflated.resize(broken.deflated.size() / 2);
  EXPECT_THROW(unpack_image(broken), pssmlt::Failure);
}

TEST(ImagePack, ScriptIsOneCallWithBase64) {
  Image image(1, 1, 3);
  const std::string script = image_script("a.b-1", pack_image(image, Precision::logarithmic));
  EXPECT_TRUE(script.starts_with("pssmltReport.image({"));
  EXPECT_TRUE(script.ends_with("});\n"));
  EXPECT_NE(script.find("\"id\":\"a.b-1\""), std::string::npos);
  EXPECT_NE(script.find("\"data\":\"eJ"), std::string::npos) << "a zlib stream at level 6";
}

}  // namespace
