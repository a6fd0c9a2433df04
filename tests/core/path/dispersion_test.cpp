#include "core/path/dispersion.h"

#include <gtest/gtest.h>

namespace pssmlt {
namespace {

TEST(Dispersion, TheMeanOfAllWavelengthsIsWhite) {
  constexpr int steps = 1 << 20;
  dvec3 sum(0.0);
  float last = 0.f;
  for (int i = 0; i < steps; ++i) {
    const Wavelength w = draw_wavelength((static_cast<float>(i) + 0.5f) / steps);
    ASSERT_GE(w.nanometres, last);  // ascending with u: steps of u are steps in colour
    last = w.nanometres;
    for (int c = 0; c < 3; ++c) ASSERT_GE(w.colour[c], 0.f);
    // Drawn by the mean of the components: all wavelengths are as bright in that sense.
    ASSERT_NEAR(w.colour.x + w.colour.y + w.colour.z, 3.f, 1e-4f);
    sum += dvec3(w.colour);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / steps, 1.0, 1e-5);
}

TEST(Dispersion, ColoursAreThoseOfTheRainbow) {
  const auto colour_at = [](float nanometres) {
    float low = 0.f, high = 1.f;
    for (int i = 0; i < 30; ++i) {
      const float middle = 0.5f * (low + high);
      (draw_wavelength(middle).nanometres < nanometres ? low : high) = middle;
    }
    return draw_wavelength(low).colour;
  };
  const Rgb blue = colour_at(460.f), green = colour_at(535.f), red = colour_at(630.f);
  EXPECT_GT(blue.z, 2.f * blue.x);
  EXPECT_GT(green.y, 2.f * std::max(green.x, green.z));
  EXPECT_GT(red.x, 2.f * std::max(red.y, red.z));
}

}  // namespace
}  // namespace pssmlt
