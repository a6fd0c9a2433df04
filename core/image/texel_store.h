// Memory of texels. Ordinarily that is the program's; with a limit set, large images lie in a
// temporary file that is mapped into memory, and what was not asked for lately is given back to the
// file whenever more than the limit is in memory. Reading a texel is reading memory either way: no
// lock, no table, and the same values whatever the limit.
//
// While an image is loaded and decoded it is in memory as a whole, whatever the limit; between two
// checks, a few milliseconds, lookups may bring more than the limit back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

namespace pssmlt {

// Sets the limit [bytes] for all texels allocated from now on; 0: none. Throws Error if the folder
// for temporary files (TMPDIR, else /tmp) lies in memory itself.
void set_texture_cache(uint64_t bytes);

struct TexelMemory {
  uint64_t total = 0;     // of all texels [bytes]
  uint64_t resident = 0;  // in memory now [bytes]; without a limit all
  uint64_t limit = 0;     // 0: none
};
// Gives back first what is above the limit.
TexelMemory texel_memory();

// "1GB", "1.5 GiB", "64MB", "4096": bytes; k, M, G, T stand for powers of 1000, with an i for
// powers of 1024. Throws Error.
uint64_t parse_bytes(const std::string& text);

// Throws Failure if the temporary file cannot hold that much.
void* allocate_texels(size_t bytes);
void free_texels(void* texels, size_t bytes);

template <typename T>
struct TexelAllocator {
  using value_type = T;
  TexelAllocator() = default;
  template <typename U>
  explicit TexelAllocator(const TexelAllocator<U>&) {}
  T* allocate(size_t n) { return static_cast<T*>(allocate_texels(n * sizeof(T))); }
  void deallocate(T* p, size_t n) { free_texels(p, n * sizeof(T)); }
  friend bool operator==(const TexelAllocator&, const TexelAllocator&) { return true; }
};
template <typename T>
using Texels = std::vector<T, TexelAllocator<T>>;

}  // namespace pssmlt
