// Weights of multiple importance sampling against the same sums in 80 bits, for paths of up to 1000
// vertices: products of densities there need the exponents of long double.
#include "core/path/mis.h"

#include <vector>

#include "tests/numerics/measured.h"

namespace pssmlt {
namespace {

using namespace test;

// Densities along a subpath: what an edge adds.
struct Edge {
  double pdf = 1.0, pdf_reverse = 1.0, cos_start = 1.0, cos_end = 1.0, distance2 = 1.0;
  bool delta = false;
};

// Scattering from diffuse to lobes of 1e8 per steradian, cosines down to 1e-7, lengths over 24
// powers of two. As materials' are, densities are symmetric but for their cosines, so that what is
// multiplied along a path does not run away by itself.
Edge random_edge(RandomStream& random) {
  Edge e;
  e.cos_start = spread(random, 1e-7, 1.0);
  e.cos_end = spread(random, 1e-7, 1.0);
  const double lobe = spread(random, 1e-3, 1e8);
  e.pdf = lobe * e.cos_start;
  e.pdf_reverse = lobe * spread(random, 1e-7, 1.0);
  const double length = spread(random, 0x1p-12, 0x1p12);
  e.distance2 = length * length;
  e.delta = random.next() < 0.2f;
  if (e.delta) e.pdf = e.pdf_reverse = 1.0;
  return e;
}

struct LongPartial {
  long double connect = 0.0L, deeper = 0.0L;
};

// The definition, without limits.
LongPartial next(const LongPartial& from, const Edge& e, bool power) {
  const auto f = [power](long double r) { return power ? r * r : r; };
  const long double density = static_cast<long double>(e.pdf) * static_cast<long double>(e.cos_end);
  const long double back = f(e.pdf_reverse) * from.deeper;
  return {e.delta ? 0.0L : f(e.distance2 / density),
          f(e.cos_start / density) * (e.delta ? back : from.connect + back)};
}

// An edge adds 5 roundings (balance) or 9 (power), all terms are positive: (5 or 9 (n + 2)) U.
void weights_of_length(int vertices, bool power, int paths, Worst& worst, int& left_out) {
  const Mis mis(power ? Mis::Heuristic::power : Mis::Heuristic::balance);
  RandomStream random(static_cast<uint64_t>(vertices) + (power ? 5000u : 0u), RandomUse::test);
  const long double bound = (power ? 9.0L : 5.0L) * (vertices + 2.0L) * double_unit;
  for (int path = 0; path < paths; ++path) {
    MisPartial found = mis.first(1.0, 2.0, 0.5, 0.25, 1.0);
    LongPartial exact{found.connect, found.deeper};
    long double largest = 0.0L, least = 1.0L;
    for (int i = 1; i < vertices; ++i) {
      const Edge e = random_edge(random);
      found = mis.next(found, e.pdf, e.pdf_reverse, e.delta, e.cos_start, e.cos_end, e.distance2);
      exact = next(exact, e, power);
      largest = std::max({largest, exact.connect, exact.deeper});
      if (exact.deeper > 0.0L) least = std::min(least, exact.deeper);
    }
    const double density = spread(random, 1e-7, 1e7), reverse = spread(random, 1e-7, 1e7);
    const double sum = mis.join(found, density, reverse);
    const auto f = [power](long double r) { return power ? r * r : r; };
    const long double true_sum = f(density) * (exact.connect + f(reverse) * exact.deeper);
    // Beyond these the double has no exponent for the ratio: the weight is still one.
    if (largest > 0x1p499L || least < 0x1p-1000L) {
      ++left_out;
      const double weight = Mis::weight(sum, 0.0);
      ASSERT_TRUE(weight >= 0.0 && weight <= 1.0);
      continue;
    }
    const long double weight = 1.0L / (1.0L + true_sum);
    worst.add(relative(Mis::weight(sum, 0.0), weight), bound);
  }
}

TEST(MisNumerics, RecursionToAThousandVertices) {
  for (const bool power : {false, true}) {
    Worst worst(power ? "MIS weight, power heuristic, up to 1000 vertices"
                      : "MIS weight, balance heuristic, up to 1000 vertices",
                power ? "9 (n + 2) U" : "5 (n + 2) U");
    int left_out = 0;
    for (const int vertices : {2, 10, 100, 1000}) {
      weights_of_length(vertices, power, 2'000'000 / vertices / 10, worst, left_out);
    }
    worst.check();
    std::printf("numerics: paths whose ratios have no exponent in double: %d\n", left_out);
  }
}

// Of a pair: two quotients, a product, a sum, a quotient in double, and the rounding to float.
TEST(MisNumerics, PowerWeight) {
  RandomStream random(3, RandomUse::test);
  Worst worst("weight of a light drawn against one met", "u + 4 U");
  for (int i = 0; i < 1'000'000; ++i) {
    const auto p = static_cast<float>(spread(random, 1e-15, 1e15));
    const auto q = static_cast<float>(spread(random, 1e-15, 1e15));
    const long double r = static_cast<long double>(q) / static_cast<long double>(p);
    const long double exact = 1.0L / (1.0L + r * r);
    if (exact < 1e-37L) continue;  // float flushes smaller ones to 0
    worst.add(relative(power_weight(p, q), exact), float_unit + 4.0L * double_unit);
  }
  worst.check();
}

// Both strategies of a pair see the same two densities: their weights add up to one.
TEST(MisNumerics, WeightsOfAPairAddUp) {
  RandomStream random(4, RandomUse::test);
  Worst worst("sum of a pair's weights - 1", "u + 8 U");
  for (int i = 0; i < 1'000'000; ++i) {
    const auto p = static_cast<float>(spread(random, 1e-15, 1e15));
    const auto q = static_cast<float>(spread(random, 1e-15, 1e15));
    const long double sum = static_cast<long double>(power_weight(p, q)) + power_weight(q, p);
    worst.add(sum - 1.0L, float_unit + 8.0L * double_unit);
  }
  worst.check();
}

}  // namespace
}  // namespace pssmlt
