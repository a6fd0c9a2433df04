#include "core/render/likely_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/math.h"

namespace pssmlt {
namespace {

struct Halves {
  Image mean, half[2];
};

// Grey pictures whose pixels are given by the two halves' values.
template <typename Value>
Halves make(int width, int height, const Value& value) {
  Halves h{Image(width, height, 3), {Image(width, height, 3), Image(width, height, 3)}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [a, b] = value(x, y);
      for (int c = 0; c < 3; ++c) {
        h.half[0].pixel(x, y)[c] = a;
        h.half[1].pixel(x, y)[c] = b;
        h.mean.pixel(x, y)[c] = 0.5f * (a + b);
      }
    }
  }
  return h;
}

Image likely(const Halves& h) { return likely_values(h.mean, h.half[0], h.half[1]); }

using Pair = std::pair<float, float>;

TEST(LikelyValues, ConvergedPicturesStayAsTheyAre) {
  const Halves h = make(20, 9, [](int x, int y) {
    const float v = x < 10 ? 0.01f : 5.f + static_cast<float>(y);
    return Pair{v, v};
  });
  EXPECT_EQ(likely(h).data, h.mean.data);
}

TEST(LikelyValues, FirefliesGiveWayToTheirNeighbours) {
  const Halves h = make(21, 21, [](int x, int y) {
    return x == 10 && y == 10 ? Pair{200.f, 0.1f} : Pair{0.1f, 0.1f};
  });
  const Image l = likely(h);
  // One spike says little of the whole picture, which therefore is the window.
  EXPECT_NEAR(l.pixel(10, 10)[0], (100.05f + 440.f * 0.1f) / 441.f, 1e-4f);
  EXPECT_EQ(l.pixel(11, 10)[0], 0.1f);
}

TEST(LikelyValues, APixelThatIsBrightInBothHalvesStaysBright) {
  const Halves h = make(21, 21, [](int x, int y) {
    return x == 10 && y == 10 ? Pair{9.f, 3.f} : Pair{0.1f, 0.1f};
  });
  EXPECT_GT(likely(h).pixel(10, 10)[0], 2.9f);
}

TEST(LikelyValues, ASinglePixelKeepsItsValue) {
  const Halves h = make(1, 1, [](int, int) { return Pair{4.f, 0.f}; });
  EXPECT_EQ(likely(h).data, h.mean.data);
}

// What it is for: a dark picture of value 1 that is lit by rare spikes, each half's pixel holding
// one of height 250 with probability 1/250. The relative mean square error is E (v - 1)^2 = 249.5
// over 1.01; dividing by the pixels' own squares would give less than 0.02.
TEST(LikelyValues, KeepTheErrorOfRareSpikesHonest) {
  std::mt19937 random(5);
  std::bernoulli_distribution spike(1.0 / 500.0);
  const Halves h = make(300, 300, [&](int, int) {
    const float a = spike(random) ? 500.f : 0.f;
    const float b = spike(random) ? 500.f : 0.f;
    return Pair{a, b};
  });
  const Image l = likely(h);
  double estimate = 0.0, by_itself = 0.0;
  const size_t count = l.data.size();
  for (size_t i = 0; i < count; ++i) {
    const double variance = 0.25 * sqr(static_cast<double>(h.half[0].data[i] - h.half[1].data[i]));
    estimate +=
        variance / (sqr(static_cast<double>(l.data[i])) + 0.01) / static_cast<double>(count);
    by_itself +=
        variance / (sqr(static_cast<double>(h.mean.data[i])) + 0.01) / static_cast<double>(count);
  }
  // The largest window holds 12 spikes on average: the denominator is about right, but noisy.
  EXPECT_LT(by_itself, 0.02);
  EXPECT_GT(estimate, 249.5 / 1.5);
  EXPECT_LT(estimate, 249.5 * 1.5);
}

}  // namespace
}  // namespace pssmlt
