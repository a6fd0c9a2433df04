// The Metropolis machinery on a density in closed form whose dimension depends on the point. Chains
// start exactly in equilibrium (by rejection sampling), so any number of steps must leave the
// distribution as it is.
#include "core/metropolis/walker.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/metropolis/advance.h"
#include "core/metropolis/candidate_source.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using test::chi_square_p;
using test::chi_square_tail;
using test::false_alarm;
using test::z_limit;

struct Visit {
  double value = 0.0;
  size_t bin = 0;
};

constexpr size_t bins = 18;
constexpr double largest = 4.0;

size_t part(float u, size_t count) { return static_cast<size_t>(u * static_cast<float>(count)); }

// x below 0.5 reads one more number of the camera's next vertex, x in [0.5, 0.8) one of the light's
// third vertex, the rest one of each of two streams.
Visit target(PrimarySample& u) {
  const auto x = static_cast<float>(u.raster().x);
  if (x < 0.5f) {
    const float y = u.numbers(Stream::camera, 1).next();
    return {1.0 + 2.0 * y, (x < 0.25f ? 0 : 4) + part(y, 4)};
  }
  if (x < 0.8f) {
    const float z = u.numbers(Stream::light, 2, 1).next();
    return {z < 0.25f ? 0.0 : 4.0 * z * z, 8 + part(z, 4)};
  }
  const float y = u.numbers(Stream::camera, 1).next();
  const float w = u.numbers(Stream::connection, 1).next();
  const size_t upper = x < 0.9f ? 0 : 1;
  return {2.0 * y * w, 12 + 2 * part(y, 2) + part(w, 2) + (upper && y >= 0.5f ? 2 : 0)};
}

// Integral of the target over each bin.
std::vector<double> masses() {
  std::vector<double> m(bins, 0.0);
  for (size_t i = 0; i < 4; ++i) {
    const double a = 0.25 * static_cast<double>(i), b = a + 0.25;
    m[i] = m[i + 4] = 0.25 * (b + b * b - a - a * a);
    m[i + 8] = i == 0 ? 0.0 : 0.3 * 4.0 / 3.0 * (b * b * b - a * a * a);
  }
  const double half[2] = {0.125, 0.375};  // integral of y over each half
  for (size_t y = 0; y < 2; ++y) {
    for (size_t w = 0; w < 2; ++w) {
      const double mass = 0.1 * 2.0 * half[y] * half[w];
      m[12 + 2 * y + w] += mass;
      m[12 + 2 * y + w + (y == 1 ? 2 : 0)] += mass;
    }
  }
  return m;
}

double integral() {
  double b = 0.0;
  for (const double m : masses()) b += m;
  return b;
}

struct Case {
  const char* name;
  StepMix mix;
  KernelShape shape;
  double scale;
  bool second_tries = false;
};
const std::vector<Case> cases = {
    {"default", {0.3, 0.1, 0.2, 0.0}, KernelShape::kelemen, 1.0 / 64},
    {"no large steps", {0.0, 0.0, 0.0, 0.0}, KernelShape::gaussian, 0.2},
    {"single streams", {0.1, 0.1, 0.9, 0.0}, KernelShape::cauchy, 0.1},
    {"film", {0.0, 1.0, 0.0, 0.0}, KernelShape::gaussian, 0.3},
    {"ranges", {0.05, 0.0, 0.0, 1.0}, KernelShape::gaussian, 0.3},
    {"delayed rejection", {0.5, 0.1, 0.2, 0.0}, KernelShape::gaussian, 0.2, true},
    {"delayed rejection alone", {1.0, 0.0, 0.0, 0.0}, KernelShape::gaussian, 0.3, true},
    {"ensemble", {0.1, 0.1, 0.0, 0.0, 0.8}, KernelShape::gaussian, 0.2},
    {"ensemble and delayed rejection", {0.4, 0.0, 0.0, 0.0, 0.9}, KernelShape::gaussian, 0.2, true},
};
constexpr unsigned used_streams = 0b111;

