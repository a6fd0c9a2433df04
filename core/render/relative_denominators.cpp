#include "core/render/relative_denominators.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/rgb.h"
#include "core/render/window_sums.h"

namespace pssmlt {
namespace {

using Channels = std::array<double, 3>;

// Reaches of windows to each side [pixels].
constexpr std::array noise_reaches = {0, 1, 2, 3, 5, 8, 12, 18, 27};
constexpr std::array spike_reaches = {1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 40};
constexpr int nearby = 3;  // where a spike might as well have been
// Relative variances up to which something is known well enough.
constexpr double pixel_enough = 0.02;  // lower, since it is from two numbers
constexpr double window_enough = 0.1, spikes_enough = 0.05;
// Relative variance beyond which a pixel may be a spike.
constexpr double spiky = 0.3;
constexpr double confidence = 3.0;  // half width of the intervals [standard deviations]

double sum_of_squares(const Channels& a) { return sqr(a[0]) + sqr(a[1]) + sqr(a[2]); }
double sum(const Channels& a) { return a[0] + a[1] + a[2]; }

// A pixel and what its halves say about it.
struct Pixel {
  Channels value, variance, half_difference;  // of its halves' mean; half0 - half1, over 2
  Channels darker;                            // half, not below 0
  double relative;                            // variance, of all channels, in [0, 1]
};

// All pixels, computed when they are asked for: pictures are large.
class Pixels {
 public:
  Pixels(const Image& picture, const Image& half0, const Image& half1)
      : picture_(picture), half0_(half0), half1_(half1) {}
  int width() const { return picture_.width; }
  int height() const { return picture_.height; }
  Pixel at(int x, int y) const {
    const float *own = picture_.pixel(x, y), *a = half0_.pixel(x, y), *b = half1_.pixel(x, y);
    const bool a_darker = luminance({a[0], a[1], a[2]}) < luminance({b[0], b[1], b[2]});
    Pixel p;
    for (size_t c = 0; c < 3; ++c) {
      p.value[c] = static_cast<double>(own[c]);
      p.half_difference[c] = 0.5 * (static_cast<double>(a[c]) - static_cast<double>(b[c]));
      p.variance[c] = sqr(p.half_difference[c]);
      p.darker[c] = std::max(0.0, static_cast<double>(a_darker ? a[c] : b[c]));
    }
    const double variance = sum(p.variance), square = sum_of_squares(p.value);
    p.relative = variance < square ? variance / square : variance > 0.0 ? 1.0 : 0.0;
    return p;
  }

 private:
  const Image &picture_, &half0_, &half1_;
};

// Without its spike, if it may have one.
Channels base(const Pixel& p) {
  if (p.relative > spiky) return p.darker;
  return {std::max(p.value[0], 0.0), std::max(p.value[1], 0.0), std::max(p.value[2], 0.0)};
}

// The case of noise.
class Noise {
 public:
  explicit Noise(const Pixels& pixels)
      : sums_(pixels.width(), pixels.height(), [&](int x, int y) {
          const Pixel p = pixels.at(x, y);
          return Values{p.value[0],    p.value[1],    p.value[2],
                        p.variance[0], p.variance[1], p.variance[2]};
        }) {}

  Channels likely(int x, int y, Channels value) const {
    Channels low, high;
    low.fill(-INFINITY), high.fill(INFINITY);
    for (const int reach : noise_reaches) {
      double count;
      const Values m = sums_.mean(x, y, reach, count);
      double square = 0.0, variance = 0.0;
      for (size_t c = 0; c < 3; ++c) {
        const double of_mean = std::max(m[3 + c], 0.0) / count;  // rounding may give less than 0
        const double width = confidence * std::sqrt(of_mean);
        low[c] = std::max(low[c], m[c] - width);
        high[c] = std::min(high[c], m[c] + width);
        if (low[c] > high[c]) return value;
        square += sqr(m[c]);
        variance += of_mean;
      }
      if (reach > 0) value = {m[0], m[1], m[2]};
      if (variance <= (reach == 0 ? pixel_enough : window_enough) * square) break;
    }
    return value;
  }

