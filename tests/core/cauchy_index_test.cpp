#include "core/cauchy_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pssmlt {
namespace {

float at(const CauchyIndex& index, double line) { return index.at(static_cast<float>(line)); }

// The definition of V, and the specification's form of the equation, in rounded numbers.
TEST(CauchyIndex, HasItsAbbeNumberAndItsIndexAtTheDLine) {
  for (const float n : {1.33f, 1.5f, 2.4f}) {
    for (const float dispersion : {.3f, 1.f, 2.f}) {
      const CauchyIndex glass(n, dispersion);
      EXPECT_TRUE(glass.varies());
      EXPECT_NEAR(at(glass, helium_d), n, 1e-6f);
      const float abbe = (n - 1.f) / (at(glass, hydrogen_f) - at(glass, hydrogen_c));
      EXPECT_NEAR(20.f / abbe, dispersion, 1e-4f);
      for (const float l : {380.f, 450.f, 550.f, 700.f})
        EXPECT_NEAR(glass.at(l), n + (n - 1.f) * dispersion / 20.f * (523655.f / (l * l) - 1.5168f),
                    1e-4f);
    }
  }
}

TEST(CauchyIndex, ConstantWithoutDispersionOrContrast) {
  for (const CauchyIndex& index : {CauchyIndex(1.7f, 0.f), CauchyIndex(1.f, 3.f), CauchyIndex()}) {
    EXPECT_FALSE(index.varies());
    EXPECT_EQ(index.at(400.f), index.at(700.f));
  }
}

// However large the parameters are, the index is one that refracts and that shading can square.
TEST(CauchyIndex, StaysWithinItsLimits) {
  constexpr float most = std::numeric_limits<float>::max();
  EXPECT_EQ(CauchyIndex(1.5f, 100.f).at(800.f), 1.001f);
  for (const float dispersion : {100.f, most}) {
    for (const float n : {1.0001f, 1.5f, 20.f}) {
      const CauchyIndex wild(n, dispersion);
      for (float l = 360.f; l <= 830.f; l += 1.f) {
        ASSERT_GE(wild.at(l), std::min(n, 1.001f));
        ASSERT_LE(wild.at(l), std::max(n, 10.f));
      }
    }
  }
}

}  // namespace
}  // namespace pssmlt
