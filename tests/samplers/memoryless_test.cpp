// Samplers that are not Markov chains.
#include "core/sampling/memoryless.h"

#include <gtest/gtest.h>

#include <set>

#include "core/metropolis/normalisation.h"
#include "core/sampling/replay.h"
#include "tests/support/statistics.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

using test::ToyRender;

const std::vector<std::string> names = {"independent", "stratified", "sobol"};

// Smooth in the pixel, with a number of the light stream that lands elsewhere.
void smooth(PrimarySample& u, Splats& out) {
  const dvec2 raster = u.raster();
  const float a = u.numbers(Stream::camera, 1).next();
  Numbers light = u.numbers(Stream::light, 0);
  const vec2 at = light.next2();
  const float c = light.next();
  out.camera(Rgb(static_cast<float>(raster.x) * (0.5f + a)), {});
  out.light(dvec2(at.x * 6.0, at.y * 4.0), Rgb(2.f * c), {});
}
// Pixel (x, y): camera x + 0.5, light 1.
double smooth_pixel(int p) { return p % 6 + 1.5; }

TEST(Memoryless, PicturesConvergeToTheIntegral) {
  const RasterMap map = test::box_map(6, 4);
  for (const std::string& name : names) {
    ToyRender render(name, {}, smooth, map, 5);
    render.rounds(1024);
    for (int p = 0; p < 24; ++p) {
      // Standard deviation of one sample is below 6; independent points are the worst.
      EXPECT_NEAR(render.pixel(p), smooth_pixel(p), test::z_limit * 6.0 / 32.0) << name;
    }
  }
}

// Even and odd sweeps, each over all parts, are estimates of the whole, whose groups know how many
// samples they have.
TEST(Memoryless, HalvesAreEstimatesOfTheWhole) {
  const RasterMap map = test::box_map(6, 4);
  double expected = 0.0;
  for (int p = 0; p < 24; ++p) expected += smooth_pixel(p);
  for (const std::string& name : names) {
    ToyRender render(name, {}, smooth, map, 5);
    ASSERT_TRUE(render.sampler().pairs_groups());
    render.rounds(41);
    for (int half = 0; half < 2; ++half) {
      double sum = 0.0, sweeps = 0.0;
      for (int g = half; g < group_count; g += 2) {
        sweeps += 1.0 / render.sampler().group_scale(0, g, 41);
        for (int p = 0; p < 24; ++p) sum += render.film().sum(0, p, g);
      }
      EXPECT_NEAR(sweeps, half == 0 ? 21.0 : 20.0, 1e-9);
      EXPECT_NEAR(sum / sweeps, expected, 0.1 * expected) << name;
    }
    EXPECT_EQ(render.sampler().group_scale(0, 3, 1), 0.0);
  }
}

// Pictures of few pixels fill their parts in turn, so that there are enough of them for an
// interval.
TEST(Memoryless, OnePixelHasEightPairs) {
  const RasterMap map = test::box_map(1, 1);
  for (const std::string& name : names) {
    ToyRender render(name, {}, smooth, map, 5);
    render.rounds(35);
    double samples = 0.0;
    for (int g = 0; g < group_count; ++g) {
      const double scale = render.sampler().group_scale(0, g, 35);
      EXPECT_EQ(scale > 0.0, g < 16);
      EXPECT_EQ(render.film().sum(0, 0, g) > 0.0, g < 16);
      samples += scale > 0.0 ? 1.0 / scale : 0.0;
    }
    EXPECT_NEAR(samples, 35.0, 1e-9);
  }
}

TEST(Memoryless, TheOrderOfUnitsDoesNotMatter) {
  const RasterMap map = test::box_map(70, 40);
  for (const std::string& name : names) {
    ToyRender a(name, {}, smooth, map, 5), b(name, {}, smooth, map, 5);
    a.rounds(3);
    b.rounds(3, true);
    double difference = 0.0;
    for (size_t i = 0; i < a.film().all().size(); ++i) {
      // Light splats meet in another order: equal up to rounding.
      difference = std::max(difference, std::abs(a.film().all()[i] - b.film().all()[i]));
    }
    EXPECT_LT(difference, 1e-9) << name;
  }
}

TEST(Memoryless, SeedsGiveOtherPictures) {
  const RasterMap map = test::box_map(6, 4);
  for (const std::string& name : names) {
    ToyRender a(name, {}, smooth, map, 5), b(name, {}, smooth, map, 6);
    ToyRender c(name, {test::integer("seed", 3)}, smooth, map, 5);
    for (ToyRender* r : {&a, &b, &c}) r->rounds(1);
    EXPECT_NE(a.film().all(), b.film().all());
    EXPECT_NE(a.film().all(), c.film().all());
    EXPECT_NE(b.film().all(), c.film().all());
  }
}

