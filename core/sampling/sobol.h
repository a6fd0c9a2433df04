// Owen-scrambled Sobol' points in any number of dimensions, four at a time (Burley 2020, Practical
// Hash-based Owen Scrambling): each block of four dimensions is a Sobol' sequence of its own, whose
// index is shuffled and whose coordinates are scrambled by nested uniform permutations that a hash
// makes up. Within a block every prefix of 2^k points is a (0,k,2)-net in the first two dimensions;
// blocks are independent of one another.
#pragma once

#include <type_traits>

#include "core/sampling/primary_sample.h"

namespace pssmlt {

// Nested uniform scrambling from the lowest bit up: bit i is flipped by a hash of the bits below.
// (Laine & Karras 2011 with constants of N. Vegdahl, "Building a Better LK Hash", 2021.)
// `Word` is uint32_t or a vector of them.
template <typename Word>
Word scramble_upward(Word x, Word seed) {
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return x;
}

template <typename Word>
Word reverse_bits(Word x) {
  if constexpr (std::is_same_v<Word, uint32_t>) {
    x = __builtin_bswap32(x);
  } else {
    x = x >> 16 | x << 16;
    x = (x >> 8 & 0x00FF00FFu) | (x & 0x00FF00FFu) << 8;
  }
  x = (x >> 4 & 0x0F0F0F0Fu) | (x & 0x0F0F0F0Fu) << 4;
  x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
  return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

// Block `block` of point `index` of the sequence that `seed` scrambles. Sequences of different
// seeds and blocks of one sequence are independent. Beyond 2^32 points a new scramble starts.
NumberBlock sobol_block(uint64_t seed, uint64_t index, uint32_t block);

}  // namespace pssmlt
