// The numbers of a walk between the layers of a material, drawn once per hit: with them the
// material scatters deterministically.
#pragma once

#include <algorithm>
#include <array>

#include "core/material.h"
#include "core/sampling/primary_sample.h"

namespace pssmlt {

// What one event of a walk reads, all in (0, 1).
struct EventNumbers {
  vec2 direction{0.5f};
  float flight = 0.5f, choice = 0.5f;
};

class WalkNumbers {
 public:
  // Events for which there are numbers: two blocks a vertex of the shared stream.
  static constexpr int capacity = walk_vertices * blocks_per_vertex;

  // Reads the first `events` (at most `capacity`) of the vertex; all halves if it has no stream.
  WalkNumbers(const MaterialNumbers& m, int events) {
    for (auto& event : events_) event.fill(0x7FFF);
    if (!m.sample) return;
    for (int i = 0; i < std::min(events, capacity); ++i) {
      const int vertex = m.walk + i / blocks_per_vertex;
      set(i, m.sample->numbers(Stream::shared, vertex, i % blocks_per_vertex));
    }
  }
  EventNumbers operator[](int i) const {
    const auto& e = events_[static_cast<size_t>(i)];
    return {{unit(e[0]), unit(e[1])}, unit(e[2]), unit(e[3])};
  }

 private:
  void set(int event, Numbers n) {
    for (uint16_t& x : events_[static_cast<size_t>(event)]) {
      x = static_cast<uint16_t>(n.next() * 0x1p16f);
    }
  }
  static float unit(uint16_t x) { return (static_cast<float>(x) + 0.5f) * 0x1p-16f; }
  // 16 bits are enough for directions that are only walked, and many walks fit into a vertex.
  std::array<std::array<uint16_t, 4>, capacity> events_;
};

}  // namespace pssmlt
