// A point u of primary sample space [0,1)^n, n unbounded: what an integrator consumes.
//
// Numbers have addresses: (stream, vertex, block), four numbers each. A vertex's numbers therefore
// mean the same whatever happened at the vertices before it, which is what lets a Markov chain
// change one vertex of a path without scrambling the rest.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/random.h"

namespace pssmlt {

enum class Stream : uint8_t {
  camera,      // camera subpath; vertex 0 is the camera: raster pair, then lens
  light,       // light subpath; vertex 0 is the light
  connection,  // next event estimation (block 0) and lens connections (block 1), by vertex
  shared       // what belongs to both ends (time, wavelength)
};
inline constexpr int stream_count = 4;
// Blocks a vertex has in its stream: 0 scattering (direction u, direction v, lobe, roulette),
// 1 surface (material first, material second, alpha, spare).
inline constexpr int blocks_per_vertex = 2;

// Four numbers as 32-bit fixed point: the torus is integer overflow.
using NumberBlock = RandomBlock;

// Cursor over a block's four numbers. Holds a copy: it outlives what is read after it.
class Numbers {
 public:
  explicit Numbers(const NumberBlock& block) : block_(block) {}
  // The next number in [0, 1). At most four a block.
  float next() { return to_unit(block_[at_++ & 3]); }
  // The same with all its 32 bits, for choices among very many.
  double next_double() { return to_unit_double(block_[at_++ & 3]); }
  vec2 next2() {
    const float x = next();
    const float y = next();
    return {x, y};
  }

 private:
  NumberBlock block_;
  uint32_t at_ = 0;
};

// Where numbers come from when they are first read: a sampler's generator.
class NumberSource {
 public:
  // Fills the block at (stream, index), index = vertex * blocks_per_vertex + block.
  virtual void fill(Stream stream, uint32_t index, NumberBlock& block) = 0;

 protected:
  ~NumberSource() = default;
};

// The blocks of one stream that have been read, with their values.
class StreamNumbers {
 public:
  // The block if it has been read (or restored) since the last clear, else null.
  const NumberBlock* find(uint32_t index) const {
    return index < stamps_.size() && stamps_[index] == stamp_ ? &blocks_[index] : nullptr;
  }
  // Adds a block; the reference is valid until the next add.
  NumberBlock& add(uint32_t index) {
    if (index >= stamps_.size()) grow(index);
    if (index >= end_) end_ = index + 1;
    stamps_[index] = stamp_;
    return blocks_[index];
  }
  void clear() {
    end_ = 0;
    if (++stamp_ == 0) restart();
  }
  // One past the highest block that was read.
  uint32_t end() const { return end_; }

 private:
  void grow(uint32_t index);
  void restart();
  std::vector<NumberBlock> blocks_;
  std::vector<uint32_t> stamps_;
  uint32_t stamp_ = 1, end_ = 0;
};

// Identity of a stream's numbers, for integrators that keep subpaths: `now` names the numbers of
// this evaluation, `keep` those of the chain's current state. A subpath stored under either may be
// reused; one stored under another version may be overwritten. Versions are unique per thread.
struct StreamVersion {
  uint64_t now = 0, keep = 0;
};

class PrimarySample {
 public:
  // The four numbers of a vertex's block; filled from the source at the first read.
  Numbers numbers(Stream stream, int vertex, int block = 0) {
    const auto s = static_cast<size_t>(stream);
    const auto index = static_cast<uint32_t>(vertex * blocks_per_vertex + block);
    if (const NumberBlock* found = streams_[s]->find(index)) return Numbers(*found);
    NumberBlock& fresh = streams_[s]->add(index);
    source_->fill(stream, index, fresh);
    return Numbers(fresh);
  }
  // Raster position [pixels] of the camera subpath; counts as a read of the camera's first block.
  dvec2 raster() {
    if (!raster_known_) find_raster();
    return raster_;
  }
  // Identity of what the stream holds; the shared stream is part of every stream's identity.
  StreamVersion version(Stream stream) const { return versions_[static_cast<size_t>(stream)]; }
  // False if nobody asked for the raster position of this point: it has no pixel then.
  bool raster_known() const { return raster_known_; }
  // What a stream holds: the numbers read so far, and for chains those that its state kept.
  const StreamNumbers& held(Stream stream) const { return *streams_[static_cast<size_t>(stream)]; }

 private:
  friend class PrimarySampleOwner;
  void find_raster();
  std::array<StreamNumbers*, stream_count> streams_{};
  NumberSource* source_ = nullptr;
  const class RasterMap* raster_map_ = nullptr;
  std::array<StreamVersion, stream_count> versions_{};
  dvec2 raster_{0.0};
  int fixed_pixel_ = -1;       // the pixel that the raster pair may not leave; -1: none
  int raster_pixel_ = -1;      // index in the window, row major
  float raster_weight_ = 0.f;  // sign(f) * integral |f| / integral f of the filter
  bool raster_known_ = false;
};

}  // namespace pssmlt
