#include "core/excess/local_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/render/error_estimate.h"

namespace pssmlt {
namespace {

constexpr double smooth_samples = 256.0, median_samples = 4.0;  // a cell
// A splat above this many local means is clamped when the means are taken.
constexpr double outlier = 30.0;
// A camera sample above this many local means is very bright.
constexpr double very_bright = 8.0;
// Samples without the largest one must be worth this many local means for a cell to be special.
constexpr double special = 2.0;
constexpr size_t few = 8;  // one in so many cells

}  // namespace

MeanGrid::MeanGrid(const Pilot& pilot, double samples_a_cell, const MeanGrid* cap)
    : frame_(pilot.frame()) {
  const dvec2 size(frame_.crop_size());
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

LocalMean::LocalMean(const Pilot& pilot)
    : frame_(pilot.frame()),
      lattice_(pilot.lattice()),
      coarse_(pilot, smooth_samples),
      fine_(pilot, median_samples),
      settled_(static_cast<size_t>(pilot.lattice().count()), 0.f) {
  for (int pass = 0; pass < 2; ++pass) {
    coarse_.smooth();
    const MeanGrid cap = coarse_;
    coarse_ = MeanGrid(pilot, smooth_samples, &cap);
  }
  coarse_.smooth();
  fine_.take_medians();
  const double mean = coarse_.mean();
  if (mean > 0.0 && std::isfinite(mean)) floor2_ = relative_mse_epsilon * mean * mean;
}

double LocalMean::at(const dvec2& raster) const {
  if (!(floor2_ > 0.0)) return 1.0;
  const double mean = std::max({coarse_.between(raster), fine_.nearest(raster),
                                static_cast<double>(settled_[lattice_.at(raster)])});
  return std::sqrt(mean * mean + floor2_);
}

std::vector<uint32_t> LocalMean::doubtful(const Pilot& pilot) const {
  std::vector<uint32_t> cells;
  if (!(floor2_ > 0.0)) return cells;
  std::vector<int> bright(settled_.size(), 0);
  for (size_t i = 0; i < pilot.samples(); ++i) {
    const PilotSample& s = pilot.sample(i);
    if (static_cast<double>(s.camera) > very_bright * at(centre(lattice_, s.cell)))
      ++bright[s.cell];
  }
  const ivec2 size = lattice_.cells();
  for (uint32_t c = 0; c < bright.size(); ++c) {
    if (settled_[c] > 0.f) continue;
    const ivec2 at(static_cast<int>(c) % size.x, static_cast<int>(c) / size.x);
    const ivec2 low = glm::max(at - 1, ivec2(0)), high = glm::min(at + 1, size - 1);
    int around = 0;
    bool settled = false;
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        around += bright[lattice_.index({x, y})];
        settled = settled || settled_[lattice_.index({x, y})] > 0.f;
      }
    }
    if (bright[c] > 0 || around > 1 || settled) cells.push_back(c);
  }
  if (cells.size() > settled_.size() / few) cells.clear();
  return cells;
}

dvec2 LocalMean::centre(const PilotLattice& lattice, uint32_t cell) const {
  return dvec2(frame_.crop_min + lattice.pixel(cell)) + 0.5;
}

void LocalMean::settle(const Pilot& some) {
  struct Cell {
    float sum = 0.f, largest = 0.f;
    int count = 0;
  };
  std::map<uint32_t, Cell> cells;
  for (size_t i = 0; i < some.samples(); ++i) {
    const PilotSample& s = some.sample(i);
    Cell& c = cells[s.cell];
    c.sum += s.camera;
    c.largest = std::max(c.largest, s.camera);
    ++c.count;
  }
  for (const auto& [cell, c] : cells) {
    if (c.count < 2) continue;
    const float rest = (c.sum - c.largest) / static_cast<float>(c.count - 1);
    const dvec2 place = centre(some.lattice(), cell);
    if (static_cast<double>(rest) > special * at(place)) settled_[lattice_.at(place)] = rest;
  }
}

double LocalMean::relative(const Splats& splats, const PixelCredit& camera) const {
  double sum = 0.0;
  for (const Splat& s : splats.all()) {
    const double mean = at(s.from_camera ? Pilot::centre(camera, frame_) : s.raster);
    sum += static_cast<double>(luminance(s.value)) / mean;
  }
  return sum;
}

}  // namespace pssmlt
