#include "app/metrics/flip_observer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pssmlt::flip {
namespace {

constexpr float colour_exponent = 0.7f, feature_exponent = 0.5f;
constexpr float knee_at = 0.4f, knee_value = 0.95f;  // p_c, p_t of section 4.1.3
constexpr int rows_per_unit = 8;

// body(first, end) for ranges of rows, in parallel.
void for_rows(int height, WorkerPool& pool, const std::function<void(int first, int end)>& body) {
  const int units = (height + rows_per_unit - 1) / rows_per_unit;
  pool.run(units, [&](int unit, int) {
    const int first = unit * rows_per_unit;
    body(first, std::min(first + rows_per_unit, height));
  });
}

// The largest distance that two colours can have, green and blue, raised to the exponent.
float largest_distance() {
  return std::pow(hyab(to_hunt_lab({0.f, 1.f, 0.f}), to_hunt_lab({0.f, 0.f, 1.f})),
                  colour_exponent);
}

// HyAB distance to [0, 1]: linear in its power up to the knee, compressed above.
float colour_error(float distance, float largest) {
  const float power = std::pow(distance, colour_exponent), knee = knee_at * largest;
  const float error = power < knee
                          ? knee_value / knee * power
                          : knee_value + (power - knee) / (largest - knee) * (1.f - knee_value);
  return std::min(error, 1.f);  // rounding
}

}  // namespace

// Rows of one unit of work.
struct Observer::Scratch {
  explicit Scratch(int width) : colours(static_cast<size_t>(width)) {
    for (auto& row : rows) row.resize(static_cast<size_t>(width));
  }
  std::vector<Rgb> colours;
  std::vector<float> rows[4], padded;
};

Observer::Observer(int width, int height, double pixels_per_degree, WorkerPool& pool)
    : width_(width),
      height_(height),
      pool_(pool),
      detectors_(pixels_per_degree),
      y_(gaussian_terms(achromatic, pixels_per_degree).front()),
      cx_(gaussian_terms(red_green, pixels_per_degree).front()),
      cz_(gaussian_terms(blue_yellow, pixels_per_degree)),
      largest_(largest_distance()),
      y_rows_(width, height),
      cx_rows_(width, height),
      cz_rows_(cz_.size(), Plane(width, height)),
      smooth_rows_(width, height),
      edge_rows_(width, height),
      point_rows_(width, height) {}

void Observer::filter_along_row(std::span<const Rgb> row, int y, Scratch& s) {
  auto& [luma, cx, cz, relative] = s.rows;
  for (size_t x = 0; x < row.size(); ++x) {
    const vec3 c = to_ycxcz(row[x]);
    luma[x] = c.x;
    cx[x] = c.y;
    cz[x] = c.z;
    relative[x] = relative_luminance(c);
  }
  filter_row(luma, y_.along_row, s.padded, y_rows_.row(y));
  filter_row(cx, cx_.along_row, s.padded, cx_rows_.row(y));
  for (size_t t = 0; t < cz_.size(); ++t) {
    filter_row(cz, cz_[t].along_row, s.padded, cz_rows_[t].row(y));
  }
  filter_row(relative, detectors_.gaussian, s.padded, smooth_rows_.row(y));
  filter_row(relative, detectors_.edge, s.padded, edge_rows_.row(y));
  filter_row(relative, detectors_.point, s.padded, point_rows_.row(y));
}

void Observer::see_colours(int y, Scratch& s, Appearance& seen) const {
  auto& [luma, cx, cz, term] = s.rows;
  filter_column(y_rows_, y, y_.along_column, luma);
  filter_column(cx_rows_, y, cx_.along_column, cx);
  filter_column(cz_rows_[0], y, cz_[0].along_column, cz);
  for (size_t t = 1; t < cz_.size(); ++t) {
    filter_column(cz_rows_[t], y, cz_[t].along_column, term);
    for (size_t x = 0; x < cz.size(); ++x) cz[x] += term[x];
  }
  const auto l = seen.l.row(y), a = seen.a.row(y), b = seen.b.row(y);
  for (size_t x = 0; x < luma.size(); ++x) {
    const Rgb rgb = glm::clamp(from_ycxcz({luma[x], cx[x], cz[x]}), 0.f, 1.f);
    const vec3 lab = to_hunt_lab(rgb);
    l[x] = lab.x;
    a[x] = lab.y;
    b[x] = lab.z;
  }
}

void Observer::see_features(int y, Scratch& s, Appearance& seen) const {
  auto& [edge_x, edge_y, point_x, point_y] = s.rows;
  filter_column(edge_rows_, y, detectors_.gaussian, edge_x);
  filter_column(smooth_rows_, y, detectors_.edge, edge_y);
  filter_column(point_rows_, y, detectors_.gaussian, point_x);
  filter_column(smooth_rows_, y, detectors_.point, point_y);
  const auto edges = seen.edges.row(y), points = seen.points.row(y);
  for (size_t x = 0; x < edges.size(); ++x) {
    edges[x] = std::sqrt(sqr(edge_x[x]) + sqr(edge_y[x]));
    points[x] = std::sqrt(sqr(point_x[x]) + sqr(point_y[x]));
  }
}

void Observer::look(const std::function<void(int, std::span<Rgb>)>& colours, Appearance& seen) {
  for_rows(height_, pool_, [&](int first, int end) {
    Scratch scratch(width_);
    for (int y = first; y < end; ++y) {
      colours(y, scratch.colours);
      filter_along_row(scratch.colours, y, scratch);
    }
  });
  for_rows(height_, pool_, [&](int first, int end) {
    Scratch scratch(width_);
    for (int y = first; y < end; ++y) {
      see_colours(y, scratch, seen);
      see_features(y, scratch, seen);
    }
  });
}

void Observer::raise(const Appearance& p, const Appearance& r, Plane& error) const {
  for_rows(height_, pool_, [&](int first, int end) {
    const size_t from = static_cast<size_t>(first) * static_cast<size_t>(width_);
    const size_t to = static_cast<size_t>(end) * static_cast<size_t>(width_);
    for (size_t i = from; i < to; ++i) {
      const float distance = hyab({p.l.values[i], p.a.values[i], p.b.values[i]},
                                  {r.l.values[i], r.a.values[i], r.b.values[i]});
      const float feature = std::max(std::fabs(p.edges.values[i] - r.edges.values[i]),
                                     std::fabs(p.points.values[i] - r.points.values[i]));
      const float features =
          std::min(std::pow(feature / std::numbers::sqrt2_v<float>, feature_exponent), 1.f);
      const float flip = std::pow(colour_error(distance, largest_), 1.f - features);
      error.values[i] = std::max(error.values[i], flip);
    }
  });
}

}  // namespace pssmlt::flip
