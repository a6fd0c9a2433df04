#include "core/sampling/sobol.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "core/sampling/permutation.h"
#include "tests/support/statistics.h"

namespace pssmlt {
namespace {

// Cell of a number when [0,1) is cut into 2^bits cells.
uint32_t cell(uint32_t x, int bits) { return bits == 0 ? 0 : x >> (32 - bits); }

// Points are part of every picture: compilers and processors that shuffle bytes or do not, agree.
TEST(Sobol, BitsAreTheSameEverywhere) {
  EXPECT_EQ(sobol_block(0, 0, 0), (NumberBlock{0x40DD9ABF, 0x9E798486, 0x9B1A13B0, 0xE7333738}));
  EXPECT_EQ(sobol_block(7, 12345, 3),
            (NumberBlock{0x27D16ED4, 0x15734101, 0xCD825317, 0x586104FB}));
  EXPECT_EQ(sobol_block(0x123456789ABCDEF, (1ull << 33) + 5, 40),
            (NumberBlock{0x6E33029E, 0x13D73A23, 0xA568684C, 0x3790B9E7}));
}

// The first 2^k points put one point into every elementary interval of the first two dimensions,
// and so does every aligned block of 2^k points.
TEST(Sobol, FillsElementaryIntervals) {
  constexpr int k = 8;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    for (uint64_t block : {0, 1, 5}) {
      for (int across = 0; across <= k; ++across) {
        std::set<std::pair<uint32_t, uint32_t>> met;
        for (uint64_t i = block << k; i < (block + 1) << k; ++i) {
          const NumberBlock x = sobol_block(seed, i, 3);
          met.insert({cell(x[0], across), cell(x[1], k - across)});
        }
        EXPECT_EQ(met.size(), 1u << k);
      }
    }
  }
}

TEST(Sobol, StratifiesEveryDimension) {
  constexpr int k = 10;
  for (uint32_t block = 0; block < 6; ++block) {
    for (size_t dimension = 0; dimension < 4; ++dimension) {
      std::set<uint32_t> met;
      for (uint64_t i = 0; i < 1u << k; ++i) {
        met.insert(cell(sobol_block(42, i, block)[dimension], k));
      }
      EXPECT_EQ(met.size(), 1u << k);
    }
  }
}

// A (t, 4)-net: t of these four dimensions is small enough that every 2^6 points fill all 2^4 cells
// of a 2 x 2 x 2 x 2 grid evenly.
TEST(Sobol, StratifiesFourDimensionsTogether) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<int> counts(16, 0);
    for (uint64_t i = 0; i < 256; ++i) {
      const NumberBlock x = sobol_block(seed, i, 0);
      size_t at = 0;
      for (size_t d = 0; d < 4; ++d) at = 2 * at + cell(x[d], 1);
      ++counts[at];
    }
    for (const int count : counts) EXPECT_EQ(count, 16);
  }
}

// Over seeds each single point is uniform, and two blocks are independent. False alarm 1e-7 each.
TEST(Sobol, IsUniformOverSeeds) {
  constexpr int seeds = 40000;
  for (const uint64_t index : {uint64_t{0}, uint64_t{1}, uint64_t{1000}, uint64_t{1} << 33}) {
    std::vector<int> pairs(256, 0), blocks(256, 0), steps(256, 0);
    for (uint64_t seed = 0; seed < seeds; ++seed) {
      const uint64_t key = mix_bits(seed + 1);
      const NumberBlock x = sobol_block(key, index, 0);
      const NumberBlock y = sobol_block(key, index, 1);
      const NumberBlock other = sobol_block(key, index + (uint64_t{1} << 32), 0);
      ++pairs[cell(x[0], 4) * 16 + cell(x[3], 4)];
      ++blocks[cell(x[1], 4) * 16 + cell(y[1], 4)];
      ++steps[cell(x[2], 4) * 16 + cell(other[2], 4)];
    }
    const std::vector<double> expected(256, seeds / 256.0);
    EXPECT_GT(test::chi_square_p(pairs, expected), test::false_alarm);
    EXPECT_GT(test::chi_square_p(blocks, expected), test::false_alarm);
    EXPECT_GT(test::chi_square_p(steps, expected), test::false_alarm);
  }
}

// The variance of the mean of a smooth function falls much faster than 1 / n: 256 points are better
// than 64 by at least 16 (independent points: 4, here about 30), far beyond chance over 2000 seeds.
TEST(Sobol, ConvergesFasterThanIndependentPoints) {
  const auto variance = [](uint64_t points) {
    double sum = 0.0;
    constexpr int seeds = 2000;
    for (uint64_t seed = 0; seed < seeds; ++seed) {
      double mean = 0.0;
      for (uint64_t i = 0; i < points; ++i) {
        const NumberBlock x = sobol_block(mix_bits(seed + 77), i, 0);
        double product = 1.0;
        for (size_t d = 0; d < 4; ++d) product *= 0.5 + to_unit_double(x[d]);
        mean += product;
      }
      sum +=
          (mean / static_cast<double>(points) - 1.0) * (mean / static_cast<double>(points) - 1.0);
    }
    return sum / seeds;
  };
  const double at64 = variance(64), at256 = variance(256);
  EXPECT_LT(at64, 0.1 * ((13.0 / 12) * (13.0 / 12) * (13.0 / 12) * (13.0 / 12) - 1.0) / 64);
  EXPECT_LT(at256, at64 / 10.0);
}

TEST(Permutation, IsOneAndReachesAll) {
  for (const uint32_t n : {1u, 2u, 7u, 16u, 100u}) {
    for (uint32_t key = 0; key < 50; ++key) {
      std::set<uint32_t> met;
      for (uint32_t i = 0; i < n; ++i) met.insert(permute(i, n, key * 2654435761u));
      EXPECT_EQ(met.size(), n);
      EXPECT_LT(*met.rbegin(), n);
    }
  }
}

}  // namespace
}  // namespace pssmlt
