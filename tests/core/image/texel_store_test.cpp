// The limit of the textures' memory holds, and texels are what they were.
#include "core/image/texel_store.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "core/base/random.h"
#include "tests/support/make_plugin.h"

namespace pssmlt {
namespace {

uint8_t value_of(size_t i) { return static_cast<uint8_t>((i * 2654435761u) >> 13); }

// Waits for what another thread does in the end; a minute is no measure of time but a way to fail.
bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(TexelStore, KeepsTheLimitAndTheTexels) {
  constexpr uint64_t limit = 4'000'000;
  constexpr size_t size = 5'000'000;
  const uint64_t before = texel_memory().total;
  set_texture_cache(limit);
  {
    std::vector<Texels<uint8_t>> images(5, Texels<uint8_t>(size));
    for (size_t k = 0; k < images.size(); ++k)
      for (size_t i = 0; i < size; ++i) images[k][i] = value_of(i + k);
    EXPECT_EQ(texel_memory().total, before + 5 * size);
    EXPECT_TRUE(comes_true([] { return texel_memory().resident <= limit; }));
    RandomStream random(1, RandomUse::test);
    for (int n = 0; n < 20'000; ++n) {
      const auto k = static_cast<size_t>(random.next() * 5.f);
      const auto i = static_cast<size_t>(random.next() * static_cast<float>(size - 1));
      ASSERT_EQ(images[k][i], value_of(i + k));
    }
    for (size_t k = 0; k < images.size(); ++k)
      for (size_t i = 0; i < size; ++i) ASSERT_EQ(images[k][i], value_of(i + k));
    EXPECT_TRUE(comes_true([] { return texel_memory().resident <= limit; }));
    // Freed out of order, and used again.
    images.erase(images.begin() + 1);
    images.emplace_back(size, uint8_t{7});
    EXPECT_TRUE(comes_true([] { return texel_memory().resident <= limit; }));
    for (const uint8_t v : images.back()) ASSERT_EQ(v, 7);
  }
  set_texture_cache(0);
  EXPECT_EQ(texel_memory().total, before);
}

TEST(TexelStore, WithoutALimitAllIsInMemory) {
  const Texels<float> texels(100'000, 1.f);
  const TexelMemory memory = texel_memory();
  EXPECT_EQ(memory.limit, 0u);
  EXPECT_GE(memory.total, 400'000u);
  EXPECT_EQ(memory.resident, memory.total);
}

TEST(TexelStore, AmountsOfMemory) {
  EXPECT_EQ(parse_bytes("4096"), 4096u);
  EXPECT_EQ(parse_bytes("1GB"), 1'000'000'000u);
  EXPECT_EQ(parse_bytes("1.5 GiB"), 1'610'612'736u);
  EXPECT_EQ(parse_bytes("64M"), 64'000'000u);
  EXPECT_EQ(parse_bytes("2kB"), 2000u);
  for (const char* wrong : {"", "GB", "1XB", "-1GB", "1GBs", "1iB", "nan", "1e30"})
    EXPECT_NE(test::error_of([&] { parse_bytes(wrong); }).find("no amount"), std::string::npos)
        << wrong;
}

}  // namespace
}  // namespace pssmlt
