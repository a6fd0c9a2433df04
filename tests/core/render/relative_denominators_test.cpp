#include "core/render/relative_denominators.h"

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

constexpr double epsilon = 0.01;

// The value whose square the first channel of a pixel is divided by.
double likely(const Halves& h, int x, int y) {
  const auto d = relative_denominators(h.mean, h.half[0], h.half[1], epsilon);
  const auto at = 3 * static_cast<size_t>(y * h.mean.width + x);
  EXPECT_EQ(d[at], d[at + 1]);
  return std::sqrt(d[at] - epsilon);
}

using Pair = std::pair<float, float>;

TEST(RelativeDenominators, ConvergedPixelsAreDividedByTheirOwnSquares) {
  const Halves h = make(20, 9, [](int x, int y) {
    const float v = x < 10 ? 0.01f : 5.f + static_cast<float>(y);
    return Pair{v, v};
  });
  const auto d = relative_denominators(h.mean, h.half[0], h.half[1], epsilon);
  for (size_t i = 0; i < d.size(); ++i) {
    EXPECT_DOUBLE_EQ(d[i], sqr(static_cast<double>(h.mean.data[i])) + epsilon);
  }
}

// One spike says little of the picture, all of which therefore is its window: 99.95 / 441 of light
// beside the 0.1 that is there without.
TEST(RelativeDenominators, SpikesMightHaveBeenAnywhereNearby) {
  const Halves h = make(21, 21, [](int x, int y) {
    return x == 10 && y == 10 ? Pair{200.f, 0.1f} : Pair{0.1f, 0.1f};
  });
  EXPECT_NEAR(likely(h, 10, 10), 0.1 + 99.95 / 441, 0.001);
  EXPECT_NEAR(likely(h, 11, 10), 0.1, 1e-6);
}

TEST(RelativeDenominators, APixelThatIsBrightInBothHalvesIsBright) {
  const Halves h = make(21, 21, [](int x, int y) {
    return x == 10 && y == 10 ? Pair{9.f, 3.f} : Pair{0.1f, 0.1f};
  });
  EXPECT_GE(likely(h, 10, 10), 3.0);
}

// A column of pixels that the lamp fills by half, and that one half of the samples missed.
TEST(RelativeDenominators, TheEdgeOfALampIsNoSpike) {
  const Halves h = make(21, 21, [](int x, int) {
    return x < 10 ? Pair{800.f, 800.f} : x == 10 ? Pair{700.f, 0.f} : Pair{0.1f, 0.1f};
  });
  EXPECT_GE(likely(h, 10, 10), 800.0 / 3.0);
}

TEST(RelativeDenominators, APixelWithoutOthersIsDividedByItself) {
  const Halves h = make(1, 1, [](int, int) { return Pair{4.f, 0.f}; });
  EXPECT_NEAR(likely(h, 0, 0), 2.0, 1e-9);
}

TEST(RelativeDenominators, BlackWithoutEpsilonIsNotKnown) {
  const Halves h = make(5, 5, [](int, int) { return Pair{0.f, 0.f}; });
  for (const double d : relative_denominators(h.mean, h.half[0], h.half[1], 0.0)) EXPECT_EQ(d, 0.0);
}

// Mean of variance / denominator, and what it would be with the pixels' own squares.
struct Estimates {
  double estimate = 0.0, by_itself = 0.0;
};
Estimates estimate(const Halves& h) {
  const auto d = relative_denominators(h.mean, h.half[0], h.half[1], epsilon);
  const double count = static_cast<double>(d.size());
  Estimates e;
  for (size_t i = 0; i < d.size(); ++i) {
    const double variance =
        0.25 * sqr(static_cast<double>(h.half[0].data[i]) - static_cast<double>(h.half[1].data[i]));
    e.estimate += variance / d[i] / count;
    e.by_itself += variance / (sqr(static_cast<double>(h.mean.data[i])) + epsilon) / count;
  }
  return e;
}

// What it is for: a picture of value 1 that is lit by rare spikes alone, each half's pixel holding
// one of height 500 with probability 1/500. The relative mean square error is 249.5 / 1.01.
TEST(RelativeDenominators, KeepTheErrorOfRareSpikesHonest) {
  std::mt19937 random(5);
  std::bernoulli_distribution spike(1.0 / 500.0);
  const Estimates e = estimate(make(300, 300, [&](int, int) {
    const float a = spike(random) ? 500.f : 0.f;
    const float b = spike(random) ? 500.f : 0.f;
    return Pair{a, b};
  }));
  EXPECT_LT(e.by_itself, 0.02);
  EXPECT_GT(e.estimate, 249.5 / 1.01 / 1.5);
  EXPECT_LT(e.estimate, 249.5 / 1.01 * 1.5);
}

// Spikes over a checkerboard of 0.1 and 1 whose pixels are known but for them: with probability
// 1/1000 one of 50 in a half, variance 1.25 over truths 0.15 and 1.05. Some 90 of them are in dark
// cells, which makes the estimate uncertain by 10 %.
TEST(RelativeDenominators, KeepTheErrorOfSpikesOverAPictureHonest) {
  std::mt19937 random(6);
  std::bernoulli_distribution spike(1.0 / 1000.0);
  const Estimates e = estimate(make(300, 300, [&](int x, int y) {
    const float value = (x / 25 + y / 25) % 2 == 0 ? 0.1f : 1.f;
    const float a = spike(random) ? 50.f : 0.f;
    const float b = spike(random) ? 50.f : 0.f;
    return Pair{value + a, value + b};
  }));
  const double truth = 0.5 * (1.25 / (0.15 * 0.15 + epsilon) + 1.25 / (1.05 * 1.05 + epsilon));
  EXPECT_GT(e.estimate, truth / 1.5);
  EXPECT_LT(e.estimate, truth * 1.5);
}

}  // namespace
}  // namespace pssmlt
