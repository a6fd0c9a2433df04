// Sums of the film against exact ones: values over 40 powers of two, scales of radiance over 200,
// and 10^10 samples of one pixel.
#include "core/metropolis/advance.h"
#include "core/render/develop.h"
#include "core/sampling/raster_map.h"
#include "tests/numerics/measured.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using namespace test;

constexpr long double quantum = 0x1p-48L;
constexpr int64_t ten_billion = 10'000'000'000;

// n times the value, exactly: by doubling, as merging sums does.
FixedSum times(double value, int64_t n) {
  FixedSum sum, power;
  power.add(to_fixed(value));
  for (; n != 0; n >>= 1) {
    if ((n & 1) != 0) sum.add(power);
    power.add(FixedSum(power));
  }
  return sum;
}

// Half a quantum a value; the sum itself is rounded once when it is read.
TEST(FilmSums, EveryValueIsRoundedOnceToTheQuantum) {
  RandomStream random(1, RandomUse::test);
  Worst worst("mean of values in a pixel, absolute, in units of the film",
              "2^-49 + 2 U of the mean");
  for (const double low : {0x1p-40, 0x1p-20, 1.0}) {
    for (const double high : {1.0, 0x1p20, 0x1p40}) {
      constexpr int count = 100'000;
      FixedSum sum;
      __int128 exact = 0;  // of 2^-64, to which all values are exact
      for (int i = 0; i < count; ++i) {
        const double v = static_cast<double>(static_cast<float>(spread(random, low, high)));
        sum.add(to_fixed(v));
        exact += static_cast<__int128>(std::ldexp(static_cast<long double>(v), 64));
      }
      const long double mean = std::ldexp(static_cast<long double>(exact), -64) / count;
      worst.add(static_cast<long double>(sum.value()) / count - mean,
                quantum / 2 + 2.0L * double_unit * mean);
    }
  }
  worst.check();
}

// What lies below half a quantum is lost, and a pixel of the relative radiance r (of the scene's
// radiance_scale) is known to 2^-49 / r: the note says from where on that matters.
TEST(FilmSums, DimPixelsLoseWhatTheNoteSays) {
  for (const int power : {-20, -30, -40}) {
    const double value = std::ldexp(1.2345678, power);
    const FixedSum sum = times(value, 1 << 20);
    const long double error =
        relative(std::ldexp(static_cast<long double>(sum.value()), -20), value);
    EXPECT_LE(std::abs(error), 0x1p-49L / static_cast<long double>(value));
  }
  EXPECT_EQ(times(0x1p-50, 1000).value(), 0.0);
}

// A sink over a one-pixel film: values times 2^k under a factor of 2^-k leave the same bits.
std::vector<double> film_of(int power, const std::vector<float>& values) {
  const RasterMap map = box_map(1, 1);
  Film film({{1, 1}, {1}, {}});
  BlockSums sums = film.make_block_sums();
  UnitSink::Unit unit;
  unit.factor = std::ldexp(1.0, -power);
  UnitSink sink(film, sums, map, unit);
  Splats splats;
  const PixelCredit credit{0, 1.f};
  for (const float v : values) {
    splats.clear();
    const float scaled = std::ldexp(v, power);
    splats.camera(Rgb(scaled, 0.5f * scaled, 0.25f * scaled), {});
    sink.add(0, splats, credit, 1.0, 0);
  }
  sink.flush();
  film.end_round({&sums});
  const dvec3 total = film.value(0, 0, 0, 0);
  return {total.x, total.y, total.z, film.block_sum(0, 0, 0, 0)};
}

TEST(FilmSums, ScalesOfRadianceGiveTheSameBits) {
  RandomStream random(2, RandomUse::test);
  std::vector<float> values;
  for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>(spread(random, 1e-3, 1e3)));
  const std::vector<double> expected = film_of(0, values);
  for (const int power : {-100, -20, 20, 100}) EXPECT_EQ(film_of(power, values), expected) << power;
}

// After 10^10 samples the sum still takes each further one exactly, the mean of twice as many moves
// to where it belongs, and nothing is near the range's end.
TEST(FilmSums, TenBillionSamplesStillMoveTheMean) {
  for (const double value : {1.0, 0.1, 0x1p-30, 0x1p39}) {
    const double held = to_double(to_fixed(value));  // as the quantum holds it
    FixedSum sum = times(value, ten_billion);
    const long double exact = static_cast<long double>(held) * ten_billion;
    EXPECT_LE(std::abs(relative(sum.value(), exact)), 2.0L * double_unit) << value;
    const double before = sum.value();
    sum.add(to_fixed(-value));
    sum.add(times(-value, ten_billion - 1));
    EXPECT_EQ(sum.value(), 0.0) << value;  // not one quantum was lost
    sum = times(value, ten_billion);
    const double more = 1.0 + 0x1p-10;
    sum.add(times(value * more, ten_billion));
    const long double moved = static_cast<long double>(sum.value()) / (2.0L * ten_billion);
    const long double wanted = static_cast<long double>(value) * (1.0L + 0x1p-11L);
    EXPECT_LE(std::abs(moved - wanted), quantum / 2 + 4.0L * double_unit * wanted) << value;
    EXPECT_GT(sum.value(), before);
  }
}

// A float or double that is added to directly does not: why the film is neither.
TEST(FilmSums, WhatOtherSumsWouldDo) {
  const float stuck = 0x1p24f;
  EXPECT_EQ(stuck + 1.f, stuck);
  const double coarse = 1e10;
  EXPECT_GT(std::abs((coarse + 0.1) - coarse - 0.1), 1e-7);
}

// Counters of samples far beyond 2^32: scales, groups and samples stay what they are.
TEST(Counters, MemorylessSamplersCountBeyond32Bits) {
  const RasterMap map = box_map(1, 1);
  const auto grey = [](PrimarySample& u, Splats& out) {
    (void)u.raster();
    out.camera(Rgb(u.numbers(Stream::camera, 1).next()), {});
  };
  for (const std::string name : {"independent", "stratified", "sobol"}) {
    ToyRender render(name, {}, grey, map, 1);
    Sampler& s = render.sampler();
    EXPECT_DOUBLE_EQ(s.scale(0, 0, ten_billion) * 1e10, 1.0) << name;
    double samples = 0.0;
    for (int g = 0; g < group_count; ++g) {
      const double scale = s.group_scale(0, g, ten_billion);
      samples += scale > 0.0 ? 1.0 / scale : 0.0;
    }
    EXPECT_NEAR(samples, 1e10, 1e-3) << name;
    // The rounds about 2^32 do not repeat those about 0.
    const auto value_of = [&](int64_t round) {
      ToyFilm film(map, 1);
      s.run(round, 0, film, render.worker());
      double sum = 0.0;
      for (int g = 0; g < group_count; ++g) sum += film.sum(0, 0, g);
      return sum;
    };
    int same = 0;
    for (int64_t r = 0; r < 100; ++r)
      same += value_of(r) == value_of(r + (int64_t{1} << 32)) ? 1 : 0;
    EXPECT_LT(same, 3) << name;
  }
}

TEST(Counters, AreWide) {
  static_assert(sizeof(LayerScales::total) > 0);
  static_assert(std::is_same_v<decltype(RayCounters::nearest), uint64_t>);
  static_assert(std::is_same_v<decltype(MeanTally::count), uint64_t>);
  static_assert(std::is_same_v<decltype(WalkTally::longest_stuck), uint64_t>);
  static_assert(std::is_same_v<decltype(WalkTally::Kind::proposed), uint64_t>);
}

}  // namespace
}  // namespace pssmlt
