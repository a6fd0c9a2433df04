// Four floats that the same instructions work on: arithmetic, comparisons and ?: go lane by lane
// (the vector extension that GCC and Clang share).
#pragma once

#include <cmath>
#include <cstdint>

namespace pssmlt {

using Four = float __attribute__((vector_size(16)));
using FourBits = uint32_t __attribute__((vector_size(16)));

inline Four four(float x) { return Four{x, x, x, x}; }
inline Four larger(Four a, Four b) { return a > b ? a : b; }
inline Four smaller(Four a, Four b) { return a < b ? a : b; }
inline Four magnitude(Four a) { return larger(a, -a); }
// Of what is not negative.
inline Four root(Four a) {
  return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

}  // namespace pssmlt
