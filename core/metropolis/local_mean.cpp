#include "core/metropolis/local_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/render/error_estimate.h"

namespace pssmlt {
namespace {

constexpr double smooth_samples = 256.0, median_samples = 4.0;  // a cell
// A splat above this many local means is clamped when the means are taken.
constexpr double outlier = 30.0;

}  // namespace

MeanGrid::MeanGrid(const RasterFrame& frame, const Pilot& pilot, double samples_a_cell,
                   const MeanGrid* cap)
    : frame_(frame) {
  const dvec2 size(frame.crop_size());
  const double count = std::max(1.0, static_cast<double>(pilot.samples()));
  const double finds = std::max(1.0, static_cast<double>(pilot.finds()));
  const double edge = std::max(1.0, std::sqrt(size.x * size.y * samples_a_cell / finds));
  cells_ = glm::max(ivec2(1), ivec2(size / edge));
  values_.assign(static_cast<size_t>(cells_.x) * static_cast<size_t>(cells_.y), 0.0);
  for (const PilotSplat& s : pilot.all()) {
    const size_t c = index(cell_at(dvec2(s.raster)));
    const auto value = static_cast<double>(s.value);
    values_[c] += cap != nullptr ? std::min(value, outlier * cap->values_[c]) : value;
  }
  // The picture is (pixels / samples) times the sum, and a cell has pixels / cells of them.
  for (double& v : values_) v *= static_cast<double>(values_.size()) / count;
}

void MeanGrid::smooth() {
  for (int axis = 0; axis < 2; ++axis) {
    const std::vector<double> before = values_;
    const ivec2 step(axis == 0, axis == 1);
    for (int y = 0; y < cells_.y; ++y) {
      for (int x = 0; x < cells_.x; ++x) {
        const ivec2 c(x, y);
        const double low = before[index(glm::max(c - step, ivec2(0)))];
        const double high = before[index(glm::min(c + step, cells_ - 1))];
        values_[index(c)] = 0.5 * before[index(c)] + 0.25 * (low + high);
      }
    }
  }
}

void MeanGrid::take_medians() {
  const std::vector<double> before = values_;
  for (int y = 0; y < cells_.y; ++y) {
    for (int x = 0; x < cells_.x; ++x) {
      std::array<double, 9> around{};
      size_t n = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          around[n++] = before[index(glm::clamp(ivec2(x + dx, y + dy), ivec2(0), cells_ - 1))];
        }
      }
      std::nth_element(around.begin(), around.begin() + 4, around.end());
      values_[index({x, y})] = around[4];
    }
  }
}

double MeanGrid::mean() const {
  double sum = 0.0;
  for (const double v : values_) sum += v;
  return sum / static_cast<double>(values_.size());
}

dvec2 MeanGrid::cell_position(const dvec2& raster) const {
  return (raster - dvec2(frame_.crop_min)) * dvec2(cells_) / dvec2(frame_.crop_size());
}

ivec2 MeanGrid::cell_at(const dvec2& raster) const {
  return ivec2(glm::clamp(glm::floor(cell_position(raster)), dvec2(0.0), dvec2(cells_ - 1)));
}

double MeanGrid::nearest(const dvec2& raster) const { return values_[index(cell_at(raster))]; }

double MeanGrid::between(const dvec2& raster) const {
  const dvec2 at = glm::clamp(cell_position(raster) - 0.5, dvec2(0.0), dvec2(cells_ - 1));
  const ivec2 low(at), high = glm::min(low + 1, cells_ - 1);
  const dvec2 f = at - dvec2(low);
  const double first = glm::mix(values_[index(low)], values_[index({high.x, low.y})], f.x);
  const double second = glm::mix(values_[index({low.x, high.y})], values_[index(high)], f.x);
  return glm::mix(first, second, f.y);
}

LocalMean::LocalMean(const RasterFrame& frame, const Pilot& pilot)
    : frame_(frame), coarse_(frame, pilot, smooth_samples), fine_(frame, pilot, median_samples) {
  for (int pass = 0; pass < 2; ++pass) {
    coarse_.smooth();
    const MeanGrid cap = coarse_;
    coarse_ = MeanGrid(frame, pilot, smooth_samples, &cap);
  }
  coarse_.smooth();
  fine_.take_medians();
  const double mean = coarse_.mean();
  if (mean > 0.0 && std::isfinite(mean)) floor2_ = relative_mse_epsilon * mean * mean;
}

double LocalMean::at(const dvec2& raster) const {
  if (!(floor2_ > 0.0)) return 1.0;
  const double mean = std::max(coarse_.between(raster), fine_.nearest(raster));
  return std::sqrt(mean * mean + floor2_);
}

RelativeNorms LocalMean::norms(const Splats& splats, const PixelCredit& camera) const {
  RelativeNorms n;
  for (const Splat& s : splats.all()) {
    const double mean = at(s.from_camera ? Pilot::centre(camera, frame_) : s.raster);
    const double relative = static_cast<double>(luminance(s.value)) / mean;
    n.sum += relative;
    n.sum_squares += relative * relative;
  }
  return n;
}

RelativeNorms LocalMean::norms(std::span<const PilotSplat> splats) const {
  RelativeNorms n;
  for (const PilotSplat& s : splats) {
    const double relative = static_cast<double>(s.value) / at(dvec2(s.raster));
    n.sum += relative;
    n.sum_squares += relative * relative;
  }
  return n;
}

}  // namespace pssmlt
