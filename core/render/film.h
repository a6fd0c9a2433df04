// The film: sums of splats per pixel that do not depend on the order of addition, kept apart by
// layer, sampler plane and half (groups of even and of odd number), sums of luminance per group
// over blocks of pixels for the error estimate, and on request sums by path length or strategy.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "core/render/fixed_sum.h"
#include "core/sampler.h"

namespace pssmlt {

// The windows of pixels over which luminances are summed per group: 16 x 16 pixels, more on images
// that would have over 1024 blocks.
class BlockGrid {
 public:
  explicit BlockGrid(const ivec2& size);
  int count() const { return across_ * down_; }
  int edge() const { return edge_; }
  // A division costs less than a table that drops out of the caches.
  int block(int pixel) const {
    const uint32_t y = static_cast<uint32_t>(pixel) / width_;
    const uint32_t x = static_cast<uint32_t>(pixel) - y * width_;
    return static_cast<int>((y >> shift_) * static_cast<uint32_t>(across_) + (x >> shift_));
  }

 private:
  uint32_t width_ = 1;
  int shift_ = 4, edge_ = 16, across_ = 1, down_ = 1;
};

// Which sums by path are kept beside the picture.
enum class SplitKind : uint8_t { length, strategy };
inline constexpr int split_kinds = 2;
inline constexpr int split_edge = 64;  // lengths and subpaths of 63 and more share an image

struct FilmSettings {
  ivec2 size{1, 1};         // rendered window [pixels]
  std::vector<int> planes;  // per layer
  std::array<bool, split_kinds> split{};
};

// One thread's private block sums, merged into the film's after each round.
class BlockSums {
 public:
  void add(int row, int block, int blocks, double luminance) {
    auto& sums = rows_[static_cast<size_t>(row)];
    if (sums.empty()) sums.resize(static_cast<size_t>(blocks));
    sums[static_cast<size_t>(block)].add(to_fixed(luminance));
  }

 private:
  friend class Film;
  std::vector<std::vector<FixedSum>> rows_;  // empty until first used
};

class Film {
 public:
  explicit Film(FilmSettings settings);
  const FilmSettings& settings() const { return settings_; }
  int pixels() const { return settings_.size.x * settings_.size.y; }
  int layers() const { return static_cast<int>(settings_.planes.size()); }
  int planes(int layer) const { return settings_.planes[static_cast<size_t>(layer)]; }
  const BlockGrid& blocks() const { return grid_; }

  // From any thread. Memory for a plane is made when a value first reaches it.
  void add(int layer, int plane, int half, int pixel, const dvec3& value);
  void add_split(SplitKind kind, int index, int layer, int plane, int pixel, const dvec3& value);
  // Asks for the pixel's memory ahead of add(): light splats meet the caches nowhere else.
  void prefetch(int layer, int plane, int half, int pixel) const;
  bool splits(SplitKind kind) const { return settings_.split[static_cast<size_t>(kind)]; }
  static int split_index(SplitKind kind, const PathTag& tag);
  int block_row(int layer, int plane, int group) const {
    return (first_plane_[static_cast<size_t>(layer)] + plane) * group_count + group;
  }
  BlockSums make_block_sums() const;

  // After a round, from one thread: takes over the threads' block sums and clears them.
  void end_round(const std::vector<BlockSums*>& threads);

  // Sum of a pixel, 0 where nothing has landed.
  dvec3 value(int layer, int plane, int half, int pixel) const;
  bool used(int layer, int plane, int half) const;
  dvec3 split_value(SplitKind kind, int index, int layer, int plane, int pixel) const;
  // Indices that something has landed on, ascending.
  std::vector<int> split_indices(SplitKind kind) const;
  // Sum of luminances of a block for one group.
  double block_sum(int layer, int plane, int group, int block) const;

  uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }
  void save(Archive& archive) const;
  // Throws Error if the archive does not fit these settings.
  void load(Archive& archive);

 private:
  // Words of three channels a pixel, low and high apart: the high ones are hardly ever touched, so
  // that half the memory stays out of the caches.
  struct Pixels {
    explicit Pixels(size_t count) : low(3 * count), high(3 * count) {}
    dvec3 value(int pixel) const;
    std::vector<uint64_t> low;
    std::vector<int64_t> high;
  };
  // Made by the first thread that needs it.
  class Slot {
   public:
    const Pixels* get() const { return pixels_.load(std::memory_order_acquire); }
    Pixels* get() { return pixels_.load(std::memory_order_acquire); }
    Pixels& make(Film& film);

   private:
    std::unique_ptr<Pixels> owner_;
    std::atomic<Pixels*> pixels_{nullptr};
  };
  size_t slot(int layer, int plane, int half) const;
  size_t split_slot(SplitKind kind, int index, int layer, int plane) const;
  static void add_to(Pixels& pixels, int pixel, const dvec3& value);
  static void save_slots(Archive& archive, const std::vector<Slot>& slots);
  void load_slots(Archive& archive, std::vector<Slot>& slots);

  FilmSettings settings_;
  BlockGrid grid_;
  std::vector<int> first_plane_;  // number of planes in the layers before
  int plane_count_ = 0;
  std::vector<Slot> slots_;
  std::array<std::vector<Slot>, split_kinds> split_slots_;
  std::vector<std::vector<FixedSum>> block_rows_;
  std::atomic<uint64_t> bytes_{0};
  std::mutex making_;
};

// Where one unit of work sends its splats. Lives on the unit's thread; what it collects reaches the
// film at the latest when flush() is called. All that it does is a pure function of the unit.
class UnitSink final : public SplatSink {
 public:
  struct Unit {
    int layer = 0;
    uint64_t seed = 0;  // of the layer
    int64_t round = 0;
    int unit = 0;
    float clamp = infinity;  // largest component of one sample's value; infinity: none
    double factor = 1.0;     // what the film holds of a value: a power of two near its range
  };
  UnitSink(Film& film, BlockSums& blocks, const RasterMap& map, const Unit& unit)
      : film_(film),
        blocks_(blocks),
        map_(map),
        unit_(unit),
        splits_(film.splits(SplitKind::length) || film.splits(SplitKind::strategy)) {}
  void add(int plane, const Splats& splats, const PixelCredit& camera, double weight,
           int group) override;
  void flush();

 private:
  // Sums that are still on the way to a pixel: successive splats often meet the same one.
  struct Pending {
    int pixel = -1, plane = 0, group = 0;
    dvec3 sum{0.0};
  };
  static constexpr size_t pending_count = 64;
  void deposit(int plane, int group, int pixel, const dvec3& value);
  void commit(Pending& p);
  void split(int plane, const PathTag& tag, int pixel, const dvec3& value);
  float filter_number();
  float camera_clamp(const Splats& splats) const;

  Film& film_;
  BlockSums& blocks_;
  const RasterMap& map_;
  Unit unit_;
  bool splits_;  // sums by path are kept
  std::array<Pending, pending_count> pending_{};
  RandomBlock numbers_{};
  uint32_t numbers_used_ = 0;
};

}  // namespace pssmlt
