#include "core/excess/excess_pilots.h"

#include <algorithm>
#include <cmath>

namespace pssmlt {
namespace {

constexpr double significant = 3.0;  // [standard errors]
constexpr PilotSize wide{.cells = 1 << 19, .least_sweeps = 4};
constexpr int deep_samples = 64;  // in each pixel

constexpr uint64_t settling_samples = 32, settling_passes = 2;  // of a doubtful cell

PilotSize sized(PilotSize size, int samples) {
  if (samples <= 0) return size;
  size.cells = std::clamp(samples / size.least_sweeps, 1, size.cells);
  size.least_samples = samples;
  size.least_finds = 0;
  return size;
}

uint64_t pilot_seed(uint64_t seed, int alternative) {
  return mix_bits(seed + 2 * static_cast<uint64_t>(alternative));
}

// Of all alternatives' wide pilots together; then what more samples, and the deep pilots, say of
// special cells.
LocalMean local_mean(const SamplerContext& context, const std::vector<ExcessPilots::Seeded>& wides,
                     const std::vector<ExcessPilots::Seeded>& deeps) {
  Pilot all = wides.front().pilot;
  for (size_t i = 1; i < wides.size(); ++i) all.append(wides[i].pilot);
  LocalMean mean(all);
  for (uint64_t pass = 0; pass < settling_passes; ++pass) {
    const std::vector<uint32_t> doubtful = mean.doubtful(all);
    for (int i = 0; i < std::ssize(wides); ++i) {
      const auto& [map, seed] = wides[static_cast<size_t>(i)];
      const uint64_t made = map.samples() / static_cast<size_t>(map.lattice().count());
      const uint64_t begin = made + pass * settling_samples;
      context.integrator.choose(i);
      mean.settle(
          run_pilot_in(context, seed, map.lattice(), doubtful, begin, begin + settling_samples));
    }
  }
  for (const ExcessPilots::Seeded& deep : deeps) mean.settle(deep.pilot);
  return mean;
}

}  // namespace

ExcessPilots run_excess_pilots(const SamplerContext& context, uint64_t seed, int pilot_samples,
                               int deep_pixels) {
  const PilotSize deep{.cells = deep_pixels, .least_sweeps = deep_samples, .least_finds = 256};
  Integrator& integrator = context.integrator;
  ExcessPilots result;
  // All of them serve the same means.
  PilotSize one_wide = wide;
  if (integrator.alternatives() > 1) one_wide.least_sweeps = wide.least_sweeps / 2;
  for (int i = 0; i < integrator.alternatives(); ++i) {
    integrator.choose(i);
    const uint64_t own = pilot_seed(seed, i);
    result.wide.push_back({run_pilot(context, own, sized(one_wide, pilot_samples)), own});
    result.deep.push_back({run_pilot(context, own + 1, sized(deep, pilot_samples)), own + 1});
  }
  result.mean = local_mean(context, result.wide, result.deep);
  return result;
}

LocalMean find_local_mean(const SamplerContext& context, uint64_t seed, int pilot_samples) {
  const uint64_t own = pilot_seed(seed, 0);
  return local_mean(context, {{run_pilot(context, own, sized(wide, pilot_samples)), own}}, {});
}

bool misses_light(const PilotLight& one, std::span<const PilotLight> all) {
  return std::ranges::any_of(all, [&](const PilotLight& other) {
    return one.mean + significant * std::hypot(one.error, other.error) < other.mean;
  });
}

}  // namespace pssmlt
