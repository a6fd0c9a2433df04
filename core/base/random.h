// Counter-based random numbers (Salmon et al. 2011, Parallel Random Numbers: As Easy as 1, 2, 3):
// Philox4x32-10. The numbers are a pure function of key and counter, so that any of them can be
// replayed alone and threads share nothing.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/math.h"

namespace pssmlt {

using RandomBlock = std::array<uint32_t, 4>;

// Four independent uniform 32-bit numbers for (seed; counter).
inline RandomBlock philox(uint64_t seed, RandomBlock c) {
  uint32_t k0 = static_cast<uint32_t>(seed), k1 = static_cast<uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    const uint64_t p0 = uint64_t{0xD2511F53u} * c[0];
    const uint64_t p1 = uint64_t{0xCD9E8D57u} * c[2];
    c = {static_cast<uint32_t>(p1 >> 32) ^ c[1] ^ k0, static_cast<uint32_t>(p1),
         static_cast<uint32_t>(p0 >> 32) ^ c[3] ^ k1, static_cast<uint32_t>(p0)};
    k0 += 0x9E3779B9u;
    k1 += 0xBB67AE85u;
  }
  return c;
}

// What a random number is for; a word of every counter, so that no two uses share numbers.
enum class RandomUse : uint32_t {
  sample,
  bootstrap,
  resample,
  mutate,
  fresh,
  decide,
  accept,
  filter,
  auxiliary,
  test,
  mates,
  // A chain's second try in the same mutation.
  mutate_again,
  fresh_again,
  decide_again,
  mates_again
};

// 32-bit fixed point to float in [0, 1).
inline float to_unit(uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }
// 32-bit fixed point to double in [0, 1).
inline double to_unit_double(uint32_t x) { return static_cast<double>(x) * 0x1p-32; }

// SplitMix64's finaliser (Steele et al. 2014): a bijection that mixes all bits.
inline uint64_t mix_bits(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

// A sequential stream over philox, for setup code and tests.
class RandomStream {
 public:
  RandomStream(uint64_t seed, RandomUse use, uint32_t a = 0, uint32_t b = 0)
      : seed_(seed), counter_{0, a, b, static_cast<uint32_t>(use)} {}
  uint32_t bits() {
    if (left_ == 0) {
      block_ = philox(seed_, counter_);
      ++counter_[0];
      left_ = 4;
    }
    return block_[--left_];
  }
  float next() { return to_unit(bits()); }
  double next_double() {
    const uint64_t high = bits();
    const uint64_t low = bits();
    return static_cast<double>((high << 32 | low) >> 11) * 0x1p-53;
  }

 private:
  uint64_t seed_;
  RandomBlock counter_, block_{};
  int left_ = 0;
};

}  // namespace pssmlt
