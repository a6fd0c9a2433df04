#include "core/sampling/sobol.h"

#include <array>
#ifdef __SSSE3__
#include <tmmintrin.h>
#endif

namespace pssmlt {
namespace {

// Four numbers that the compiler keeps in one register (gcc and clang).
using Four = uint32_t __attribute__((vector_size(16)));

// Half a byte at a time by table, where the processor can; the same bits either way.
Four reverse_four(const Four& x) {
#ifdef __SSSE3__
  const __m128i mirrored = _mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
  const __m128i swap = _mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12);
  const __m128i half = _mm_set1_epi8(15);
  const __m128i v = _mm_shuffle_epi8(reinterpret_cast<__m128i>(x), swap);
  const __m128i low = _mm_shuffle_epi8(mirrored, _mm_and_si128(v, half));
  const __m128i high = _mm_shuffle_epi8(mirrored, _mm_and_si128(_mm_srli_epi16(v, 4), half));
  return reinterpret_cast<Four>(_mm_or_si128(_mm_slli_epi16(low, 4), high));
#else
  return reverse_bits(x);
#endif
}

// Primitive polynomials and initial direction numbers of dimensions 2 to 4 (Joe & Kuo 2008,
// new-joe-kuo-6.21201); the first dimension is the van der Corput sequence.
struct Direction {
  uint32_t degree, coefficients;
  std::array<uint32_t, 3> initial;
};
constexpr std::array<Direction, 3> directions = {
    {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};

// Column k of the generator matrix: what bit k of the index contributes.
constexpr std::array<uint32_t, 32> columns(const Direction& d) {
  std::array<uint32_t, 32> v{};
  for (uint32_t k = 0; k < 32; ++k) {
    if (k < d.degree) {
      v[k] = d.initial[k] << (31 - k);
      continue;
    }
    v[k] = v[k - d.degree] ^ (v[k - d.degree] >> d.degree);
    for (uint32_t j = 1; j < d.degree; ++j) {
      if (d.coefficients >> (d.degree - 1 - j) & 1u) v[k] ^= v[k - j];
    }
  }
  return v;
}

// What each byte of the bit-reversed index contributes to the four bit-reversed coordinates: 16 kB.
using ByteTable = std::array<std::array<Four, 256>, 4>;
ByteTable make_table() {
  ByteTable table{};
  for (uint32_t dimension = 0; dimension < 4; ++dimension) {
    std::array<uint32_t, 32> v{};  // by bit of the reversed index
    if (dimension > 0) v = columns(directions[dimension - 1]);
    for (uint32_t k = 0; k < 32; ++k) v[k] = dimension == 0 ? 1u << k : reverse_bits(v[k]);
    for (uint32_t bit = 0; bit < 32; ++bit) {
      for (uint32_t value = 0; value < 256; ++value) {
        if (value >> bit % 8 & 1u) table[bit / 8][value][dimension] ^= v[31 - bit];
      }
    }
  }
  return table;
}
const ByteTable byte_table = make_table();

// The four coordinates, bit-reversed, of the point with this bit-reversed index.
Four coordinates(uint32_t reversed_index) {
  return byte_table[0][reversed_index & 255u] ^ byte_table[1][reversed_index >> 8 & 255u] ^
         byte_table[2][reversed_index >> 16 & 255u] ^ byte_table[3][reversed_index >> 24];
}

// A scramble's seed for each coordinate: the steps of MurmurHash3's finaliser (Appleby 2011), which
// take all four at a time, on both halves of the key.
Four scramble_seeds(uint64_t key) {
  Four s = Four{0x9E3779B9u, 0x3C6EF372u, 0xDAA66D2Bu, 0x78DDE6E4u} ^ static_cast<uint32_t>(key);
  s = (s ^ s >> 16) * 0x85EBCA6Bu + static_cast<uint32_t>(key >> 32);
  s = (s ^ s >> 13) * 0xC2B2AE35u;
  return s ^ s >> 16;
}

NumberBlock as_block(const Four& x) { return {x[0], x[1], x[2], x[3]}; }

}  // namespace

NumberBlock sobol_block(uint64_t seed, uint64_t index, uint32_t block) {
  const uint64_t key = mix_bits(seed + (index >> 32) * 0xD1342543DE82EF95ull +
                                (block + 1ull) * 0x9E3779B97F4A7C15ull);
  // From the most to the least significant digit is from low to high in reversed numbers, where the
  // scramble flips each bit by those below it, as Owen's does by those above it. For the index
  // that is a shuffle within every aligned block of 2^k points.
  const uint32_t shuffled =
      scramble_upward(reverse_bits(static_cast<uint32_t>(index)), static_cast<uint32_t>(key));
  // The four coordinates in step: one instruction each for all of them.
  Four x = coordinates(shuffled);
  x = reverse_four(scramble_upward(x, scramble_seeds(key)));
  return as_block(x);
}

}  // namespace pssmlt
