#include "core/render/film.h"

#include <algorithm>

#include "core/base/archive.h"
#include "core/base/random.h"
#include "core/sampling/raster_map.h"

namespace pssmlt {
namespace {

constexpr int most_blocks = 1024;

double luminance_of(const dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

}  // namespace

BlockGrid::BlockGrid(const ivec2& size) : width_(static_cast<uint32_t>(size.x)) {
  const auto count = [&](int n) { return (n + edge_ - 1) / edge_; };
  while (int64_t{count(size.x)} * count(size.y) > most_blocks) edge_ = 1 << ++shift_;
  across_ = count(size.x);
  down_ = count(size.y);
}

Film::Film(FilmSettings settings) : settings_(std::move(settings)), grid_(settings_.size) {
  for (const int planes : settings_.planes) {
    first_plane_.push_back(plane_count_);
    plane_count_ += planes;
  }
  const auto planes = static_cast<size_t>(plane_count_);
  slots_ = std::vector<Slot>(planes * 2);
  constexpr size_t indices[split_kinds] = {split_edge, split_edge * split_edge};
  for (size_t k = 0; k < split_kinds; ++k) {
    if (settings_.split[k]) split_slots_[k] = std::vector<Slot>(planes * indices[k]);
  }
  block_rows_.resize(planes * group_count);
}

Film::Pixels& Film::Slot::make(Film& film) {
  const std::lock_guard lock(film.making_);
  if (Pixels* made = get()) return *made;
  owner_ = std::make_unique<Pixels>(static_cast<size_t>(film.pixels()));
  film.bytes_ += owner_->low.size() * 2 * sizeof(uint64_t);
  pixels_.store(owner_.get(), std::memory_order_release);
  return *owner_;
}

size_t Film::slot(int layer, int plane, int half) const {
  return static_cast<size_t>((first_plane_[static_cast<size_t>(layer)] + plane) * 2 + half);
}

size_t Film::split_slot(SplitKind kind, int index, int layer, int plane) const {
  (void)kind;
  return static_cast<size_t>(index) * static_cast<size_t>(plane_count_) +
         static_cast<size_t>(first_plane_[static_cast<size_t>(layer)] + plane);
}

void Film::add_to(Pixels& pixels, int pixel, const dvec3& value) {
  const size_t first = static_cast<size_t>(pixel) * 3;
  for (size_t c = 0; c < 3; ++c) {
    add_fixed_atomic(pixels.low[first + c], pixels.high[first + c],
                     to_fixed(value[static_cast<int>(c)]));
  }
}

dvec3 Film::Pixels::value(int pixel) const {
  const size_t first = static_cast<size_t>(pixel) * 3;
  dvec3 result;
  for (size_t c = 0; c < 3; ++c) {
    result[static_cast<int>(c)] = to_double({high[first + c], low[first + c]});
  }
  return result;
}

void Film::add(int layer, int plane, int half, int pixel, const dvec3& value) {
  Slot& s = slots_[slot(layer, plane, half)];
  Pixels* const pixels = s.get();
  add_to(pixels != nullptr ? *pixels : s.make(*this), pixel, value);
}

void Film::prefetch(int layer, int plane, int half, int pixel) const {
  const Pixels* const pixels = slots_[slot(layer, plane, half)].get();
  if (pixels == nullptr) return;
  const size_t first = static_cast<size_t>(pixel) * 3;
  __builtin_prefetch(&pixels->low[first], 1);
  __builtin_prefetch(&pixels->low[first + 2], 1);  // may lie in the next line
}

void Film::add_split(SplitKind kind, int index, int layer, int plane, int pixel,
                     const dvec3& value) {
  Slot& s = split_slots_[static_cast<size_t>(kind)][split_slot(kind, index, layer, plane)];
  Pixels* const pixels = s.get();
  add_to(pixels != nullptr ? *pixels : s.make(*this), pixel, value);
}

int Film::split_index(SplitKind kind, const PathTag& tag) {
  constexpr int last = split_edge - 1;
  if (kind == SplitKind::length) return std::min<int>(tag.bounces, last);
  return std::min<int>(tag.s, last) * split_edge + std::min<int>(tag.t, last);
}

BlockSums Film::make_block_sums() const {
  BlockSums sums;
  sums.rows_.resize(block_rows_.size());
  return sums;
}

void Film::end_round(const std::vector<BlockSums*>& threads) {
  const auto blocks = static_cast<size_t>(grid_.count());
  for (BlockSums* const thread : threads) {
    for (size_t row = 0; row < thread->rows_.size(); ++row) {
      std::vector<FixedSum>& from = thread->rows_[row];
      if (from.empty()) continue;
      std::vector<FixedSum>& to = block_rows_[row];
      to.resize(blocks);
      for (size_t b = 0; b < blocks; ++b) {
        to[b].add(from[b]);
        from[b] = FixedSum();
      }
    }
  }
}

dvec3 Film::value(int layer, int plane, int half, int pixel) const {
  const Pixels* const pixels = slots_[slot(layer, plane, half)].get();
  return pixels == nullptr ? dvec3(0.0) : pixels->value(pixel);
}

bool Film::used(int layer, int plane, int half) const {
  return slots_[slot(layer, plane, half)].get() != nullptr;
}

dvec3 Film::split_value(SplitKind kind, int index, int layer, int plane, int pixel) const {
  const auto& slots = split_slots_[static_cast<size_t>(kind)];
  const Pixels* const pixels = slots[split_slot(kind, index, layer, plane)].get();
  return pixels == nullptr ? dvec3(0.0) : pixels->value(pixel);
}

std::vector<int> Film::split_indices(SplitKind kind) const {
  std::vector<int> result;
  const auto& slots = split_slots_[static_cast<size_t>(kind)];
  const auto planes = static_cast<size_t>(plane_count_);
  for (size_t first = 0; first < slots.size(); first += planes) {
    const auto begin = slots.begin() + static_cast<ptrdiff_t>(first);
    const bool any =
        std::any_of(begin, begin + plane_count_, [](const Slot& s) { return s.get() != nullptr; });
    if (any) result.push_back(static_cast<int>(first / planes));
  }
  return result;
}

double Film::block_sum(int layer, int plane, int group, int block) const {
  const auto& row = block_rows_[static_cast<size_t>(block_row(layer, plane, group))];
  return row.empty() ? 0.0 : row[static_cast<size_t>(block)].value();
}

void Film::save_slots(Archive& archive, const std::vector<Slot>& slots) {
  for (const Slot& s : slots) {
    archive.value<uint8_t>(s.get() != nullptr ? 1 : 0);
    if (s.get() == nullptr) continue;
    const Pixels& pixels = *s.get();
    archive.array(pixels.low);
    const bool high =
        std::any_of(pixels.high.begin(), pixels.high.end(), [](int64_t word) { return word != 0; });
    archive.array(high ? pixels.high : std::vector<int64_t>());
  }
}

void Film::load_slots(Archive& archive, std::vector<Slot>& slots) {
  for (Slot& s : slots) {
    if (archive.get<uint8_t>() == 0) continue;
    Pixels& pixels = s.make(*this);
    const size_t words = pixels.low.size();
    pixels.low = archive.get_array<uint64_t>();
    std::vector<int64_t> high = archive.get_array<int64_t>();
    if (!high.empty()) pixels.high = std::move(high);
    if (pixels.low.size() != words || pixels.high.size() != words) {
      throw Error("the checkpoint is of another image size");
    }
  }
}

void Film::save(Archive& archive) const {
  archive.value(settings_.size);
  archive.array(settings_.planes);
  archive.value(settings_.split);
  save_slots(archive, slots_);
  for (const auto& slots : split_slots_) save_slots(archive, slots);
  for (const auto& row : block_rows_) archive.array(row);
}

void Film::load(Archive& archive) {
  const auto size = archive.get<ivec2>();
  const auto planes = archive.get_array<int>();
  const auto split = archive.get<std::array<bool, split_kinds>>();
  if (size != settings_.size || planes != settings_.planes || split != settings_.split) {
    throw Error("the checkpoint is of another image size or other layers");
  }
  load_slots(archive, slots_);
  for (auto& slots : split_slots_) load_slots(archive, slots);
  for (auto& row : block_rows_) {
    row = archive.get_array<FixedSum>();
    if (!row.empty() && row.size() != static_cast<size_t>(grid_.count())) {
      throw Error("the checkpoint's block sums do not fit the image");
    }
  }
}

void UnitSink::add(int plane, const Splats& splats, const PixelCredit& camera, double weight,
                   int group) {
  const bool clamped = unit_.clamp < infinity;
  weight *= unit_.factor;
  const float camera_factor = clamped ? camera_clamp(splats) : 1.f;
  const double camera_weight = weight * static_cast<double>(camera.weight * camera_factor);
  dvec3 camera_sum(0.0);
  bool any_camera = false;
  for (const Splat& s : splats.all()) {
    if (s.from_camera) {
      const dvec3 value = dvec3(s.value) * camera_weight;
      camera_sum += value;
      any_camera = true;
      if (splits_ && camera.pixel >= 0) split(plane, s.tag, camera.pixel, value);
      continue;
    }
    const PixelCredit credit = map_.pick(s.raster, filter_number());
    if (credit.pixel < 0) continue;
    const float factor = clamped ? std::min(1.f, unit_.clamp / max_component(s.value)) : 1.f;
    const dvec3 value = dvec3(s.value) * (weight * static_cast<double>(credit.weight * factor));
    deposit(plane, group, credit.pixel, value);
    if (splits_) split(plane, s.tag, credit.pixel, value);
  }
  if (any_camera && camera.pixel >= 0) deposit(plane, group, camera.pixel, camera_sum);
}

void UnitSink::deposit(int plane, int group, int pixel, const dvec3& value) {
  const auto hash = static_cast<uint32_t>(pixel) * 0x9E3779B9u + static_cast<uint32_t>(plane);
  Pending& p = pending_[(hash ^ hash >> 16) % pending_count];
  if (p.pixel != pixel || p.plane != plane || p.group != group) {
    commit(p);
    p = {pixel, plane, group, dvec3(0.0)};
    film_.prefetch(unit_.layer, plane, group % 2, pixel);
  }
  p.sum += value;
}

void UnitSink::commit(Pending& p) {
  if (p.pixel < 0) return;
  film_.add(unit_.layer, p.plane, p.group % 2, p.pixel, p.sum);
  const BlockGrid& grid = film_.blocks();
  blocks_.add(film_.block_row(unit_.layer, p.plane, p.group), grid.block(p.pixel), grid.count(),
              luminance_of(p.sum));
}

void UnitSink::flush() {
  for (Pending& p : pending_) {
    commit(p);
    p.pixel = -1;
  }
}

void UnitSink::split(int plane, const PathTag& tag, int pixel, const dvec3& value) {
  for (const SplitKind kind : {SplitKind::length, SplitKind::strategy}) {
    if (!film_.splits(kind)) continue;
    film_.add_split(kind, Film::split_index(kind, tag), unit_.layer, plane, pixel, value);
  }
}

// The next number of this unit for picking pixels.
float UnitSink::filter_number() {
  const uint32_t at = numbers_used_ % 4;
  if (at == 0) {
    const auto round = static_cast<uint64_t>(unit_.round);
    const auto high = static_cast<uint32_t>(round >> 32) << 8;
    numbers_ = philox(unit_.seed, {numbers_used_ / 4, static_cast<uint32_t>(unit_.unit),
                                   static_cast<uint32_t>(round),
                                   static_cast<uint32_t>(RandomUse::filter) | high});
  }
  ++numbers_used_;
  return to_unit(numbers_[at]);
}

// Factor that brings the sample's whole camera value, of all tags, down to the limit.
float UnitSink::camera_clamp(const Splats& splats) const {
  Rgb sum(0.f);
  for (const Splat& s : splats.all()) {
    if (s.from_camera) sum += s.value;
  }
  const float largest = max_component(sum);
  return largest > unit_.clamp ? unit_.clamp / largest : 1.f;
}

}  // namespace pssmlt
