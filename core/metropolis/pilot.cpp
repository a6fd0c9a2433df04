#include "core/metropolis/pilot.h"

#include <algorithm>

#include "core/metropolis/candidate_source.h"
#include "core/sampling/evaluator.h"
#include "core/sampling/primary_sample_owner.h"

namespace pssmlt {
namespace {

constexpr int unit_samples = 1024;
constexpr double least_samples = 8192.0, most_samples = 400000.0;
constexpr int most_times = 32;
constexpr size_t enough_finds = 256;

Pilot run_samples(const SamplerContext& context, uint64_t seed, int first, int count) {
  const int units = (count - 1) / unit_samples + 1;
  std::vector<Pilot> found(static_cast<size_t>(units));
  context.parallel(units, [&](int unit, Worker& worker) {
    for (int i = unit * unit_samples; i < std::min(count, (unit + 1) * unit_samples); ++i) {
      CandidateSource source(seed, static_cast<uint32_t>(first + i));
      worker.sample.begin(source);
      // Evenly over the picture.
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      worker.sample.set_pixel(static_cast<int>(share * context.raster_map.frame().pixels()));
      // A dropped sample counts as one without light.
      (void)worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
      found[static_cast<size_t>(unit)].add(worker.splats, worker.sample.credit(),
                                           context.raster_map.frame());
    }
  });
  Pilot all;
  for (const Pilot& part : found) all.append(part);
  return all;
}

}  // namespace

dvec2 Pilot::centre(const PixelCredit& credit, const RasterFrame& frame) {
  if (credit.pixel < 0) return 0.5 * dvec2(frame.crop_min + frame.crop_max);
  const int width = frame.crop_size().x;
  return dvec2(frame.crop_min) + dvec2(credit.pixel % width, credit.pixel / width) + 0.5;
}

void Pilot::add(const Splats& splats, const PixelCredit& camera, const RasterFrame& frame) {
  if (!splats.empty()) ++finds_;
  for (const Splat& s : splats.all()) {
    const dvec2 raster = s.from_camera ? centre(camera, frame) : s.raster;
    splats_.push_back({vec2(raster), luminance(s.value)});
  }
  ends_.push_back(splats_.size());
}

void Pilot::append(const Pilot& other) {
  const size_t before = splats_.size();
  splats_.insert(splats_.end(), other.splats_.begin(), other.splats_.end());
  for (const size_t end : other.ends_) ends_.push_back(before + end);
  finds_ += other.finds_;
}

Pilot run_pilot(const SamplerContext& context, uint64_t seed, int count) {
  if (count > 0) return run_samples(context, seed, 0, count);
  const double pixels = context.raster_map.frame().pixels();
  const int first = static_cast<int>(std::clamp(4.0 * pixels, least_samples, most_samples));
  Pilot all = run_samples(context, seed, 0, first);
  int made = first;
  for (; all.finds() < enough_finds && made < most_times * first; made *= 2) {
    all.append(run_samples(context, seed, made, made));
  }
  return all;
}

}  // namespace pssmlt
