#include "app/live/half_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace pssmlt {
namespace {

TEST(HalfImage, EveryHalfIsItself) {
  for (uint32_t h = 0; h < 65536; ++h) {
    const auto bits = static_cast<uint16_t>(h);
    const float value = half_value(bits);
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(half_value(half_bits(value))));
    } else if (std::isinf(value)) {
      EXPECT_EQ(half_value(half_bits(value)), std::copysign(65504.f, value));
    } else {
      ASSERT_EQ(half_bits(value), bits) << value;
      ASSERT_EQ(value, glm::unpackHalf1x16(bits));
    }
  }
}

// Between two halves the nearer one is taken, in the middle the even one.
TEST(HalfImage, RoundsToNearestEven) {
  for (uint32_t h = 0; h < 0x7bff; ++h) {
    const auto low = static_cast<uint16_t>(h), high = static_cast<uint16_t>(h + 1);
    const float a = half_value(low), b = half_value(high), middle = 0.5f * (a + b);
    ASSERT_EQ(half_bits(middle), h % 2 == 0 ? low : high) << a;
    ASSERT_EQ(half_bits(std::nextafter(middle, a)), low) << a;
    ASSERT_EQ(half_bits(std::nextafter(middle, b)), high) << a;
    ASSERT_EQ(half_bits(-middle), half_bits(middle) | 0x8000);
  }
  EXPECT_EQ(half_value(half_bits(1e30f)), 65504.f);
  EXPECT_EQ(half_value(half_bits(-1e30f)), -65504.f);
}

TEST(HalfImage, KeepsValuesWhateverTheirScale) {
  for (const float scale : {1e-12f, 1.f, 1e12f}) {
    Image image(3, 2, 3);
    for (size_t i = 0; i < image.data.size(); ++i) {
      image.data[i] = scale * (0.01f + static_cast<float>(i));
    }
    const std::string bytes = half_image(image);
    ASSERT_EQ(bytes.size(), 16u + 6u * 6u);
    EXPECT_EQ(bytes.substr(0, 4), "PSH1");
    int32_t head[3];
    std::memcpy(head, bytes.data() + 4, sizeof head);
    EXPECT_EQ(head[0], 3);
    EXPECT_EQ(head[1], 2);
    for (size_t i = 0; i < image.data.size(); ++i) {
      uint16_t h = 0;
      std::memcpy(&h, bytes.data() + 16 + 2 * i, sizeof h);
      const float value = std::ldexp(half_value(h), -head[2]);
      EXPECT_NEAR(value, image.data[i], image.data[i] / 2048.f);  // half of the last of 11 bits
    }
  }
}

TEST(HalfImage, GreyAndBlackAndBroken) {
  Image grey(1, 1, 1);
  grey.data = {0.f};
  EXPECT_EQ(half_image(grey).substr(16), std::string(6, '\0'));
  Image broken(1, 1, 3);
  broken.data = {std::nanf(""), std::numeric_limits<float>::infinity(), 1.f};
  uint16_t h[3];
  std::memcpy(h, half_image(broken).data() + 16, sizeof h);
  EXPECT_TRUE(std::isnan(half_value(h[0])));
  EXPECT_EQ(half_value(h[1]), 65504.f);
  EXPECT_EQ(half_value(h[2]), 1.f);
}

}  // namespace
}  // namespace pssmlt
