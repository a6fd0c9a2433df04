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
  for (const double v :
       {0.0, 1.0, -1.0, 0x1p-48, -0x1p-48, 0x1p40, -0x1p40, 0x1p14, -0x1p14, 0x1.fffffffffffffp13,
        1.0 + 0x1p-48, -1.0 - 0x1p-48, 0x1.8p-12, -65536.0, 65536.0 - 0x1p-30, 0x1.23456789p50}) {
    EXPECT_EQ(sum({v}), v) << v;
    EXPECT_EQ(sum({v, v}), 2.0 * v) << v;
    EXPECT_EQ(sum({v, -v}), 0.0) << v;
  }
}

TEST(FixedSum, RoundsToTheNearestQuantum) {
  EXPECT_EQ(sum({0x1.8p-49}), 0x1p-48);
  EXPECT_EQ(sum({0x1.8p-50}), 0.0);
  EXPECT_EQ(sum({-0x1.8p-49}), -0x1p-48);
}

TEST(FixedSum, CancelsExactly) {
  std::vector<double> values = values_of_all_sizes(1000);
  for (double& v : values) v = std::round(v * 0x1p48) * 0x1p-48;
  const size_t count = values.size();
  for (size_t i = 0; i < count; ++i) values.push_back(-values[i]);
  EXPECT_EQ(sum(values), 0.0);
}

TEST(FixedSum, DoesNotDependOnOrderOrGrouping) {
  std::vector<double> values = values_of_all_sizes(10'000);
  const double expected = sum(values);
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(values.begin(), values.end(), random);
    FixedSum first, second;
    for (size_t k = 0; k < values.size(); ++k)
      (k % 3 == 0 ? first : second).add(to_fixed(values[k]));
    EXPECT_EQ(sum(values), expected);
    first.add(second);
    EXPECT_EQ(first.value(), expected);
  }
}

TEST(FixedSum, ThreadsAddExactly) {
  const std::vector<double> values = values_of_all_sizes(20'000);
  uint64_t low = 0;
  int64_t high = 0;
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (size_t k = t; k < values.size(); k += 4) {
        add_fixed_atomic(low, high, to_fixed(values[k]));
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(to_double({high, low}), sum(values));
}

TEST(FixedSum, CutsWhatCannotBeHeld) {
  EXPECT_EQ(sum({INFINITY}), 0x1p60);
  EXPECT_EQ(sum({-INFINITY}), -0x1p60);
  EXPECT_EQ(sum({NAN}), 0.0);
}

}  // namespace
}  // namespace pssmlt
