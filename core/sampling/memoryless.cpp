#include "core/sampling/memoryless.h"

#include <algorithm>

#include "core/sampling/evaluator.h"
#include "core/sampling/primary_sample_owner.h"
#include "core/sampling/replay.h"

namespace pssmlt {
namespace {

constexpr int tile_size = 32;  // [pixels]
constexpr int64_t pixels_a_round = 1 << 21;
constexpr int edge = 4;  // of the parts' lattice
static_assert(edge * edge == pair_count);
constexpr uint32_t turns = 8;  // of small pictures' pixels
static_assert(turns <= pair_count);

// Adds camera splats to plane 0 and light splats to plane 1; `light` is scratch.
void add_apart(SplatSink& sink, Splats& splats, const PixelCredit& credit, int group,
               Splats& light) {
  light.clear();
  for (const Splat& splat : splats.all()) {
    if (!splat.from_camera) light.add(splat);
  }
  if (light.empty()) return sink.add(0, splats, credit, 1.0, group);
  sink.add(1, light, {}, 1.0, group);
  if (light.all().size() == splats.all().size()) return;
  light.clear();
  for (const Splat& splat : splats.all()) {
    if (splat.from_camera) light.add(splat);
  }
  sink.add(0, light, credit, 1.0, group);
}

}  // namespace

class MemorylessSampler::Source final : public NumberSource {
 public:
  Source(const MemorylessSampler& sampler, const SampleId& id) : sampler_(sampler), id_(id) {}
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    sampler_.fill(id_, stream, index, block);
  }

 private:
  const MemorylessSampler& sampler_;
  const SampleId& id_;
};

void MemorylessSampler::start(const SamplerContext& context) {
  seed_ = mix_bits(context.seed + mix_bits(scene_seed_));
  size_ = context.raster_map.frame().crop_size();
  tiles_ = (size_ + (tile_size - 1)) / tile_size;
  const int64_t pixels = int64_t{size_.x} * size_.y;
  subsets_ = static_cast<int>((pixels + pixels_a_round - 1) / pixels_a_round);
  subset_pixels_.assign(static_cast<size_t>(subsets_), 0);
  part_pixels_.assign(static_cast<size_t>(subsets_), {});
  for (int64_t p = 0; p < pixels; ++p) {
    const auto subset = static_cast<size_t>(subset_of(static_cast<int>(p)));
    ++subset_pixels_[subset];
    ++part_pixels_[subset][sample_id({p % size_.x, p / size_.x}, 0).part];
  }
}

SampleId MemorylessSampler::sample_id(const ivec2& at, uint64_t sweep) const {
  SampleId id;
  id.pixel = static_cast<uint32_t>(at.y * size_.x + at.x);
  id.sweep = sweep;
  id.nth = sweep / 2;
  const int pixels = size_.x * size_.y;
  if (pixels < pair_count) {
    id.turn = id.part = static_cast<uint32_t>((id.nth + id.pixel) % turns);
    id.nth /= turns;
    return id;
  }
  if (std::min(size_.x, size_.y) < edge) {
    id.part = id.pixel % pair_count;
    id.place = id.pixel / pair_count;
    id.part_pixels = static_cast<uint32_t>((pixels + pair_count - 1) / pair_count);
    return id;
  }
  const ivec2 places = (size_ + (edge - 1)) / edge;
  id.part = static_cast<uint32_t>(at.x % edge + edge * (at.y % edge));
  id.place = static_cast<uint32_t>(at.x / edge + at.y / edge * places.x);
  id.part_pixels = static_cast<uint32_t>(places.x) * static_cast<uint32_t>(places.y);
  return id;
}

// Diagonals, so that every block of the picture has pixels of all subsets.
int MemorylessSampler::subset_of(int pixel) const {
  return subsets_ == 1 ? 0 : (pixel % size_.x + pixel / size_.x) % subsets_;
}

void MemorylessSampler::run(int64_t round, int unit, SplatSink& sink, Worker& worker) {
  const int subset = static_cast<int>(subset_of_round(round));
  const int plane_of_light = planes() - 1;
  Splats light;
  const ivec2 low = ivec2(unit % tiles_.x, unit / tiles_.x) * tile_size;
  const ivec2 high = glm::min(low + tile_size, size_);
  const auto sweep = static_cast<uint64_t>(round / subsets_);
  for (int y = low.y; y < high.y; ++y) {
    for (int x = low.x; x < high.x; ++x) {
      const int pixel = y * size_.x + x;
      if (subset_of(pixel) != subset) continue;
      run_pixel(sample_id({x, y}, sweep), plane_of_light, sink, worker, light);
    }
  }
}

