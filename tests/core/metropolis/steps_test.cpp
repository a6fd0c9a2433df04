#include "core/metropolis/steps.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.h"

namespace pssmlt {
namespace {

constexpr unsigned camera = 1u << static_cast<unsigned>(Stream::camera);
constexpr unsigned light = 1u << static_cast<unsigned>(Stream::light);

// Share of each kind over an even grid of the deciding word.
std::map<StepKind, double> shares(const StepChooser& chooser) {
  std::map<StepKind, double> result;
  constexpr int grid = 1 << 16;
  for (uint32_t i = 0; i < grid; ++i) result[chooser.choose(i << 16, 0).kind] += 1.0 / grid;
  return result;
}

TEST(StepChooser, KindsHaveTheirProbabilities) {
  const StepMix mix{0.25, 0.2, 0.4, 0.1};
  auto p = shares(StepChooser(mix, camera | light, true));
  EXPECT_NEAR(p[StepKind::large], 0.25, 1e-4);
  EXPECT_NEAR(p[StepKind::film], 0.75 * 0.2, 1e-4);
  EXPECT_NEAR(p[StepKind::camera], 0.75 * 0.2, 1e-4);
  EXPECT_NEAR(p[StepKind::light], 0.75 * 0.2, 1e-4);
  EXPECT_NEAR(p[StepKind::range], 0.75 * 0.1, 1e-4);
  EXPECT_NEAR(p[StepKind::all], 0.75 * 0.3, 1e-4);
  EXPECT_EQ(p.count(StepKind::connection), 0u);
  EXPECT_EQ(p.count(StepKind::shared), 0u);
}

TEST(StepChooser, WastesNoStepOnWhatIsNotRead) {
  const StepMix mix{0.25, 0.2, 0.4, 0.0};
  auto p = shares(StepChooser(mix, light, false));
  EXPECT_NEAR(p[StepKind::large], 0.25, 1e-4);
  EXPECT_NEAR(p[StepKind::all], 0.75, 1e-4);
  EXPECT_EQ(p.size(), 2u);
}

TEST(StepChooser, RangesAreWholeVerticesOfAllStreams) {
  const StepMix mix{0.0, 0.0, 0.0, 1.0};
  const StepChooser chooser(mix, camera, true);
  RandomStream random(1, RandomUse::test);
  std::map<uint32_t, int> firsts;
  for (int i = 0; i < 4096; ++i) {
    const Step step = chooser.choose(random.bits(), random.bits());
    EXPECT_EQ(step.kind, StepKind::range);
    EXPECT_EQ(step.streams, 15u);
    EXPECT_EQ(step.first % blocks_per_vertex, 0u);
    EXPECT_EQ(step.end % blocks_per_vertex, 0u);
    EXPECT_LT(step.first, step.end);
    ++firsts[step.first / blocks_per_vertex];
  }
  // Binomial with p = 1/2: 2048 +- 32; 200 is 6.2 sigma.
  EXPECT_NEAR(firsts[0], 2048, 200);
}

TEST(StepChooser, AFilmStepIsTheCamerasFirstBlock) {
  const StepMix mix{0.0, 1.0, 0.0, 0.0};
  const Step step = StepChooser(mix, camera, true).choose(123456u, 0);
  EXPECT_EQ(step.kind, StepKind::film);
  EXPECT_EQ(step.streams, camera);
  EXPECT_EQ(step.first, 0u);
  EXPECT_EQ(step.end, 1u);
}

}  // namespace
}  // namespace pssmlt
