// Sweeps over the picture by Owen-scrambled Sobol' points.
//
// Even and odd sweeps have scrambles of their own, so that the two half images are independent and
// their difference tells the error. Many scrambles would give up most of the gain: at 64 samples 32
// of them cost a factor 6 in variance on a quarter disk and 100 on a smooth function, two 1.5
// and 4.
#pragma once

#include "core/sampling/memoryless.h"
#include "core/sampling/sobol.h"

namespace pssmlt {

class SobolSweeps : public MemorylessSampler {
 protected:
  using MemorylessSampler::MemorylessSampler;

  void fill(const SampleId& id, Stream stream, uint32_t index, NumberBlock& block) const final {
    const uint64_t name = (static_cast<uint64_t>(stream) * 2 + id.half()) | id.turn << 3;
    if (stream == Stream::light) {
      const uint64_t sequence = uint64_t{id.part} << 8 | name;
      block =
          sobol_block(seed() + mix_bits(sequence + 1), id.nth * id.part_pixels + id.place, index);
      return;
    }
    const uint64_t sequence = (uint64_t{id.pixel} << 8 | name) + 1;
    block = sobol_block(seed() + mix_bits(sequence * 0x9E3779B97F4A7C15ull), id.nth, index);
  }
};

}  // namespace pssmlt
