#include "core/render/fixed_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>
#include <vector>

namespace pssmlt {
namespace {

std::vector<double> values_of_all_sizes(int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-50.0, 40.0), sign(-1.0, 1.0);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(std::copysign(std::exp2(exponent(random)), sign(random)));
  }
  return values;
}

double sum(const std::vector<double>& values) {
  FixedSum s;
  for (const double v : values) s.add(to_fixed(v));
  return s.value();
}

TEST(FixedSum, MultiplesOfTheQuantumAreExact) {
  for (const double v : {0.0, 1.0, -1.0, 0x1p-44, -0x1p-44, 0x1p40, -0x1p40, 1.0 + 0x1p-44,
                         -1.0 - 0x1p-44, 0x1.8p-12, 12345.6789e-3}) {
    const double quantised = std::round(v * 0x1p44) * 0x1p-44;
    FixedSum s;
    s.add(to_fixed(v));
    EXPECT_EQ(s.value(), quantised) << v;
  }
}

TEST(FixedSum, RoundsToTheNearestQuantum) {
  FixedSum s;
  s.add(to_fixed(0x1.8p-45));
  EXPECT_EQ(s.value(), 0x1p-44);
  FixedSum t;
  t.add(to_fixed(0x1.8p-46));
  EXPECT_EQ(t.value(), 0.0);
}

TEST(FixedSum, CancelsExactly) {
  FixedSum s;
  const std::vector<double> values = values_of_all_sizes(1000);
  for (const double v : values) s.add(to_fixed(std::round(v * 0x1p44) * 0x1p-44));
  for (const double v : values) s.add(to_fixed(-std::round(v * 0x1p44) * 0x1p-44));
  EXPECT_EQ(s.value(), 0.0);
}

TEST(FixedSum, DoesNotDependOnOrderOrFolding) {
  std::vector<double> values = values_of_all_sizes(10'000);
  const double expected = sum(values);
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(values.begin(), values.end(), random);
    FixedSum folded, first, second;
    for (size_t k = 0; k < values.size(); ++k) {
      folded.add(to_fixed(values[k]));
      (k % 3 == 0 ? first : second).add(to_fixed(values[k]));
      if (k % 7 == 0) folded.fold();
    }
    first.add(second);
    EXPECT_EQ(folded.value(), expected);
    EXPECT_EQ(first.value(), expected);
  }
}

TEST(FixedSum, ThreadsAddExactly) {
  const std::vector<double> values = values_of_all_sizes(20'000);
  FixedSum s;
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (size_t k = t; k < values.size(); k += 4) s.add_atomic(to_fixed(values[k]));
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(s.value(), sum(values));
}

TEST(FixedSum, CutsWhatCannotBeHeld) {
  EXPECT_EQ(sum({INFINITY}), 0x1p50);
  EXPECT_EQ(sum({-INFINITY}), -0x1p50);
  EXPECT_EQ(sum({NAN}), 0.0);
}

}  // namespace
}  // namespace pssmlt