class Machine {
 public:
  explicit Machine(const Case& example, uint64_t seed = 7)
      : chooser_(example.mix, used_streams, true),
        owner_(map_),
        walker_(settings_, chooser_, owner_) {
    settings_.seed = seed;
    settings_.film_x = settings_.film_y = Kernel(example.shape, example.scale);
    settings_.kernels = for_all_kinds(settings_.film_x);
    settings_.second_tries = example.second_tries;
    walker_.set_mates(mates_);
  }
  // A chain that starts exactly in equilibrium, and so do those whose states it uses.
  Visit start_among(uint32_t chain) {
    for (uint32_t i = 0; i < 2; ++i) {
      start(others + 2 * chain + i);
      store_numbers(owner_, states_[i]);
    }
    return start(chain);
  }
  Visit start(uint32_t chain) {
    for (uint32_t attempt = 0;; ++attempt) {
      CandidateSource source(settings_.seed, chain << 8 | attempt);
      owner_.begin(source);
      const Visit visit = target(owner_.sample());
      RandomStream random(settings_.seed, RandomUse::test, chain, attempt);
      if (random.next_double() * largest >= visit.value) continue;
      StoredNumbers numbers;
      store_numbers(owner_, numbers);
      walker_.load(chain, 0, numbers, true, visit.value);
      return visit;
    }
  }
  Visit step(const Visit& current) {
    walker_.propose();
    const Visit proposed = target(owner_.sample());
    if (walker_.decide(proposed.value).accepted) return proposed;
    if (!walker_.tries_again()) return current;
    walker_.propose_again();
    const Visit second = target(owner_.sample());
    return walker_.decide_again(second.value).accepted ? second : current;
  }
  Walker& walker() { return walker_; }
  PrimarySampleOwner& owner() { return owner_; }

 private:
  static constexpr uint32_t others = 1u << 22;  // numbers of chains that are not looked at
  StoredNumbers states_[2];
  const StoredNumbers* mates_[2] = {&states_[0], &states_[1]};
  RasterMap map_ = test::box_map(1, 1);
  WalkSettings settings_;
  StepChooser chooser_;
  PrimarySampleOwner owner_;
  Walker walker_;
};

// False alarm: 1e-8 for each of 9 x 3 tests.
TEST(Walker, IsStationaryFromTheFirstStep) {
  const std::vector<double> mass = masses();
  for (const Case& example : cases) {
    Machine machine(example);
    for (const int steps : {1, 4, 16}) {
      constexpr uint32_t chains = 40000;
      std::vector<int> counts(bins, 0);
      for (uint32_t c = 0; c < chains; ++c) {
        Visit visit = machine.start_among(c);
        for (int s = 0; s < steps; ++s) visit = machine.step(visit);
        ++counts[visit.bin];
      }
      std::vector<double> expected;
      for (const double m : mass) expected.push_back(chains * m / integral());
      EXPECT_GT(chi_square_p(counts, expected), 0.1 * false_alarm) << example.name << ", " << steps;
    }
  }
}

// In equilibrium as many chains go from i to j as from j to i. False alarm: 1e-8 a case.
TEST(Walker, IsInDetailedBalance) {
  for (const Case& example : cases) {
    Machine machine(example, 11);
    std::vector<double> flow(bins * bins, 0.0);
    for (uint32_t c = 0; c < 150000; ++c) {
      const Visit from = machine.start_among(c);
      const Visit to = machine.step(from);
      flow[from.bin * bins + to.bin] += 1.0;
    }
    double x = 0.0;
    int pairs = 0;
    for (size_t i = 0; i < bins; ++i) {
      for (size_t j = 0; j < i; ++j) {
        const double there = flow[i * bins + j], back = flow[j * bins + i];
        if (there + back < 20.0) continue;
        x += (there - back) * (there - back) / (there + back);
        ++pairs;
      }
    }
    EXPECT_GT(pairs, 10) << example.name;
    EXPECT_GT(chi_square_tail(x, pairs), 0.1 * false_alarm) << example.name;
  }
}

// What advance() asks of its host, gathering credits by bin.
class Ledger {
 public:
  explicit Ledger(const Visit& start) : current_(start) {}
  double evaluate(PrimarySample& u) {
    proposed_ = target(u);
    return proposed_.value;
  }
  void credit_current(double weight) {
    chain[current_.bin] += weight * current_.value;
    ++current_credits;
  }
  void credit_proposed(double weight) { chain[proposed_.bin] += weight * proposed_.value; }
  void credit_large(double weight) { large[proposed_.bin] += weight * proposed_.value; }
  void accept() { current_ = proposed_; }

  std::vector<double> chain = std::vector<double>(bins, 0.0);
  std::vector<double> large = std::vector<double>(bins, 0.0);
  uint64_t current_credits = 0;

 private:
  Visit current_, proposed_;
};

