// Bookkeeping of Markov chains in double: acceptance, credits, normalisation, against 80 bits.
#include "core/metropolis/advance.h"

#include <vector>

#include "tests/numerics/measured.h"

namespace pssmlt {
namespace {

using namespace test;

// One quotient; what is drawn against it has 64 bits, rounded to 53.
TEST(ChainNumerics, Acceptance) {
  RandomStream random(1, RandomUse::test);
  Worst ratio("Metropolis ratio, targets 2^-100 to 2^100", "U");
  Worst rest("1 - acceptance, absolute", "2 U");
  for (int i = 0; i < 1'000'000; ++i) {
    const double current = spread(random, 0x1p-100, 0x1p100);
    const double proposed = current * spread(random, 0x1p-30, 1.0);
    const double a = std::min(1.0, proposed / current);
    const long double exact =
        static_cast<long double>(proposed) / static_cast<long double>(current);
    ratio.add(relative(a, exact), double_unit * (1.0L + 0x1p-50L));
    rest.add(static_cast<long double>(1.0 - a) - (1.0L - exact), 2.0L * double_unit);
  }
  ratio.check();
  rest.check();
}

// Two quotients and, with Kelemen's weights, a sum of positive numbers.
TEST(ChainNumerics, CreditOfAVisit) {
  RandomStream random(2, RandomUse::test);
  Worst worst("credit of a visit, targets 2^-100 to 2^100", "3 U");
  for (int i = 0; i < 1'000'000; ++i) {
    const double beta = spread(random, 0x1p-100, 0x1p100);
    const double value = beta * spread(random, 0x1p-60, 0x1p60);
    const double large = i % 2 == 0 ? 0.0 : spread(random, 1e-6, 1.0);
    const CreditRule rule =
        large > 0.0 ? CreditRule::kelemen(beta, large) : CreditRule::expected(beta);
    const long double exact =
        1.0L / (static_cast<long double>(value) / static_cast<long double>(beta) +
                static_cast<long double>(large));
    worst.add(relative(rule.visit(value), exact), 3.0L * double_unit * (1.0L + 0x1p-40L));
  }
  worst.check();
}

// The weights that a state gathers before it is left: at most the mutations of a round, 1024.
TEST(ChainNumerics, GatheredCredit) {
  RandomStream random(3, RandomUse::test);
  Worst worst("credit gathered over 1024 mutations", "(1024 + 3) U");
  for (int trial = 0; trial < 2000; ++trial) {
    double sum = 0.0;
    long double exact = 0.0L;
    for (int i = 0; i < 1024; ++i) {
      const double a = static_cast<double>(random.next()), visit = spread(random, 1e-3, 1e3);
      sum += (1.0 - a) * visit;
      exact += (1.0L - static_cast<long double>(a)) * static_cast<long double>(visit);
    }
    worst.add(relative(sum, exact), 1027.0L * double_unit);
  }
  worst.check();
}

// Cheap pseudo-random doubles in [0.5, 1.5) with all 52 bits in use.
class Cheap {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return 0.5 + static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_ = 1;
};

// b: sums of rounds are merged into a unit's sum, those of units into the total: k + r + n
// additions one after the other for each value instead of k r n.
TEST(ChainNumerics, NormalisationOverLongRuns) {
  Worst mean("b of 10^6 to 2.6 10^8 large steps, as units and rounds add them", "(k + r + n) U");
  Worst flat("the same added one by one", "N U");
  Cheap cheap;
  constexpr int units = 64, in_a_round = 2048;
  for (const int rounds : {8, 2000}) {
    MeanTally one_by_one;
    std::vector<MeanTally> tallies(units);
    long double exact = 0.0L, squares = 0.0L;
    for (int round = 0; round < rounds; ++round) {
      for (MeanTally& unit : tallies) {
        MeanTally tally;
        for (int i = 0; i < in_a_round; ++i) {
          const double v = cheap.next();
          tally.add(v);
          one_by_one.add(v);
          exact += static_cast<long double>(v);
          squares += static_cast<long double>(v) * static_cast<long double>(v);
        }
        unit.merge(tally);
      }
    }
    MeanTally b;
    for (const MeanTally& unit : tallies) b.merge(unit);
    const auto n = static_cast<long double>(b.count);
    ASSERT_EQ(b.count, static_cast<uint64_t>(rounds) * units * in_a_round);
    mean.add(relative(b.mean(), exact / n), (units + rounds + in_a_round + 1.0L) * double_unit);
    flat.add(relative(one_by_one.mean(), exact / n), (n + 1.0L) * double_unit);
    const long double variance = (squares - exact * exact / n) / (n - 1.0L);
    // The difference cancels all but variance / mean square of the sums, 1/13 here.
    EXPECT_LE(std::abs(relative(b.standard_error(), std::sqrt(variance / n))),
              13.0L * (units + rounds + in_a_round + 3.0L) * double_unit);
  }
  mean.check();
  flat.check();
}

// A target that is constant has no variance: what rounding leaves of it stays below the bound.
TEST(ChainNumerics, ConstantTargetHasNoError) {
  for (const double value : {0x1p-100, 0.1, 1.0, 0x1p100}) {
    MeanTally tally;
    constexpr int count = 1'000'000;
    for (int i = 0; i < count; ++i) tally.add(value);
    EXPECT_LE(std::abs(relative(tally.mean(), value)), count * double_unit);
    const double worst = std::sqrt(2.0 * count * 0x1p-53) / std::sqrt(double{count});
    EXPECT_LE(tally.standard_error() / value, worst);
  }
}

}  // namespace
}  // namespace pssmlt
