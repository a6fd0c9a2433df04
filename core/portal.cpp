#include "core/portal.h"

#include <algorithm>

namespace pssmlt {
namespace {

// The sky on a square: coordinates are the angles of the direction's projections to the planes of
// z with x and with y. A straight edge along x or y has one coordinate, from wherever it is seen.
dvec2 layout(const dvec3& d) {
  return {std::atan2(d.x, d.z) * std::numbers::inv_pi + 0.5,
          std::atan2(d.y, d.z) * std::numbers::inv_pi + 0.5};
}

struct Direction {
  dvec3 d;             // unit, z > 0
  double solid_angle;  // [sr] per unit of the square
};
Direction direction_of(const dvec2& p) {
  // Not quite the horizon, where tangents overflow.
  const dvec2 inside = glm::clamp(p, 1e-9, 1.0 - 1e-9);
  const double x = std::tan(std::numbers::pi * (inside.x - 0.5));
  const double y = std::tan(std::numbers::pi * (inside.y - 0.5));
  const double l2 = 1.0 + x * x + y * y, l = std::sqrt(l2);
  return {dvec3(x, y, 1.0) / l, sqr(std::numbers::pi) * (1.0 + x * x) * (1.0 + y * y) / (l2 * l)};
}

// Where a function that grows on [low, high], straight between whole numbers, reaches `goal`.
template <typename F>
double invert(const F& sum, double low, double high, double goal) {
  // The border of a cell below which the goal lies.
  auto first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::ceil(high));
  while (last - first > 1) {
    const int middle = (first + last) / 2;
    (sum(std::clamp(static_cast<double>(middle), low, high)) <= goal ? first : last) = middle;
  }
  const double a = std::max(low, static_cast<double>(first));
  const double b = std::min(high, static_cast<double>(last));
  const double at_a = sum(a), at_b = sum(b);
  return at_b > at_a ? std::clamp(a + (b - a) * (goal - at_a) / (at_b - at_a), a, b) : a;
}

}  // namespace

WindowDistribution::WindowDistribution(const std::vector<float>& values, int size)
    : size_(size), sums_(static_cast<size_t>((size + 1) * (size + 1))) {
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      sums_[static_cast<size_t>((y + 1) * (size + 1) + x + 1)] =
          static_cast<double>(values[static_cast<size_t>(y * size + x)]) + corner(x, y + 1) +
          corner(x + 1, y) - corner(x, y);
}

double WindowDistribution::sum_to(const dvec2& p) const {
  const int x = std::min(static_cast<int>(p.x), size_ - 1);
  const int y = std::min(static_cast<int>(p.y), size_ - 1);
  const double fx = p.x - x, fy = p.y - y;
  return (1.0 - fy) * ((1.0 - fx) * corner(x, y) + fx * corner(x + 1, y)) +
         fy * ((1.0 - fx) * corner(x, y + 1) + fx * corner(x + 1, y + 1));
}

double WindowDistribution::integral(const Window& w) const {
  const dvec2 a = w.low * static_cast<double>(size_), b = w.high * static_cast<double>(size_);
  const double sum = sum_to(b) - sum_to({a.x, b.y}) - sum_to({b.x, a.y}) + sum_to(a);
  return std::max(0.0, sum) / (static_cast<double>(size_) * size_);
}

dvec2 WindowDistribution::sample(const dvec2& u, const Window& w) const {
  const dvec2 a = w.low * static_cast<double>(size_), b = w.high * static_cast<double>(size_);
  // All of the window left of x; then, of the column of cells that x is in, all above y.
  const auto left = [&](double x) {
    return sum_to({x, b.y}) - sum_to({a.x, b.y}) - sum_to({x, a.y}) + sum_to(a);
  };
  const double x = invert(left, a.x, b.x, u.x * left(b.x));
  const int column = std::min(static_cast<int>(x), size_ - 1);
  const auto above = [&](double y) {
    return sum_to({column + 1.0, y}) - sum_to({column + 0.0, y}) - sum_to({column + 1.0, a.y}) +
           sum_to({column + 0.0, a.y});
  };
  const double y = invert(above, a.y, b.y, u.y * above(b.y));
  return dvec2(x, y) / static_cast<double>(size_);
}

double WindowDistribution::value(const dvec2& p) const {
  const int x = std::clamp(static_cast<int>(p.x * size_), 0, size_ - 1);
  const int y = std::clamp(static_cast<int>(p.y * size_), 0, size_ - 1);
  return corner(x + 1, y + 1) - corner(x, y + 1) - corner(x + 1, y) + corner(x, y);
}

Portal::Portal(const dvec3& x, const dvec3& y, const dvec3& low, const dvec3& high)
    : x_(x), y_(y), z_(glm::cross(x, y)), low_(low), high_(high) {}

std::optional<Portal> Portal::make(const std::array<dvec3, 4>& corners,
                                   const std::function<float(const vec3&)>& sky, int size) {
  const dvec3 x = corners[3] - corners[0], y = corners[1] - corners[0];
  const dvec3 other = corners[2] - corners[0];
  const double width = glm::length(x), height = glm::length(y);
  constexpr double tolerance = 1e-3;
  if (!(width > 0.0 && height > 0.0)) return std::nullopt;
  if (!(std::abs(glm::dot(x, y)) <= tolerance * width * height)) return std::nullopt;
  if (!(glm::distance(x + y, other) <= tolerance * (width + height))) return std::nullopt;
  const dvec3 unit_x = x / width;
  // Exactly perpendicular.
  const dvec3 unit_y = glm::normalize(y - unit_x * glm::dot(unit_x, y));
  Portal portal(unit_x, unit_y, corners[0], corners[2]);
  std::vector<float> values;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const Direction d = direction_of(dvec2(i + 0.5, j + 0.5) / static_cast<double>(size));
      const dvec3 world = d.d.x * portal.x_ + d.d.y * portal.y_ + d.d.z * portal.z_;
      values.push_back(static_cast<float>(static_cast<double>(sky(vec3(world))) * d.solid_angle));
    }
  portal.distribution_ = WindowDistribution(values, size);
  portal.total_ = portal.distribution_.integral({});
  return portal;
}

std::optional<Portal::View> Portal::view(const vec3& from) const {
  const dvec3 a = to_local(low_ - dvec3(from)), b = to_local(high_ - dvec3(from));
  if (!(a.z > 0.0 && b.z > 0.0)) return std::nullopt;
  const dvec2 p = layout(a), q = layout(b);
  View v{{glm::min(p, q), glm::max(p, q)}, 0.0};
  v.integral = distribution_.integral(v.window);
  // Less than rounding would leave nothing to sample by.
  if (!(v.integral > 1e-12 * total_)) return std::nullopt;
  return v;
}

vec3 Portal::sample(const View& view, const vec2& u) const {
  const Direction d = direction_of(distribution_.sample(dvec2(u), view.window));
  return vec3(d.d.x * x_ + d.d.y * y_ + d.d.z * z_);
}

float Portal::pdf(const View& view, const vec3& direction) const {
  const dvec3 d = to_local(dvec3(direction));
  if (!(d.z > 0.0)) return 0.f;
  const dvec2 p = layout(d);
  if (!view.window.contains(p)) return 0.f;
  return static_cast<float>(distribution_.value(p) / (view.integral * direction_of(p).solid_angle));
}

}  // namespace pssmlt
