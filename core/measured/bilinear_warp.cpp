#include "core/measured/bilinear_warp.h"

#include <algorithm>

namespace pssmlt {
namespace {

struct Between {
  uint32_t low;
  float share;  // of the node after it
};

Between between(const std::vector<float>& nodes, float x) {
  if (nodes.size() < 2 || !(x > nodes.front())) return {0, 0.f};
  const auto after = std::upper_bound(nodes.begin(), nodes.end(), x);
  if (after == nodes.end()) return {static_cast<uint32_t>(nodes.size() - 2), 1.f};
  const auto low = static_cast<size_t>(after - nodes.begin()) - 1;
  return {static_cast<uint32_t>(low), (x - nodes[low]) / (nodes[low + 1] - nodes[low])};
}

// The t in [0, 1] up to which a line from a to b has the integral `part`.
float invert_line(float a, float b, float part) {
  const float root = safe_sqrt(a * a + 2.f * part * (b - a));
  const float sum = a + root;
  return sum > 0.f ? std::clamp(2.f * part / sum, 0.f, 1.f) : 0.f;
}
float integral_of_line(float a, float b, float t) { return t * (a + 0.5f * t * (b - a)); }

// The last of the cells 0 ... n - 2 whose lower end, by `value`, is at or below x.
template <typename Value>
int find_cell(int n, float x, Value&& value) {
  int low = 0, high = n - 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (value(middle) <= x ? low : high) = middle;
  }
  return low;
}

}  // namespace

GridBlend GridAxes::at(float a, float b) const {
  const Between i = between(first_, a), j = between(second_, b);
  const auto columns = static_cast<uint32_t>(second_.size());
  const uint32_t next_row = first_.size() > 1 ? columns : 0, next = columns > 1 ? 1 : 0;
  const uint32_t at = i.low * columns + j.low;
  return {{at, at + next, at + next_row, at + next_row + next},
          {(1.f - i.share) * (1.f - j.share), (1.f - i.share) * j.share, i.share * (1.f - j.share),
           i.share * j.share}};
}

GridCell grid_cell(const vec2& point, int width, int height) {
  const float x = std::clamp(point.x, 0.f, 1.f) * static_cast<float>(width - 1);
  const float y = std::clamp(point.y, 0.f, 1.f) * static_cast<float>(height - 1);
  GridCell c;
  c.x = std::min(static_cast<int>(x), width - 2);
  c.y = std::min(static_cast<int>(y), height - 2);
  c.fx = x - static_cast<float>(c.x);
  c.fy = y - static_cast<float>(c.y);
  return c;
}

BilinearWarp::BilinearWarp(std::vector<float> values, int width, int height)
    : width_(width), height_(height), values_(std::move(values)) {
  const size_t grids = values_.size() / (static_cast<size_t>(width) * static_cast<size_t>(height));
  along_.resize(values_.size());
  below_.resize(grids * static_cast<size_t>(height));
  for (size_t g = 0; g < grids; ++g) {
    normalise(g);
    accumulate(g);
  }
}

void BilinearWarp::normalise(size_t grid) {
  const auto w = static_cast<size_t>(width_), h = static_cast<size_t>(height_);
  float* const v = values_.data() + grid * w * h;
  // A node's share in the integral: a cell, half of one at an edge.
  double sum = 0.0;
  for (size_t y = 0; y < h; ++y)
    for (size_t x = 0; x < w; ++x)
      sum += static_cast<double>(v[y * w + x]) * (x == 0 || x + 1 == w ? 0.5 : 1.0) *
             (y == 0 || y + 1 == h ? 0.5 : 1.0);
  const double mean = sum / static_cast<double>((w - 1) * (h - 1));
  for (size_t i = 0; i < w * h; ++i)
    v[i] = mean > 0.0 ? static_cast<float>(static_cast<double>(v[i]) / mean) : 1.f;
}

