// Samples before the render, for what has to be known of the picture in advance.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/sampler.h"
#include "core/sampling/raster_map.h"
#include "core/sampling/splats.h"

namespace pssmlt {

// Equal squares of the window, of whole pixels (fewer at its far edges): one pixel of each is
// sampled, and stands for all of them.
class PilotLattice {
 public:
  PilotLattice() = default;
  PilotLattice(const RasterFrame& frame, int stride)
      : corner_(frame.crop_min),
        size_(frame.crop_size()),
        stride_(stride),
        cells_((size_ + (stride - 1)) / stride) {}
  int count() const { return cells_.x * cells_.y; }
  const ivec2& cells() const { return cells_; }  // columns, rows
  // Of a cell by column and row; row major.
  size_t index(const ivec2& c) const {
    return static_cast<size_t>(c.y) * static_cast<size_t>(cells_.x) + static_cast<size_t>(c.x);
  }
  // Of the cell where a position [pixels] lies; outside the window the nearest one.
  size_t at(const dvec2& raster) const {
    const dvec2 place = (raster - corner_) / static_cast<double>(stride_);
    return index(ivec2(glm::clamp(glm::floor(place), dvec2(0.0), dvec2(cells_ - 1))));
  }
  // The pixel that is sampled, relative to the window's corner: somewhere in the cell, so that what
  // repeats in the picture is not met in step.
  ivec2 pixel(uint32_t cell) const;

 private:
  dvec2 corner_{0.0};
  ivec2 size_{1, 1};
  int stride_ = 1;
  ivec2 cells_{1, 1};
};

// A splat of the pilot.
struct PilotSplat {
  vec2 raster{0.f};   // [pixels]
  float value = 0.f;  // luminance [W/(m^2 sr)]
};

// A sample's place in the pilot.
struct PilotSample {
  size_t end = 0;      // one past its last splat
  uint32_t cell = 0;   // of the lattice
  uint32_t sweep = 0;  // of the cell's samples
  float camera = 0.f;  // luminance of its camera splats together [W/(m^2 sr)]
  // 0 or 1: samples of different halves are independent.
  uint32_t half() const { return sweep % 2; }
};

// The splats of many samples, in their order: the same number of each half in every cell.
class Pilot {
 public:
  Pilot() = default;
  Pilot(const RasterFrame& frame, const PilotLattice& lattice) : frame_(frame), lattice_(lattice) {}
  // Where camera splats of this credit land [pixels]; the window's middle if they land nowhere.
  static dvec2 centre(const PixelCredit& credit, const RasterFrame& frame);
  void add(const Splats& splats, const PixelCredit& camera, uint32_t cell, uint32_t sweep);
  void append(const Pilot& other);
  const RasterFrame& frame() const { return frame_; }
  const PilotLattice& lattice() const { return lattice_; }
  size_t samples() const { return samples_.size(); }
  size_t finds() const { return finds_; }  // samples with light
  // Rays that the samples took, of all kinds.
  double rays() const { return rays_; }
  void add_rays(double rays) { rays_ += rays; }
  const PilotSample& sample(size_t i) const { return samples_[i]; }
  std::span<const PilotSplat> splats(size_t i) const {
    const size_t begin = i == 0 ? 0 : samples_[i - 1].end;
    return {splats_.data() + begin, samples_[i].end - begin};
  }
  std::span<const PilotSplat> all() const { return splats_; }

 private:
  RasterFrame frame_;
  PilotLattice lattice_;
  std::vector<PilotSplat> splats_;
  std::vector<PilotSample> samples_;
  size_t finds_ = 0;
  double rays_ = 0.0;
};

// Takes samples of a pilot again, that run_pilot() took with this seed.
class PilotSamples {
 public:
  PilotSamples(const SamplerContext& context, uint64_t seed);
  ~PilotSamples();
  // Leaves numbers and splats of the pilot's sample i in the worker; false if it is dropped.
  bool evaluate(const Pilot& pilot, size_t i, Worker& worker) const;

 private:
  std::unique_ptr<class PilotSweeps> sweeps_;
};

// How many samples, and where.
struct PilotSize {
  int cells = 1 << 19;   // of the lattice, at most
  int least_sweeps = 4;  // samples in each cell; even
  double least_samples = 8192;
  size_t least_finds = 0;  // more samples, up to 8 times as many, until so many found light
};
// Sobol' points, as the sampler "sobol" would take them. A pure function of the seed.
Pilot run_pilot(const SamplerContext& context, uint64_t seed, const PilotSize& size);
// The sweeps [begin, end) of the same points in some cells of a lattice.
Pilot run_pilot_in(const SamplerContext& context, uint64_t seed, const PilotLattice& lattice,
                   std::span<const uint32_t> cells, uint64_t begin, uint64_t end);

}  // namespace pssmlt