TEST(Memoryless, ReplaysASampleBitForBit) {
  const RasterMap map = test::box_map(40, 40);
  for (const std::string& name : names) {
    std::string numbers;
    const auto f = [&numbers](PrimarySample& u, Splats& out) {
      smooth(u, out);
      const bool bad = u.raster().y > 30.0 && u.numbers(Stream::light, 0).next() > 0.999f;
      if (!bad) return;
      out.camera(Rgb(-1e9f), {});
      if (numbers.empty()) numbers = numbers_to_text(u);
    };
    ToyRender render(name, {}, f, map, 5);
    render.rounds(20);
    ASSERT_GT(render.log().of(Rejection::negative), 0u) << name;
    const std::string key = render.log().examples()[0].text;
    const std::string first = numbers;
    numbers.clear();
    ToyRender again(name, {}, f, map, 5);
    ASSERT_TRUE(again.sampler().replay(key, again.worker()));
    EXPECT_EQ(again.log().of(Rejection::negative), 1u);
    EXPECT_EQ(numbers, first);
    EXPECT_FALSE(again.sampler().replay("other:1:2:3", again.worker()));
    EXPECT_FALSE(again.sampler().replay(name + ":1:2:3", again.worker()));
    EXPECT_FALSE(ToyRender(name, {}, f, map, 6).sampler().replay(key, again.worker()));
  }
}

// Counts samples of pixels.
class CountingSink final : public SplatSink {
 public:
  explicit CountingSink(int pixels) : counts(static_cast<size_t>(pixels)) {}
  void add(int plane, const Splats& splats, const PixelCredit& camera, double weight,
           int) override {
    EXPECT_EQ(weight, 1.0);
    for (const Splat& splat : splats.all()) {
      EXPECT_EQ(plane, splat.from_camera ? 0 : 1);
      if (splat.from_camera) {
        ++counts[static_cast<size_t>(camera.pixel)];
      } else {
        ++light;
      }
    }
  }
  std::vector<uint8_t> counts;
  int64_t light = 0;
};

TEST(Memoryless, LargePicturesAreServedInSubsets) {
  const int width = 2048, height = 1031;
  const RasterMap map = test::box_map(width, height);
  test::ToyIntegrator integrator([](PrimarySample& u, Splats& out) {
    (void)u.raster();
    out.light(dvec2(1.0), Rgb(1.f), {});
    out.camera(Rgb(1.f), {});
  });
  RejectionLog log;
  Evaluator evaluator(integrator, log);
  Splats splats;
  Workspace workspace;
  PrimarySampleOwner owner(map);
  Worker worker{owner, splats, workspace, evaluator};
  const Scene scene;
  const auto sampler = ToyRender::make("independent", {});
  sampler->start({scene, integrator, map, 1, {}});
  ASSERT_EQ(sampler->subsets(), 2);
  ASSERT_EQ(sampler->planes(), 2);
  CountingSink sink(width * height);
  double samples = 0.0;
  for (int round = 0; round < 3; ++round) {
    for (int unit = 0; unit < sampler->units(round); ++unit) {
      sampler->run(round, unit, sink, worker);
    }
    samples += sampler->samples(round);
  }
  EXPECT_EQ(static_cast<double>(sink.light), samples);
  bool exact = true;
  for (int p = 0; p < width * height; ++p) {
    const int subset = sampler->subset_of(p);
    const int count = sink.counts[static_cast<size_t>(p)];
    exact = exact && count * sampler->scale(0, subset, 3) == 1.0;
  }
  EXPECT_TRUE(exact);
  EXPECT_NEAR(sampler->scale(1, 0, 3) * samples, double(width) * height, 1e-6);
  EXPECT_EQ(sampler->scale(0, 1, 1), 0.0);
  double all = 0.0;
  for (int g = 0; g < group_count; ++g) {
    const double scale = sampler->group_scale(0, g, 3);
    all += scale > 0.0 ? 1.0 / scale : 0.0;
  }
  EXPECT_NEAR(all * width * height, samples, 1e-3);
}

