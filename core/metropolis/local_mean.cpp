#include "core/metropolis/local_mean.h"

#include <algorithm>
#include <cmath>

#include "core/render/error_estimate.h"

namespace pssmlt {
namespace {

constexpr double samples_a_cell = 256.0;
// A splat above this many local means is clamped when the means are taken.
constexpr double outlier = 30.0;

}  // namespace

LocalMean::LocalMean(const RasterFrame& frame, const Pilot& pilot) : frame_(frame) {
  const dvec2 size(frame.crop_size());
  const double cells = std::max(1.0, static_cast<double>(pilot.samples()) / samples_a_cell);
  const double edge = std::max(1.0, std::sqrt(size.x * size.y / cells));  // [pixels]
  cells_ = glm::max(ivec2(1), ivec2(size / edge));
  fill(pilot, nullptr);
  for (int pass = 0; pass < 2; ++pass) {
    const LocalMean coarse = *this;
    fill(pilot, &coarse);
  }
  finish();
}

void LocalMean::fill(const Pilot& pilot, const LocalMean* cap) {
  values_.assign(static_cast<size_t>(cells_.x) * static_cast<size_t>(cells_.y), 0.0);
  const dvec2 a_cell = dvec2(frame_.crop_size()) / dvec2(cells_);
  for (const PilotSplat& s : pilot.all()) {
    const dvec2 at = (dvec2(s.raster) - dvec2(frame_.crop_min)) / a_cell;
    const size_t c = cell(glm::clamp(ivec2(glm::floor(at)), ivec2(0), cells_ - 1));
    const auto value = static_cast<double>(s.value);
    values_[c] += cap != nullptr ? std::min(value, outlier * cap->values_[c]) : value;
  }
  // The picture is (pixels / samples) times the sum, and a cell has pixels / cells of them.
  const double scale =
      static_cast<double>(values_.size()) / std::max(1.0, static_cast<double>(pilot.samples()));
  for (double& v : values_) v *= scale;
  smooth();
}

// By 1 2 1 in each direction.
void LocalMean::smooth() {
  for (int axis = 0; axis < 2; ++axis) {
    const std::vector<double> before = values_;
    const ivec2 step(axis == 0, axis == 1);
    for (int y = 0; y < cells_.y; ++y) {
      for (int x = 0; x < cells_.x; ++x) {
        const ivec2 c(x, y);
        const double low = before[cell(glm::max(c - step, ivec2(0)))];
        const double high = before[cell(glm::min(c + step, cells_ - 1))];
        values_[cell(c)] = 0.5 * before[cell(c)] + 0.25 * (low + high);
      }
    }
  }
}

void LocalMean::finish() {
  double mean = 0.0;
  for (const double v : values_) mean += v / static_cast<double>(values_.size());
  const bool known = mean > 0.0 && std::isfinite(mean);
  for (double& v : values_) {
    v = known ? std::sqrt(v * v + relative_mse_epsilon * mean * mean) : 1.0;
  }
}

double LocalMean::at(const dvec2& raster) const {
  const dvec2 a_cell = dvec2(frame_.crop_size()) / dvec2(cells_);
  const dvec2 at =
      glm::clamp((raster - dvec2(frame_.crop_min)) / a_cell - 0.5, dvec2(0.0), dvec2(cells_ - 1));
  const ivec2 low(at), high = glm::min(low + 1, cells_ - 1);
  const dvec2 f = at - dvec2(low);
  const double bottom = glm::mix(values_[cell(low)], values_[cell({high.x, low.y})], f.x);
  const double top = glm::mix(values_[cell({low.x, high.y})], values_[cell(high)], f.x);
  return glm::mix(bottom, top, f.y);
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
