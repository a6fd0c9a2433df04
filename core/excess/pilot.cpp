#include "core/excess/pilot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/sampling/primary_sample_owner.h"
#include "core/sampling/sobol_sweeps.h"
#include "core/scene/scene.h"

namespace pssmlt {

class PilotSweeps final : public SobolSweeps {
 public:
  PilotSweeps(const SamplerContext& context, uint64_t seed) : SobolSweeps(nullptr, 1.0, seed) {
    start(context);
  }
  bool take(const ivec2& pixel, uint64_t sweep, Worker& worker) const {
    return evaluate(pixel, sweep, worker);
  }
  void run_cells(std::span<const uint32_t> cells, uint64_t begin, uint64_t end, Worker& worker,
                 Pilot& pilot) const {
    const RayCounters before = ray_counters();
    for (const uint32_t cell : cells) {
      for (uint64_t sweep = begin; sweep < end; ++sweep) {
        // A dropped sample counts as one without light.
        (void)take(pilot.lattice().pixel(cell), sweep, worker);
        pilot.add(worker.splats, worker.sample.credit(), cell, static_cast<uint32_t>(sweep));
      }
    }
    const RayCounters now = ray_counters();
    pilot.add_rays(static_cast<double>(now.nearest - before.nearest + now.shadow - before.shadow));
  }
};

namespace {

constexpr size_t cells_a_unit = 256;
constexpr int most_times = 8;

void run_sweeps(const SamplerContext& context, const PilotSweeps& sweeps,
                std::span<const uint32_t> cells, uint64_t begin, uint64_t end, Pilot& all) {
  const size_t units = (cells.size() + cells_a_unit - 1) / cells_a_unit;
  std::vector<Pilot> parts(units, Pilot(all.frame(), all.lattice()));
  context.parallel(static_cast<int>(units), [&](int unit, Worker& worker) {
    const size_t first = static_cast<size_t>(unit) * cells_a_unit;
    const size_t count = std::min(cells.size() - first, cells_a_unit);
    sweeps.run_cells(cells.subspan(first, count), begin, end, worker,
                     parts[static_cast<size_t>(unit)]);
  });
  for (const Pilot& part : parts) all.append(part);
}

// The finest of no more cells than this.
PilotLattice lattice_for(const RasterFrame& frame, double cells) {
  int stride = 1;
  while (stride < 1024 && PilotLattice(frame, stride).count() > cells) ++stride;
  return {frame, stride};
}

uint64_t even(double sweeps) { return 2 * static_cast<uint64_t>(std::ceil(0.5 * sweeps)); }

}  // namespace

ivec2 PilotLattice::pixel(uint32_t cell) const {
  const int index = static_cast<int>(cell);
  const uint64_t bits = mix_bits(cell + 0x6C617474u);
  const auto stride = static_cast<uint32_t>(stride_);
  const ivec2 offset(static_cast<uint32_t>(bits) % stride, (bits >> 32) % stride);
  return glm::min(ivec2(index % cells_.x, index / cells_.x) * stride_ + offset, size_ - 1);
}

dvec2 Pilot::centre(const PixelCredit& credit, const RasterFrame& frame) {
  if (credit.pixel < 0) return 0.5 * dvec2(frame.crop_min + frame.crop_max);
  const int width = frame.crop_size().x;
  return dvec2(frame.crop_min) + dvec2(credit.pixel % width, credit.pixel / width) + 0.5;
}

void Pilot::add(const Splats& splats, const PixelCredit& camera, uint32_t cell, uint32_t sweep) {
  if (!splats.empty()) ++finds_;
  PilotSample sample{0, cell, sweep, 0.f};
  for (const Splat& s : splats.all()) {
    const dvec2 raster = s.from_camera ? centre(camera, frame_) : s.raster;
    const float value = luminance(s.value);
    if (s.from_camera) sample.camera += value;
    splats_.push_back({vec2(raster), value});
  }
  sample.end = splats_.size();
  samples_.push_back(sample);
}

void Pilot::append(const Pilot& other) {
  const size_t before = splats_.size();
  splats_.insert(splats_.end(), other.splats_.begin(), other.splats_.end());
  for (PilotSample sample : other.samples_) {
    sample.end += before;
    samples_.push_back(sample);
  }
  finds_ += other.finds_;
  rays_ += other.rays_;
}

PilotSamples::PilotSamples(const SamplerContext& context, uint64_t seed)
    : sweeps_(std::make_unique<PilotSweeps>(context, seed)) {}
PilotSamples::~PilotSamples() = default;

bool PilotSamples::evaluate(const Pilot& pilot, size_t i, Worker& worker) const {
  const PilotSample& sample = pilot.sample(i);
  return sweeps_->take(pilot.lattice().pixel(sample.cell), sample.sweep, worker);
}

Pilot run_pilot(const SamplerContext& context, uint64_t seed, const PilotSize& size) {
  const RasterFrame& frame = context.raster_map.frame();
  const PilotSweeps sweeps(context, seed);
  Pilot all(frame, lattice_for(frame, size.cells));
  std::vector<uint32_t> cells(static_cast<size_t>(all.lattice().count()));
  std::iota(cells.begin(), cells.end(), 0u);
  const uint64_t first =
      even(std::max<double>(size.least_sweeps, size.least_samples / all.lattice().count()));
  run_sweeps(context, sweeps, cells, 0, first, all);
  uint64_t made = first;
  for (; all.finds() < size.least_finds && made < most_times * first; made *= 2) {
    run_sweeps(context, sweeps, cells, made, 2 * made, all);
  }
  return all;
}

Pilot run_pilot_in(const SamplerContext& context, uint64_t seed, const PilotLattice& lattice,
                   std::span<const uint32_t> cells, uint64_t begin, uint64_t end) {
  Pilot some(context.raster_map.frame(), lattice);
  if (!cells.empty()) {
    run_sweeps(context, PilotSweeps(context, seed), cells, begin, end, some);
  }
  return some;
}

}  // namespace pssmlt
