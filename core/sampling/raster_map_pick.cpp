// Which pixel a light splat is credited to.
#include <algorithm>
#include <array>

#include "core/sampling/raster_map.h"

namespace pssmlt {

// Pixels of one axis, absolute, whose support holds a position, cut to the window [low, high), and
// the cell of the table that it lies in for each.
struct RasterMap::Candidates {
  // cells_a_pixel: cells / (2 radius).
  Candidates(double position, double radius, double cells_a_pixel, int low, int high) {
    // Pixels above it have the position in their support.
    const double from = position - radius - 0.5;
    first = std::max(static_cast<int>(from) + (from > 0.0 ? 1 : 0), low);
    // The cell falls by the same step from pixel to pixel.
    double at = (position - (first + 0.5) + radius) * cells_a_pixel;
    for (int p = first; p < high && at >= 0.0; ++p, at -= cells_a_pixel) {
      if (at < cells) {
        cell[static_cast<size_t>(count++)] = static_cast<uint8_t>(at);
      } else {
        first = p + 1;
      }
    }
  }
  int first = 0, count = 0;
  std::array<uint8_t, 2 * static_cast<size_t>(max_radius) + 1> cell;
};

namespace {

constexpr size_t max_candidates = 2 * static_cast<size_t>(RasterMap::max_radius) + 1;

// A candidate of one axis, chosen with probability |value| / sum.
struct Choice {
  int index = -1;  // none: all values are zero
  float value = 0.f, sum = 0.f;
};
// u is used up to what tells the chosen one and is uniform again afterwards.
template <typename Cells>
Choice choose(const std::vector<float>& values, const Cells& cell, int count, float& u) {
  Choice choice;
  for (int i = 0; i < count; ++i) {
    choice.sum += std::abs(values[cell[static_cast<size_t>(i)]]);
  }
  float left = u * choice.sum;
  for (int i = 0; i < count; ++i) {
    const float value = values[cell[static_cast<size_t>(i)]];
    const float size = std::abs(value);
    if (size == 0.f) continue;
    choice.index = i;
    choice.value = value;
    if (left < size) {
      u = std::min(left / size, one_minus_epsilon);
      return choice;
    }
    left -= size;
  }
  u = one_minus_epsilon;  // rounding has left something over
  return choice;
}

}  // namespace

PixelCredit RasterMap::pick(const dvec2& raster, float u) const {
  const ivec2 low = frame_.crop_min, high = frame_.crop_max;
  const int width = high.x - low.x;
  const dvec2 outside = glm::max(dvec2(low) - raster, raster - dvec2(high));
  if (!(outside.x <= radius_.x && outside.y <= radius_.y)) return {};
  if (pixel_box_) {
    const int x = static_cast<int>(std::floor(raster.x)),
              y = static_cast<int>(std::floor(raster.y));
    if (x < low.x || y < low.y || x >= high.x || y >= high.y) return {};
    return {(y - low.y) * width + x - low.x, 1.f};
  }
  const Candidates xs(raster.x, radius_.x, cells_a_pixel_.x, low.x, high.x);
  const Candidates ys(raster.y, radius_.y, cells_a_pixel_.y, low.y, high.y);
  return column_.empty() ? pick_pair(xs, ys, u) : pick_separately(xs, ys, u);
}

PixelCredit RasterMap::pick_pair(const Candidates& xs, const Candidates& ys, float u) const {
  const ivec2 low = frame_.crop_min;
  const int width = frame_.crop_max.x - low.x;
  const auto value = [&](int i, int j) {
    return values_[static_cast<size_t>(ys.cell[static_cast<size_t>(j)]) * cells +
                   xs.cell[static_cast<size_t>(i)]];
  };
  std::array<float, max_candidates> row_sums;
  float sum = 0.f;
  int last = 0;  // row with a value
  for (int j = 0; j < ys.count; ++j) {
    float row_sum = 0.f;
    for (int i = 0; i < xs.count; ++i) row_sum += std::abs(value(i, j));
    row_sums[static_cast<size_t>(j)] = row_sum;
    sum += row_sum;
    if (row_sum > 0.f) last = j;
  }
  if (!(sum > 0.f)) return {};
  // By inversion, first among the rows; where rounding leaves something over, the last one with a
  // value stays chosen.
  float left = u * sum;
  PixelCredit chosen;
  for (int j = 0; j < ys.count; ++j) {
    const float row_sum = row_sums[static_cast<size_t>(j)];
    if (row_sum == 0.f) continue;
    if (left >= row_sum && j < last) {
      left -= row_sum;
      continue;
    }
    for (int i = 0; i < xs.count; ++i) {
      const float f = value(i, j);
      if (f == 0.f) continue;
      chosen = {(ys.first + j - low.y) * width + xs.first + i - low.x,
                static_cast<float>((f < 0.f ? -sum : sum) / integral_)};
      left -= std::abs(f);
      if (left < 0.f) return chosen;
    }
  }
  return chosen;
}

// The same for a filter that is a product: a column, then a row.
PixelCredit RasterMap::pick_separately(const Candidates& xs, const Candidates& ys, float u) const {
  const Choice x = choose(column_, xs.cell, xs.count, u);
  const Choice y = choose(row_, ys.cell, ys.count, u);
  if (x.index < 0 || y.index < 0) return {};
  const float sum = x.sum * y.sum;
  const ivec2 low = frame_.crop_min;
  const int width = frame_.crop_max.x - low.x;
  return {(ys.first + y.index - low.y) * width + xs.first + x.index - low.x,
          static_cast<float>((x.value * y.value < 0.f ? -sum : sum) / integral_)};
}

}  // namespace pssmlt
