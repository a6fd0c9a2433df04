#include "core/sampling/raster_map.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"

namespace pssmlt {
namespace {

constexpr int subcells = 4;  // midpoints a side whose mean is a cell's value
constexpr int cells = RasterMap::cells;

// Interval of a cdf (0 first, 1 last) that holds u, and where in it [0,1).
struct Inverted {
  int interval;
  double fraction;
};
// `guide` names the interval that k / cells lies in, where the search for u >= k / cells starts.
Inverted invert(const double* cdf, const uint8_t* guide, double u) {
  int i = guide[std::min(static_cast<int>(u * cells), cells - 1)];
  while (i < cells - 1 && cdf[i + 1] <= u) ++i;
  const double width = cdf[i + 1] - cdf[i];
  return {i, width > 0.0 ? (u - cdf[i]) / width : 0.5};
}

void make_guide(const double* cdf, uint8_t* guide) {
  for (int k = 0, i = 0; k < cells; ++k) {
    while (i < cells - 1 && cdf[i + 1] <= static_cast<double>(k) / cells) ++i;
    guide[k] = static_cast<uint8_t>(i);
  }
}

// Mean of the filter over one cell.
float cell_value(const Filter& filter, int x, int y, const dvec2& radius) {
  double sum = 0.0;
  for (int j = 0; j < subcells; ++j) {
    for (int i = 0; i < subcells; ++i) {
      const dvec2 at(x + (i + 0.5) / subcells, y + (j + 0.5) / subcells);
      sum += filter.evaluate(vec2((2.0 * at / static_cast<double>(cells) - 1.0) * radius));
    }
  }
  return static_cast<float>(sum / (subcells * subcells));
}

}  // namespace

RasterMap::RasterMap(const RasterFrame& frame, std::shared_ptr<const Filter> filter)
    : frame_(frame), radius_(filter->radius()), values_(cells * cells) {
  for (int axis = 0; axis < 2; ++axis) {
    if (!(radius_[axis] > 0.0 && radius_[axis] <= max_radius)) {
      throw Error("the filter's radius must lie in (0, 64] pixels");
    }
  }
  cells_a_pixel_ = static_cast<double>(cells) / (2.0 * radius_);
  tabulate(*filter);
  accumulate();
  if (!(integral_ > 0.0) || !std::isfinite(integral_)) {
    throw Error("the filter's integral must be positive");
  }
  const bool constant = std::ranges::all_of(values_, [&](float v) { return v == values_[0]; });
  pixel_box_ = constant && radius_ == dvec2(0.5);
  separate();
}

void RasterMap::tabulate(const Filter& filter) {
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      values_[static_cast<size_t>(y * cells + x)] = cell_value(filter, x, y, radius_);
    }
  }
}

void RasterMap::accumulate() {
  marginal_cdf_.assign(cells + 1, 0.0);
  conditional_cdf_.assign(cells * (cells + 1), 0.0);
  double sum = 0.0, abs_sum = 0.0;
  for (size_t y = 0; y < cells; ++y) {
    double* row = &conditional_cdf_[y * (cells + 1)];
    for (size_t x = 0; x < cells; ++x) {
      const double value = values_[y * cells + x];
      sum += value;
      row[x + 1] = row[x] + std::abs(value);
    }
    abs_sum += row[cells];
    marginal_cdf_[y + 1] = abs_sum;
    const double row_sum = row[cells];
    for (size_t x = 1; x <= cells && row_sum > 0.0; ++x) row[x] /= row_sum;
  }
  for (double& c : marginal_cdf_) c /= abs_sum;
  marginal_guide_.resize(cells);
  conditional_guide_.resize(cells * cells);
  make_guide(marginal_cdf_.data(), marginal_guide_.data());
  for (size_t y = 0; y < cells; ++y) {
    make_guide(&conditional_cdf_[y * (cells + 1)], &conditional_guide_[y * cells]);
  }
  const double cell_area = 4.0 * radius_.x * radius_.y / (cells * cells);
  integral_ = sum * cell_area;
  abs_integral_ = abs_sum * cell_area;
}

// Tables of one axis each, if their product is the filter but for rounding.
void RasterMap::separate() {
  const auto largest =
      std::ranges::max_element(values_, {}, [](float value) { return std::abs(value); });
  const auto at = static_cast<size_t>(largest - values_.begin());
  const float top = *largest;
  std::vector<float> column(cells), row(cells);
  for (size_t i = 0; i < cells; ++i) {
    column[i] = values_[at / cells * cells + i];
    row[i] = values_[i * cells + at % cells] / top;
  }
  for (size_t y = 0; y < cells; ++y) {
    for (size_t x = 0; x < cells; ++x) {
      const float difference = values_[y * cells + x] - column[x] * row[y];
      if (!(std::abs(difference) <= 1e-6f * std::abs(top))) return;
    }
  }
  column_ = std::move(column);
  row_ = std::move(row);
}

RasterMap::Offset RasterMap::sample_offset(double x, double y) const {
  if (pixel_box_) return {dvec2(x, y) - 0.5, 1.f};
  const Inverted row = invert(marginal_cdf_.data(), marginal_guide_.data(), y);
  const auto line = static_cast<size_t>(row.interval);
  const Inverted column =
      invert(&conditional_cdf_[line * (cells + 1)], &conditional_guide_[line * cells], x);
  const dvec2 at(column.interval + column.fraction, row.interval + row.fraction);
  const float value = values_[static_cast<size_t>(row.interval * cells + column.interval)];
  const double weight = abs_integral_ / integral_;
  return {(2.0 * at / static_cast<double>(cells) - 1.0) * radius_,
          static_cast<float>(value < 0.f ? -weight : weight)};
}

RasterMap::CameraPoint RasterMap::camera_point(double x, double y) const {
  const ivec2 size = frame_.crop_size();
  const dvec2 at(x * size.x, y * size.y);
  const int column = std::min(static_cast<int>(at.x), size.x - 1);
  const int row = std::min(static_cast<int>(at.y), size.y - 1);
  return camera_point_in(row * size.x + column, at.x - column, at.y - row);
}

RasterMap::CameraPoint RasterMap::camera_point_in(int pixel, double x, double y) const {
  const int width = frame_.crop_size().x;
  const Offset offset = sample_offset(x, y);
  const dvec2 center(frame_.crop_min.x + pixel % width + 0.5,
                     frame_.crop_min.y + pixel / width + 0.5);
  return {center + offset.offset, {pixel, offset.weight}};
}

float RasterMap::filter_value(const dvec2& offset) const {
  const dvec2 at = (offset / radius_ + 1.0) * (0.5 * cells);
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < cells && at.y < cells)) return 0.f;
  return values_[static_cast<size_t>(static_cast<int>(at.y) * cells + static_cast<int>(at.x))];
}

}  // namespace pssmlt