 private:
  using Values = WindowSums<6>::Values;
  WindowSums<6> sums_;
};

// The case of spikes.
class Spikes {
 public:
  Spikes(const Pixels& pixels, double epsilon)
      : pixels_(pixels),
        epsilon_(epsilon),
        sums_(pixels.width(), pixels.height(), [&](int x, int y) {
          const Pixel p = pixels.at(x, y);
          Values v{};
          if (p.relative <= spiky) return v;
          for (size_t c = 0; c < 3; ++c) {
            v[c] = p.value[c] - p.darker[c];
            v[3 + c] = p.variance[c];
            v[6 + c] = p.half_difference[c];
          }
          return v;
        }) {}

  // Estimates of 1 / (t^2 + epsilon).
  Channels inverse(int x, int y) const {
    const Channels own = pixels_.at(x, y).value, share = light(x, y), proven = least(x, y);
    Channels sums{};
    double count = 0.0;
    for_window(x, y, nearby, [&](int qx, int qy) {
      if (qx == x && qy == y) return;
      const Channels b = base(pixels_.at(qx, qy));
      for (size_t c = 0; c < 3; ++c) sums[c] += 1.0 / (sqr(b[c] + share[c]) + epsilon_);
      count += 1.0;
    });
    for (size_t c = 0; c < 3; ++c) {
      const double least_square = count > 0.0 ? sqr(proven[c]) : sqr(own[c]);
      const double most = 1.0 / (least_square + epsilon_);
      sums[c] = count > 0.0 ? std::min(sums[c] / count, most) : most;
    }
    return sums;
  }

 private:
  using Values = WindowSums<9>::Values;

  template <typename Body>
  void for_window(int x, int y, int reach, const Body& body) const {
    const int y1 = std::min(y + reach, pixels_.height() - 1);
    const int x1 = std::min(x + reach, pixels_.width() - 1);
    for (int qy = std::max(y - reach, 0); qy <= y1; ++qy) {
      for (int qx = std::max(x - reach, 0); qx <= x1; ++qx) body(qx, qy);
    }
  }

  // Mean of the spikes around. Those of a chain that was stuck stand close together in one half:
  // pixels' variances do not know that, the difference of the window's halves does.
  Channels light(int x, int y) const {
    Channels mean{};
    for (const int reach : spike_reaches) {
      double count;
      const Values m = sums_.mean(x, y, reach, count);
      mean = {std::max(m[0], 0.0), std::max(m[1], 0.0), std::max(m[2], 0.0)};
      double variance = 0.0;
      for (size_t c = 0; c < 3; ++c) variance += std::max(m[3 + c] / count, sqr(m[6 + c]));
      if (variance <= spikes_enough * sum_of_squares(mean)) break;
    }
    return mean;
  }

  // What the pixel's truth hardly is below: its darker half, or the mean of those around it.
  Channels least(int x, int y) const {
    Channels mean{};
    double count = 0.0;
    for_window(x, y, 1, [&](int qx, int qy) {
      const Pixel q = pixels_.at(qx, qy);
      for (size_t c = 0; c < 3; ++c) mean[c] += q.darker[c];
      count += 1.0;
    });
    const Channels own = pixels_.at(x, y).darker;
    for (size_t c = 0; c < 3; ++c) mean[c] = std::max(mean[c] / count, own[c]);
    return mean;
  }

  const Pixels& pixels_;
  double epsilon_;
  WindowSums<9> sums_;
};

}  // namespace

std::vector<double> relative_denominators(const Image& picture, const Image& half0,
                                          const Image& half1, double epsilon) {
  const Pixels pixels(picture, half0, half1);
  const Noise noise(pixels);
  const Spikes spikes(pixels, epsilon);
  std::vector<double> result;
  result.reserve(picture.data.size());
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Pixel p = pixels.at(x, y);
      const Channels likely = noise.likely(x, y, p.value);
      const double share = std::max(0.0, (p.relative - spiky) / (1.0 - spiky));
      const Channels as_spike = share > 0.0 ? spikes.inverse(x, y) : Channels{};
      for (size_t c = 0; c < 3; ++c) {
        // What is bright in both halves is bright.
        const double square = sqr(std::max(likely[c], p.darker[c]));
        const double inverse = (1.0 - share) / (square + epsilon) + share * as_spike[c];
        result.push_back(std::isfinite(inverse) ? 1.0 / inverse : 0.0);
      }
    }
  }
  return result;
}

}  // namespace pssmlt
