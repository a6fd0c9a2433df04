#include "core/metropolis/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"

namespace pssmlt {
namespace {

const std::vector<Kernel> kernels = {{KernelShape::kelemen, 1.0 / 64}, {KernelShape::kelemen, 1.0},
                                     {KernelShape::gaussian, 0.01},    {KernelShape::gaussian, 1.0},
                                     {KernelShape::cauchy, 0.01},      {KernelShape::cauchy, 1.0}};

// The sign bit turns a step into its reverse, from everywhere: for each way from x to y there is
// exactly one equally probable way back, and for fixed bits the map is a shift of the torus, which
// keeps the uniform distribution.
TEST(Kernels, AreExactlySymmetricShiftsOfTheTorus) {
  RandomStream random(1, RandomUse::test);
  for (const Kernel& kernel : kernels) {
    for (int i = 0; i < 20000; ++i) {
      const uint32_t x = random.bits(), y = random.bits(), bits = random.bits();
      const uint32_t there = kernel.step(x, bits);
      EXPECT_EQ(kernel.step(there, bits ^ 0x80000000u), x);
      EXPECT_EQ(kernel.step(y, bits) - y, there - x);
    }
  }
}

// Distances at the quantiles of an even grid of random bits.
double quantile(const Kernel& kernel, double q) {
  const auto bits = static_cast<uint32_t>(q * 0x1p31);
  return kernel.step(0, bits) * 0x1p-32;
}

TEST(Kernels, KelemenIsLogUniformBetweenItsScales) {
  const Kernel kernel(KernelShape::kelemen, 1.0 / 64);
  for (const double q : {0.0, 0.25, 0.5, 0.9, 0.9999}) {
    const double expected = 1.0 / 64 * std::exp(-std::log(16.0) * q);
    EXPECT_NEAR(quantile(kernel, q), expected, 1e-5 * expected + 1e-9);
  }
}

TEST(Kernels, GaussianHasNormalQuantiles) {
  const Kernel kernel(KernelShape::gaussian, 0.01);
  EXPECT_NEAR(quantile(kernel, 0.6826894921), 0.01, 1e-7);
  EXPECT_NEAR(quantile(kernel, 0.9544997361), 0.02, 1e-7);
  EXPECT_NEAR(quantile(kernel, 0.9973002039), 0.03, 1e-6);
  EXPECT_NEAR(quantile(kernel, 0.9999366575), 0.04, 1e-5);
}

TEST(Kernels, CauchyHasCauchyQuantilesAndWraps) {
  const Kernel kernel(KernelShape::cauchy, 0.01);
  EXPECT_NEAR(quantile(kernel, 0.5), 0.01, 1e-7);
  EXPECT_NEAR(quantile(kernel, 0.75), 0.024142136, 1e-6);
  // tan is 1591.5 at 1 - 2e-4 / pi... : far beyond once around.
  const double far = 0.01 * std::tan(0.5 * std::numbers::pi * 0.9996);
  EXPECT_GT(far, 10.0);
  EXPECT_NEAR(quantile(kernel, 0.9996), far - std::floor(far), 0.02);
}

}  // namespace
}  // namespace pssmlt