// The numbers that a pixel sees at one block.
std::vector<NumberBlock> numbers_of(const std::string& name, const ParameterSet& set, int pixel,
                                    Stream stream, int count) {
  std::vector<NumberBlock> result;
  const RasterMap map = test::box_map(8, 4);
  ToyRender render(
      name, set,
      [&](PrimarySample& u, Splats&) {
        (void)u.raster();
        const NumberBlock before = *u.held(Stream::camera).find(0);
        (void)before;
        (void)u.numbers(stream, 1);
        const int at = static_cast<int>(u.raster().y) * 8 + static_cast<int>(u.raster().x);
        if (pixel < 0 || at == pixel) result.push_back(*u.held(stream).find(blocks_per_vertex));
      },
      map, 9);
  render.rounds(count);
  return result;
}

// Even samples a grid of their own, and odd ones.
TEST(Stratified, VisitsEveryStratumOnce) {
  const ParameterSet set = {test::integer("xsamples", 5), test::integer("ysamples", 3)};
  const auto blocks = numbers_of("stratified", set, 13, Stream::connection, 30);
  ASSERT_EQ(blocks.size(), 30u);
  for (size_t half = 0; half < 2; ++half) {
    for (size_t pair = 0; pair < 2; ++pair) {
      std::set<int> met;
      for (size_t i = 0; i < 15; ++i) {
        const NumberBlock& b = blocks[half + 2 * i];
        const int x = static_cast<int>(to_unit_double(b[2 * pair]) * 5.0);
        const int y = static_cast<int>(to_unit_double(b[2 * pair + 1]) * 3.0);
        met.insert(y * 5 + x);
      }
      EXPECT_EQ(met.size(), 15u);
    }
  }
}

TEST(Stratified, WithoutJitterTakesTheCentres) {
  const ParameterSet set = {test::integer("xsamples", 2), test::integer("ysamples", 2),
                            test::flag("jitter", false)};
  for (const NumberBlock& b : numbers_of("stratified", set, 3, Stream::camera, 4)) {
    for (const uint32_t x : b) EXPECT_TRUE(x == 0x40000000u || x == 0xC0000000u);
  }
}

// 64 sweeps are 32 points of each of the two scrambles.
TEST(Sobol, StratifiesAPixelOverItsSamples) {
  const auto blocks = numbers_of("sobol", {}, 13, Stream::connection, 64);
  for (size_t scramble = 0; scramble < 2; ++scramble) {
    for (size_t d = 0; d < 4; ++d) {
      std::set<uint32_t> met;
      for (size_t i = scramble; i < 64; i += 2) met.insert(blocks[i][d] >> 27);
      EXPECT_EQ(met.size(), 32u);
    }
  }
}

// 32 sweeps are 16 samples of each half; the two pixels of a part take turns in its sequence.
TEST(Sobol, StratifiesTheLightStreamOverAPart) {
  const auto blocks = numbers_of("sobol", {}, -1, Stream::light, 32);
  ASSERT_EQ(blocks.size(), 32u * 32u);
  for (size_t half = 0; half < 2; ++half) {
    for (size_t part = 0; part < 16; ++part) {
      const size_t x = part % 4, y = part / 4;
      for (size_t d = 0; d < 4; ++d) {
        std::set<uint32_t> met;
        for (size_t sweep = half; sweep < 32; sweep += 2) {
          for (const size_t pixel : {y * 8 + x, y * 8 + x + 4}) {
            met.insert(blocks[sweep * 32 + pixel][d] >> 27);
          }
        }
        EXPECT_EQ(met.size(), 32u);
      }
    }
  }
}

TEST(Memoryless, ReadsPbrtsNamesAndBudgets) {
  EXPECT_EQ(ToyRender::make("sobol", {})->default_spp(), 16.0);
  EXPECT_EQ(ToyRender::make("independent", {test::integer("pixelsamples", 7)})->default_spp(), 7.0);
  EXPECT_EQ(ToyRender::make("stratified", {})->default_spp(), 16.0);
  const ParameterSet owen = {test::text("randomization", "owen")};
  EXPECT_NO_THROW(ToyRender::make("sobol", owen));
  EXPECT_THROW(ToyRender::make("sobol", {test::text("randomization", "ower")}), Error);
  EXPECT_THROW(ToyRender::make("sobol", {test::integer("pixelsamples", 0)}), Error);
  EXPECT_THROW(ToyRender::make("independent", {test::integer("pixelsamples", -1)}), Error);
  EXPECT_THROW(ToyRender::make("stratified", {test::integer("xsamples", 0)}), Error);
  EXPECT_THROW(ToyRender::make("stratified", {test::integer("xsample", 4)}), Error);
}

}  // namespace
}  // namespace pssmlt
