#include "core/metropolis/steps.h"

#include <algorithm>
#include <bit>

namespace pssmlt {
namespace {

constexpr unsigned all_streams = (1u << stream_count) - 1;
constexpr std::array<Stream, stream_count> streams_in_order = {Stream::camera, Stream::light,
                                                               Stream::connection, Stream::shared};

constexpr StepKind kind_of(Stream stream) {
  return static_cast<StepKind>(static_cast<int>(StepKind::camera) + static_cast<int>(stream));
}

// Geometric with ratio 1/2 from 16 random bits: short walks are as common as paths are.
uint32_t geometric(uint32_t bits16) {
  return static_cast<uint32_t>(std::countl_zero(bits16 << 16 | 0x8000u));
}

}  // namespace

std::string_view to_string(StepKind kind) {
  constexpr std::array<std::string_view, step_kinds> names = {
      "large", "all", "film", "camera", "light", "connection", "shared", "range", "ensemble"};
  return names[static_cast<size_t>(kind)];
}

StepChooser::StepChooser(const StepMix& mix, unsigned streams, bool raster) {
  std::array<double, step_kinds> p{};
  const double small = 1.0 - mix.large;
  const auto at = [&](StepKind kind) -> double& { return p[static_cast<size_t>(kind)]; };
  at(StepKind::large) = mix.large;
  at(StepKind::range) = small * mix.range;
  at(StepKind::ensemble) = small * mix.ensemble;
  if (raster) at(StepKind::film) = small * mix.film;
  const int used = std::popcount(streams & all_streams);
  // One stream alone is no different from all.
  for (const Stream stream : streams_in_order) {
    const bool read = (streams >> static_cast<unsigned>(stream) & 1u) != 0;
    if (read && used > 1) at(kind_of(stream)) = small * mix.stream / used;
  }
  double rest = 1.0;
  for (const double probability : p) rest -= probability;
  at(StepKind::all) = std::max(0.0, rest);
  double sum = 0.0;
  for (size_t k = 0; k < step_kinds; ++k) {
    sum += p[k];
    ends_[k] = static_cast<uint64_t>(sum * 0x1p32 + 0.5);
  }
}

Step StepChooser::choose(uint32_t kind_bits, uint32_t range_bits) const {
  for (size_t k = 0; k < step_kinds; ++k) {
    if (kind_bits < ends_[k]) return make(static_cast<StepKind>(k), range_bits);
  }
  return make(StepKind::all, range_bits);
}

Step StepChooser::choose_small(uint32_t kind_bits, uint32_t range_bits) const {
  const uint64_t large = ends_[static_cast<size_t>(StepKind::large)];
  const uint64_t small = (uint64_t{1} << 32) - std::min(large, uint64_t{1} << 32);
  if (small == 0) return make(StepKind::all, range_bits);
  return choose(static_cast<uint32_t>(large + (kind_bits * small >> 32)), range_bits);
}

Step StepChooser::make(StepKind kind, uint32_t range_bits) {
  constexpr uint32_t blocks = blocks_per_vertex;
  switch (kind) {
    case StepKind::large:
    case StepKind::all:
    case StepKind::ensemble:
      return {kind, all_streams};
    case StepKind::film:
      return {kind, 1u << static_cast<unsigned>(Stream::camera), 0, 1};
    case StepKind::camera:
    case StepKind::light:
    case StepKind::connection:
    case StepKind::shared: {
      const int stream = static_cast<int>(kind) - static_cast<int>(StepKind::camera);
      return {kind, 1u << stream};
    }
    case StepKind::range:
      break;
  }
  const uint32_t first = geometric(range_bits >> 16);
  const uint32_t vertices = 1 + geometric(range_bits & 0xFFFFu);
  return {kind, all_streams, first * blocks, (first + vertices) * blocks};
}

}  // namespace pssmlt