void BilinearWarp::accumulate(size_t grid) {
  const auto w = static_cast<size_t>(width_), h = static_cast<size_t>(height_);
  double sum = 0.0;
  double row_before = 0.0;
  for (size_t y = 0; y < h; ++y) {
    const size_t start = (grid * h + y) * w;
    double total = 0.0;
    for (size_t x = 1; x < w; ++x) {
      total +=
          0.5 *
          (static_cast<double>(values_[start + x - 1]) + static_cast<double>(values_[start + x])) /
          static_cast<double>(w - 1);
      along_[start + x] = static_cast<float>(total);
    }
    if (y > 0) sum += 0.5 * (row_before + total) / static_cast<double>(h - 1);
    below_[grid * h + y] = static_cast<float>(sum);
    row_before = total;
  }
}

float BilinearWarp::blended(const GridBlend& b, const std::vector<float>& table, size_t stride,
                            int x, int y) const {
  float sum = 0.f;
  for (size_t k = 0; k < 4; ++k) {
    if (b.weight[k] == 0.f) continue;
    const size_t row_number =
        static_cast<size_t>(b.grid[k]) * static_cast<size_t>(height_) + static_cast<size_t>(y);
    sum += b.weight[k] * table[row_number * stride + static_cast<size_t>(x)];
  }
  return sum;
}

float BilinearWarp::density(const GridBlend& b, const vec2& point) const {
  const GridCell c = grid_cell(point, width_, height_);
  const float low = (1.f - c.fx) * node(b, c.x, c.y) + c.fx * node(b, c.x + 1, c.y);
  const float high = (1.f - c.fx) * node(b, c.x, c.y + 1) + c.fx * node(b, c.x + 1, c.y + 1);
  return (1.f - c.fy) * low + c.fy * high;
}

BilinearWarp::Mapped BilinearWarp::sample(const GridBlend& b, const vec2& u) const {
  const auto rows = static_cast<float>(height_ - 1), columns = static_cast<float>(width_ - 1);
  const int y = find_cell(height_, u.y, [&](int i) { return below(b, i); });
  const float fy = invert_line(row(b, y), row(b, y + 1), (u.y - below(b, y)) * rows);
  const auto mixed = [&](float low, float high) { return (1.f - fy) * low + fy * high; };
  const auto up_to = [&](int i) { return mixed(along(b, i, y), along(b, i, y + 1)); };
  const float target = u.x * up_to(width_ - 1);
  const int x = find_cell(width_, target, up_to);
  const float left = mixed(node(b, x, y), node(b, x, y + 1));
  const float right = mixed(node(b, x + 1, y), node(b, x + 1, y + 1));
  const float fx = invert_line(left, right, (target - up_to(x)) * columns);
  return {{(static_cast<float>(x) + fx) / columns, (static_cast<float>(y) + fy) / rows},
          (1.f - fx) * left + fx * right};
}

BilinearWarp::Mapped BilinearWarp::invert(const GridBlend& b, const vec2& point) const {
  const auto rows = static_cast<float>(height_ - 1), columns = static_cast<float>(width_ - 1);
  const GridCell c = grid_cell(point, width_, height_);
  const auto mixed = [&](float low, float high) { return (1.f - c.fy) * low + c.fy * high; };
  const float left = mixed(node(b, c.x, c.y), node(b, c.x, c.y + 1));
  const float right = mixed(node(b, c.x + 1, c.y), node(b, c.x + 1, c.y + 1));
  const float whole = mixed(row(b, c.y), row(b, c.y + 1));
  const float part = mixed(along(b, c.x, c.y), along(b, c.x, c.y + 1)) +
                     integral_of_line(left, right, c.fx) / columns;
  const float v = below(b, c.y) + integral_of_line(row(b, c.y), row(b, c.y + 1), c.fy) / rows;
  const vec2 u(whole > 0.f ? part / whole : 0.f, v);
  return {glm::clamp(u, 0.f, 1.f), (1.f - c.fx) * left + c.fx * right};
}

}  // namespace pssmlt
