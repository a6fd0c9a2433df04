#include "core/render/likely_values.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/math.h"

namespace pssmlt {
namespace {

constexpr int near = 3, far = 15;  // reach of the windows to each side [pixels]
// What the pixels of the small window must know in sum to weigh as much as the large window. One
// whose halves agree knows 9, one that holds something in one half only knows nothing.
constexpr double far_weight = 30.0;
// Relative variance at which a pixel is trusted half.
constexpr float half_trusted = 0.1f;
// Added to relative variances in the window's mean, so that no pixel drowns the others.
constexpr float least_variance = 0.1f;

using Sums = std::array<double, 4>;  // weighted channels, weights

// Variance of the mean of two halves over its square, of all channels together; 1 for black,
// and at most, which negative lobes of filters may exceed.
float relative_variance(const float* half0, const float* half1) {
  float square = 0.f, difference = 0.f;
  for (int c = 0; c < 3; ++c) {
    square += sqr(half0[c] + half1[c]);
    difference += sqr(half0[c] - half1[c]);
  }
  return difference < square ? difference / square : 1.f;
}

// See the header. `trust`: in the pixel's own value, [0, 1].
float likely_value(float own, float smaller_half, float around, float trust) {
  const float other = own > around ? std::max(smaller_half, around) : 0.5f * (own + around);
  return trust * own + (1.f - trust) * other;
}

// Sums over windows of 2 reach + 1 in a line of `count` elements that lie `stride` apart.
void sum_line(const Sums* in, Sums* out, int count, size_t stride, int reach) {
  std::vector<Sums> before(static_cast<size_t>(count) + 1);
  for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
    for (size_t c = 0; c < 4; ++c) before[i + 1][c] = before[i][c] + in[i * stride][c];
  }
  for (int i = 0; i < count; ++i) {
    const Sums& low = before[static_cast<size_t>(std::max(i - reach, 0))];
    const Sums& high = before[static_cast<size_t>(std::min(i + reach + 1, count))];
    for (size_t c = 0; c < 4; ++c) out[static_cast<size_t>(i) * stride][c] = high[c] - low[c];
  }
}

std::vector<Sums> window_sums(const std::vector<Sums>& own, int width, int height, int reach) {
  std::vector<Sums> rows(own.size()), both(own.size());
  const auto w = static_cast<size_t>(width);
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    sum_line(&own[y * w], &rows[y * w], width, 1, reach);
  }
  for (size_t x = 0; x < w; ++x) sum_line(&rows[x], &both[x], height, w, reach);
  return both;
}

// Weighted values of the pixels, and their weights.
std::vector<Sums> weigh(const Image& picture, const std::vector<float>& relative) {
  std::vector<Sums> own(relative.size());
  for (size_t p = 0; p < own.size(); ++p) {
    own[p][3] = 1.0 / static_cast<double>(relative[p] + least_variance);
    for (size_t c = 0; c < 3; ++c) {
      own[p][c] = own[p][3] * static_cast<double>(picture.data[3 * p + c]);
    }
  }
  return own;
}

// Mean of channel c around a pixel that is left out itself; nothing where there are no others.
// `others`: pixels of the small window without this one.
std::optional<double> mean_around(const Sums& own, const Sums& small, const Sums& large, int others,
                                  size_t c) {
  const double weight = small[3] - own[3];
  if (others == 0 || !(weight > 0.0)) return std::nullopt;
  const double known = weight - others / (1.0 + static_cast<double>(least_variance));
  const double share = known / (known + far_weight);
  return share * (small[c] - own[c]) / weight +
         (1.0 - share) * (large[c] - own[c]) / (large[3] - own[3]);
}

// Pixels of the small window around `at` in a line of `count`.
int window_length(int at, int count) {
  return std::min(at + near, count - 1) - std::max(at - near, 0) + 1;
}

}  // namespace

Image likely_values(const Image& picture, const Image& half0, const Image& half1) {
  std::vector<float> relative(picture.data.size() / 3);
  for (size_t p = 0; p < relative.size(); ++p) {
    relative[p] = relative_variance(&half0.data[3 * p], &half1.data[3 * p]);
  }
  const std::vector<Sums> own = weigh(picture, relative);
  const std::vector<Sums> small = window_sums(own, picture.width, picture.height, near);
  const std::vector<Sums> large = window_sums(own, picture.width, picture.height, far);
  Image result = picture;
  for (size_t p = 0; p < relative.size(); ++p) {
    // None for a spike in one half, whose relative variance is 1.
    const float trust = sqr(1.f - relative[p]) / (1.f + sqr(relative[p] / half_trusted));
    const int x = static_cast<int>(p) % picture.width, y = static_cast<int>(p) / picture.width;
    const int others = window_length(x, picture.width) * window_length(y, picture.height) - 1;
    for (size_t c = 0; c < 3; ++c) {
      const auto around = mean_around(own[p], small[p], large[p], others, c);
      if (!around) continue;
      const size_t at = 3 * p + c;
      const float smaller = std::min(half0.data[at], half1.data[at]);
      result.data[at] = likely_value(picture.data[at], smaller, static_cast<float>(*around), trust);
    }
  }
  return result;
}

}  // namespace pssmlt
