#include "core/sampling/evaluator.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/sampling/replay.h"
#include "tests/support/toy.h"

namespace pssmlt {
namespace {

class PhiloxSource final : public NumberSource {
 public:
  void fill(Stream stream, uint32_t index, NumberBlock& block) override {
    block = philox(1, {index, static_cast<uint32_t>(stream), 0, 0});
  }
};

struct Bench {
  explicit Bench(test::ToyIntegrator::Function f)
      : integrator(std::move(f)), evaluator(integrator, log), owner(map) {
    owner.begin(source);
  }
  bool evaluate() { return evaluator.evaluate(owner.sample(), splats, workspace); }

  RasterMap map = test::box_map(4, 4);
  test::ToyIntegrator integrator;
  RejectionLog log;
  Evaluator evaluator;
  PrimarySampleOwner owner;
  PhiloxSource source;
  Splats splats;
  Workspace workspace;
};

void expect_rejected(Rejection cause, const test::ToyIntegrator::Function& f) {
  Bench bench(f);
  EXPECT_FALSE(bench.evaluate());
  EXPECT_TRUE(bench.splats.empty());
  EXPECT_EQ(bench.log.of(cause), 1u) << to_string(cause);
  EXPECT_EQ(bench.log.total(), 1u);
  ASSERT_EQ(bench.log.examples().size(), 1u);
  EXPECT_EQ(bench.log.examples()[0].text.substr(0, 2), "u:");
}

test::ToyIntegrator::Function camera_value(const Rgb& value) {
  return [value](PrimarySample& u, Splats& out) {
    (void)u.raster();
    out.camera(Rgb(1.f), {});
    out.camera(value, {});
  };
}

// Bright scenes are not made of samples that are too large, nor dark ones without such.
TEST(Evaluator, LargeIsRelativeToTheScene) {
  const auto takes = [](float value, double scale) {
    test::ToyIntegrator integrator(camera_value(Rgb(value)));
    Bench bench([](PrimarySample&, Splats&) {});
    RejectionLog log;
    Evaluator evaluator(integrator, log, scale);
    return evaluator.evaluate(bench.owner.sample(), bench.splats, bench.workspace);
  };
  EXPECT_TRUE(takes(0x1p100f, 0x1p100));
  EXPECT_TRUE(takes(0x1p40f, 1.0));
  EXPECT_FALSE(takes(0x1p41f, 1.0));
  EXPECT_TRUE(takes(1.f, 0x1p-47));  // a lamp over a plain of 10^7 m
  EXPECT_FALSE(takes(1.f, 0x1p-62));
  EXPECT_FALSE(takes(infinity, 0x1p120));
}

TEST(Evaluator, DropsAndCountsBadSamples) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_rejected(Rejection::nan, camera_value({1.f, nan, 0.f}));
  expect_rejected(Rejection::infinite, camera_value({infinity, 0.f, 0.f}));
  expect_rejected(Rejection::infinite, camera_value({-infinity, 0.f, 0.f}));
  expect_rejected(Rejection::negative, camera_value({1.f, 0.f, -2.f}));
  expect_rejected(Rejection::too_large, camera_value({0x1p41f, 0.f, 0.f}));
  expect_rejected(Rejection::threw, [](PrimarySample& u, Splats& out) {
    (void)u.numbers(Stream::light, 0);
    out.light(dvec2(1.0), Rgb(1.f), {});
    throw std::runtime_error("broken");
  });
  expect_rejected(Rejection::no_raster,
                  [](PrimarySample&, Splats& out) { out.camera(Rgb(1.f), {}); });
  expect_rejected(Rejection::nan, [nan](PrimarySample&, Splats& out) {
    out.light(dvec2(0.0, static_cast<double>(nan)), Rgb(1.f), {});
  });
}

TEST(Evaluator, LetsGoodSamplesPass) {
  Bench bench(camera_value(Rgb(0x1p39f)));
  EXPECT_TRUE(bench.evaluate());
  EXPECT_EQ(bench.splats.all().size(), 1u);
  EXPECT_EQ(bench.log.total(), 0u);
  EXPECT_EQ(bench.evaluator.samples(), 1u);
}

TEST(Evaluator, NamesSamplesOfMemorylessSamplers) {
  Bench bench(camera_value(Rgb(-3.f)));
  bench.evaluator.name_sample("sobol", 12345678901234567890u, 7, 99);
  EXPECT_FALSE(bench.evaluate());
  EXPECT_EQ(bench.log.examples()[0].text, "sobol:12345678901234567890:7:99");
  SampleName name;
  ASSERT_TRUE(parse_sample_name(bench.log.examples()[0].text, name));
  EXPECT_EQ(name.name, "sobol");
  EXPECT_EQ(name.seed, 12345678901234567890u);
  EXPECT_EQ(name.pixel, 7);
  EXPECT_EQ(name.index, 99);
}

TEST(Replay, NumbersComeBackBitForBit) {
  Bench bench([](PrimarySample& u, Splats& out) {
    (void)u.raster();
    (void)u.numbers(Stream::light, 7, 1);
    (void)u.numbers(Stream::shared, 0);
    out.camera(Rgb(1.f), {});
  });
  EXPECT_TRUE(bench.evaluate());
  const std::string text = numbers_to_text(bench.owner.sample());
  PrimarySampleOwner other(bench.map);
  ASSERT_TRUE(numbers_from_text(text, other));
  EXPECT_EQ(numbers_to_text(other.sample()), text);
  EXPECT_EQ(other.sample().raster(), bench.owner.sample().raster());
  EXPECT_EQ(*other.current(Stream::light).find(15), *bench.owner.current(Stream::light).find(15));
}

TEST(Replay, RefusesWhatIsNoKey) {
  const RasterMap map = test::box_map(4, 4);
  PrimarySampleOwner owner(map);
  const std::string digits(32, '0');
  EXPECT_TRUE(numbers_from_text("u:", owner));
  EXPECT_TRUE(numbers_from_text("u:0.0=" + digits, owner));
  for (const std::string& bad :
       {std::string(""), std::string("v:"), "u:4.0=" + digits, "u:0.0=" + digits.substr(1),
        "u:0.99999999=" + digits, "u:0.0=" + digits + "x", "u:a.0=" + digits,
        "u:0.0=" + std::string(32, 'g')}) {
    EXPECT_FALSE(numbers_from_text(bad, owner)) << bad;
  }
  SampleName name;
  for (const char* bad : {"", "sobol", "sobol:1:2", "sobol:1:2:x", ":1:2:3", "sobol:1:2:3:4"}) {
    EXPECT_FALSE(parse_sample_name(bad, name)) << bad;
  }
}

}  // namespace
}  // namespace pssmlt