// The credits of every chain estimate every bin's integral without bias: z-scores over independent
// chains. beta is wrong on purpose: it may be anything that does not change.
void expect_exact_credits(const Case& example, bool kelemen) {
  const double beta = 1.7 * integral();
  const CreditRule rule =
      kelemen ? CreditRule::kelemen(beta, example.mix.large) : CreditRule::expected(beta);
  Machine machine(example, 23);
  constexpr uint32_t chains = 4000;
  constexpr uint64_t mutations = 40;
  std::vector<MeanTally> estimates(bins);
  WalkTally tally;
  for (uint32_t c = 0; c < chains; ++c) {
    Ledger ledger(machine.start_among(c));
    uint64_t stuck = 0;
    const uint64_t accepted_before = tally.kinds[0].accepted + tally.kinds[1].accepted;
    advance(machine.walker(), machine.owner(), ledger, rule, mutations, stuck, tally);
    (void)accepted_before;
    for (size_t i = 0; i < bins; ++i) {
      const double sum = ledger.chain[i] * integral() / beta + ledger.large[i];
      estimates[i].add(sum / static_cast<double>(mutations));
    }
    EXPECT_LE(ledger.current_credits, mutations + 1);
  }
  const std::vector<double> mass = masses();
  for (size_t i = 0; i < bins; ++i) {
    if (mass[i] == 0.0) {
      EXPECT_EQ(estimates[i].mean(), 0.0);
      continue;
    }
    EXPECT_LT(std::abs(estimates[i].mean() - mass[i]), z_limit * estimates[i].standard_error())
        << example.name << ", bin " << i << (kelemen ? ", kelemen" : ", expected");
  }
}

TEST(Advance, CreditsByExpectedValueExactly) {
  for (const Case& example : cases) expect_exact_credits(example, false);
}

TEST(Advance, KelemenWeightsAreExactWithAFrozenBeta) {
  for (const Case& example : cases) {
    if (example.mix.large > 0.0) expect_exact_credits(example, true);
  }
}

// A chain's total credit per mutation is beta whatever happens: (1 - a) + a = 1.
TEST(Advance, ExpectedCreditsSumToOneAMutation) {
  Machine machine(cases[0], 5);
  WalkTally tally;
  for (uint32_t c = 0; c < 50; ++c) {
    Ledger ledger(machine.start_among(c));
    uint64_t stuck = 0;
    advance(machine.walker(), machine.owner(), ledger, CreditRule::expected(3.0), 64, stuck, tally);
    double sum = 0.0;
    for (const double s : ledger.chain) sum += s;
    EXPECT_NEAR(sum, 3.0 * 64, 1e-9);
  }
  uint64_t proposed = 0;
  for (const auto& kind : tally.kinds) proposed += kind.proposed;
  EXPECT_EQ(proposed, 50u * 64u);
  EXPECT_GT(tally.longest_stuck, 0u);
}

// Large steps are independent uniform samples: their mean is b, and the standard error is true.
TEST(Advance, LargeStepsMeasureB) {
  Machine machine(cases[0], 99);
  WalkTally tally;
  for (uint32_t c = 0; c < 2000; ++c) {
    Ledger ledger(machine.start_among(c));
    uint64_t stuck = 0;
    advance(machine.walker(), machine.owner(), ledger, CreditRule::expected(1.0), 100, stuck,
            tally);
  }
  const MeanTally& b = tally.large_values;
  EXPECT_EQ(b.count, tally.kinds[static_cast<size_t>(StepKind::large)].proposed);
  EXPECT_LT(std::abs(b.mean() - integral()), z_limit * b.standard_error());
  // Second moment: 0.5 * 13/3 + 0.3 * 16/5 (1 - 4^-5) + 0.2 * 4/9.
  const double second = 0.5 * 13.0 / 3.0 + 0.3 * 3.2 * (1.0 - 1.0 / 1024) + 0.2 * 4.0 / 9.0;
  const double sigma = std::sqrt(second - integral() * integral());
  const double expected = sigma / std::sqrt(static_cast<double>(b.count));
  EXPECT_NEAR(b.standard_error(), expected, 0.03 * expected);
}

// Storing and restoring a chain at any moment does not change where it goes.
TEST(Walker, GoesOnBitForBitAfterBeingStored) {
  for (const Case& example : cases) {
    Machine whole(example, 3), parts(example, 3);
    Visit a = whole.start_among(1), b = parts.start_among(1);
    StoredNumbers numbers, other;
    for (uint64_t m = 0; m < 500; ++m) {
      a = whole.step(a);
      b = parts.step(b);
      if (m % 7 == 0) {
        store_numbers(parts.owner(), numbers);
        parts.start(2);
        parts.walker().load(1, m + 1, numbers, true, b.value);
      }
      ASSERT_EQ(a.bin, b.bin);
      ASSERT_EQ(a.value, b.value);
    }
    store_numbers(whole.owner(), numbers);
    store_numbers(parts.owner(), other);
    EXPECT_EQ(numbers, other);
  }
}

}  // namespace
}  // namespace pssmlt
