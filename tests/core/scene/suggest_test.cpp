#include "core/scene/suggest.h"

#include <gtest/gtest.h>

#include <vector>

namespace pssmlt {
namespace {

const std::vector<std::string> known = {"reflectance", "roughness", "uroughness", "eta", "k"};

TEST(Suggest, NearestName) {
  EXPECT_EQ(suggestion("reflectnace", known), " (did you mean 'reflectance'?)");
  EXPECT_EQ(suggestion("Roughness", known), " (did you mean 'roughness'?)");
  EXPECT_EQ(suggestion("rougness", known), " (did you mean 'roughness'?)");
  EXPECT_EQ(suggestion("et", known), " (did you mean 'eta'?)");
}

TEST(Suggest, NothingNear) {
  EXPECT_EQ(suggestion("filename", known), "");
  EXPECT_EQ(suggestion("", known), "");
  EXPECT_EQ(suggestion(std::string(100000, 'r'), known), "");
  EXPECT_EQ(suggestion("x", {}), "");
}

}  // namespace
}  // namespace pssmlt
