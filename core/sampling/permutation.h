// Random permutations of 0 .. n-1 that need no table.
#pragma once

#include <cstdint>

namespace pssmlt {

// Where the permutation that `key` names takes i, 0 <= i < n (Kensler 2013, Correlated
// Multi-Jittered Sampling, section 3): a keyed bijection of the next power of two, walked until it
// falls below n.
inline uint32_t permute(uint32_t i, uint32_t n, uint32_t key) {
  uint32_t mask = n - 1;
  for (uint32_t shift = 1; shift < 32; shift *= 2) mask |= mask >> shift;
  do {
    i ^= key;
    i *= 0xE170893Du;
    i ^= key >> 16;
    i ^= (i & mask) >> 4;
    i ^= key >> 8;
    i *= 0x0929EB3Fu;
    i ^= key >> 23;
    i ^= (i & mask) >> 1;
    i *= 1u | key >> 27;
    i *= 0x6935FA69u;
    i ^= (i & mask) >> 11;
    i *= 0x74DCB303u;
    i ^= (i & mask) >> 2;
    i *= 0x9E501CC3u;
    i ^= (i & mask) >> 2;
    i *= 0xC860A3DFu;
    i &= mask;
    i ^= i >> 5;
  } while (i >= n);
  return (i + key) % n;
}

}  // namespace pssmlt
