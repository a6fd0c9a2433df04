#include "app/merge/merge_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace pssmlt {
namespace {

Image layered(std::vector<std::string> names, const std::vector<float>& values) {
  Image image(2, 1, static_cast<int>(names.size()));
  image.channel_names = std::move(names);
  for (size_t c = 0; c < values.size(); ++c) {
    image.data[c] = values[c];
    image.data[values.size() + c] = 2.f * values[c];
  }
  return image;
}

const std::vector<double> weights = {0.25, 0.75};

TEST(MergeImages, AverageByName) {
  const std::vector<Image> images = {layered({"R", "G", "B", "half0.R"}, {4.f, 8.f, 0.f, 1.f}),
                                     layered({"half0.R", "B", "G", "R"}, {3.f, 4.f, 0.f, 8.f})};
  const MergedImage m = merge_images(images, weights, true);
  ASSERT_EQ(m.image.channel_names, images[0].channel_names);
  EXPECT_EQ(m.image.data, (std::vector<float>{7.f, 2.f, 3.f, 2.5f, 14.f, 4.f, 6.f, 5.f}));
  EXPECT_TRUE(m.left_out.empty());
}

// Variances of independent renders add with squared weights, deviations by their squares.
TEST(MergeImages, VarianceAndError) {
  const std::vector<Image> images = {layered({"Y", "variance.R", "error.Y"}, {1.f, 16.f, 4.f}),
                                     layered({"Y", "variance.R", "error.Y"}, {1.f, 32.f, 8.f})};
  const MergedImage m = merge_images(images, weights, true);
  EXPECT_FLOAT_EQ(m.image.data[0], 1.f);
  EXPECT_FLOAT_EQ(m.image.data[1], 16.f / 16.f + 32.f * 9.f / 16.f);
  EXPECT_FLOAT_EQ(m.image.data[2], std::sqrt(16.f / 16.f + 64.f * 9.f / 16.f));
  const MergedImage dependent = merge_images(images, weights, false);
  EXPECT_EQ(dependent.image.channel_names, std::vector<std::string>{"Y"});
  EXPECT_EQ(dependent.left_out, (std::vector<std::string>{"variance", "error"}));
}

TEST(MergeImages, LayersThatNotAllHaveAreLeftOut) {
  const std::vector<Image> images = {layered({"R", "G", "B", "normal.X"}, {1.f, 1.f, 1.f, 1.f}),
                                     layered({"R", "G", "B", "depth.Y"}, {1.f, 1.f, 1.f, 1.f})};
  const MergedImage m = merge_images(images, weights, true);
  EXPECT_EQ(m.image.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(m.left_out, (std::vector<std::string>{"normal", "depth"}));
}

TEST(MergeImages, RefusesWhatDoesNotFit) {
  EXPECT_THROW(merge_images(std::vector<Image>{Image(2, 1, 3), Image(1, 2, 3)}, weights, true),
               Error);
  const std::vector<Image> strangers = {layered({"Y"}, {1.f}), layered({"Z"}, {1.f})};
  EXPECT_THROW(merge_images(strangers, weights, true), Error);
}

// The average of equal images is the image, whatever the weights.
TEST(MergeImages, EqualImagesStay) {
  const Image image = layered({"R", "G", "B"}, {0.1f, 1e-30f, 3e38f});
  const std::vector<Image> images(3, image);
  const MergedImage m = merge_images(images, std::vector<double>{0.2, 0.5, 0.3}, true);
  for (size_t i = 0; i < image.data.size(); ++i) {
    EXPECT_FLOAT_EQ(m.image.data[i], image.data[i]);
  }
}

}  // namespace
}  // namespace pssmlt