bool MemorylessSampler::evaluate(const SampleId& id, Worker& worker) const {
  Source source(*this, id);
  worker.sample.begin(source);
  worker.sample.set_pixel(static_cast<int>(id.pixel));
  worker.evaluator.name_sample(name_, seed_, id.pixel, static_cast<int64_t>(id.sweep));
  const bool good =
      worker.evaluator.evaluate(worker.sample.sample(), worker.splats, worker.workspace);
  worker.evaluator.name_sample(nullptr, 0, -1, -1);
  return good;
}

void MemorylessSampler::run_pixel(const SampleId& id, int plane_of_light, SplatSink& sink,
                                  Worker& worker, Splats& light) const {
  if (!evaluate(id, worker) || worker.splats.empty()) return;
  const PixelCredit credit = worker.sample.credit();
  const double rest = reshape(worker.splats, credit);
  if (plane_of_light == 0) {
    sink.add(0, worker.splats, credit, 1.0, id.group());
  } else {
    add_apart(sink, worker.splats, credit, id.group(), light);
  }
  if (rest > 0.0) add_rest(id, rest, plane_of_light, sink, worker);
}

// Samples of the whole picture in the first `rounds` rounds.
uint64_t MemorylessSampler::samples_before(int64_t rounds) const {
  uint64_t sum = 0;
  for (int s = 0; s < subsets_; ++s) {
    const int64_t served = rounds / subsets_ + (s < rounds % subsets_ ? 1 : 0);
    sum += static_cast<uint64_t>(served) * subset_pixels_[static_cast<size_t>(s)];
  }
  return sum;
}

double MemorylessSampler::scale(int plane, int subset, int64_t rounds) const {
  if (plane == 0) {
    const int64_t count = rounds / subsets_ + (subset < rounds % subsets_ ? 1 : 0);
    return count > 0 ? 1.0 / static_cast<double>(count) : 0.0;
  }
  const uint64_t samples = samples_before(rounds);
  return samples > 0 ? double(size_.x) * size_.y / static_cast<double>(samples) : 0.0;
}

uint64_t MemorylessSampler::group_samples(int group, int64_t rounds) const {
  const int half = group % 2;
  const auto part = static_cast<size_t>(group / 2);
  uint64_t sum = 0;
  const int pixels = size_.x * size_.y;
  if (pixels < pair_count) {
    // Turns of the first `mine` samples of a half that are this part's.
    const auto mine = static_cast<uint64_t>((rounds + 1 - half) / 2);
    for (uint32_t p = 0; p < static_cast<uint32_t>(pixels) && part < turns; ++p) {
      const uint64_t first = (part + turns - p % turns) % turns;
      if (mine > first) sum += (mine - first - 1) / turns + 1;
    }
    return sum;
  }
  for (int s = 0; s < subsets_; ++s) {
    const int64_t sweeps = rounds / subsets_ + (s < rounds % subsets_ ? 1 : 0);
    sum +=
        static_cast<uint64_t>((sweeps + 1 - half) / 2) * part_pixels_[static_cast<size_t>(s)][part];
  }
  return sum;
}

double MemorylessSampler::group_scale(int plane, int group, int64_t rounds) const {
  (void)plane;  // both planes: pixels a sample of the group
  const uint64_t samples = group_samples(group, rounds);
  return samples > 0 ? double(size_.x) * size_.y / static_cast<double>(samples) : 0.0;
}

bool MemorylessSampler::replay(const std::string& key, Worker& worker) {
  SampleName name;
  if (!parse_sample_name(key, name) || name.name != name_ || name.seed != seed_) return false;
  const int64_t pixels = int64_t{size_.x} * size_.y;
  if (name.pixel < 0 || name.pixel >= pixels || name.index < 0) return false;
  // A sample that is dropped again leaves no splats and is counted.
  (void)evaluate({name.pixel % size_.x, name.pixel / size_.x}, static_cast<uint64_t>(name.index),
                 worker);
  return true;
}

}  // namespace pssmlt
