// The pieces of a session, for those who let several take turns.
#include "core/render/session.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/core/render/session_support.h"

namespace pssmlt {
namespace {

using test::build_small;
using test::settings_for;

void sleep_briefly() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

TEST(Stopwatch, StandsWhileHeld) {
  Stopwatch watch;
  watch.hold();
  const double held = watch.seconds();
  sleep_briefly();
  EXPECT_EQ(watch.seconds(), held);
  watch.hold();  // twice is once
  watch.go_on();
  watch.go_on();
  sleep_briefly();
  EXPECT_GE(watch.seconds(), held + 0.02);
}

RenderSettings endless(uint64_t seed) {
  RenderSettings s = settings_for(1, 2, seed);
  s.spp.reset();
  s.seconds = 1e9;
  return s;
}

TEST(Session, OnlyTimeThatIsNotHeldCounts) {
  const BuiltScene scene = build_small("path", "sobol");
  const RenderSettings settings = endless(1);
  const RenderCallbacks none;
  Session session(scene, settings, none);
  session.prepare();
  EXPECT_FALSE(session.has_picture());
  EXPECT_TRUE(session.step());
  EXPECT_TRUE(session.has_picture());
  session.hold();
  const double before = session.elapsed();
  sleep_briefly();
  EXPECT_EQ(session.result(false).seconds, before);
  session.go_on();
  session.step();
  EXPECT_GT(session.elapsed(), before);
}

// Two techniques in turns, pictures taken meanwhile, leave the bits of render() with that seed and
// that many rounds.
TEST(Session, TurnsLeaveTheBitsOfRender) {
  const RenderSettings settings = endless(7);
  const RenderCallbacks none;
  const BuiltScene one = build_small("bdpt", "pssmlt"), two = build_small("path", "sobol");
  Session a(one, settings, none), b(two, settings, none);
  a.prepare();
  b.prepare();
  for (int round = 0; round < 5; ++round) {
    a.step();
    a.hold();
    (void)a.result(false);
    b.step();
    (void)b.group_blocks();
    a.go_on();
  }
  for (Session* session : {&a, &b}) {
    const RenderResult r = session->result(true);
    ASSERT_EQ(r.rounds, std::vector<int64_t>{5});
    const bool chains = session == &a;
    const BuiltScene alone = chains ? build_small("bdpt", "pssmlt") : build_small("path", "sobol");
    // Just below, so that rounding asks for no more.
    RenderSettings whole = settings_for(r.samples / (19 * 13) * (1.0 - 1e-9), 1, 7);
    const RenderResult expected = render(alone, whole);
    ASSERT_EQ(expected.rounds, r.rounds);
    EXPECT_EQ(expected.image.data, r.image.data);
    EXPECT_EQ(expected.half[0].data, r.half[0].data);
    EXPECT_EQ(expected.half[1].data, r.half[1].data);
  }
}

TEST(Session, StepsEndWithABudgetOfSamples) {
  const BuiltScene scene = build_small("path", "sobol");
  const RenderSettings settings = settings_for(2);
  const RenderCallbacks none;
  Session session(scene, settings, none);
  session.prepare();
  int steps = 0;
  while (session.step()) ++steps;
  EXPECT_EQ(steps, session.result(true).rounds[0]);
  EXPECT_EQ(session.result(true).samples, 2 * 19 * 13);
}

// Weighted by their pixels, every group's blocks make up the picture's mean, and the groups' mean
// is that of the picture where all have the same number of rounds.
TEST(Session, GroupBlocksMakeUpThePicture) {
  for (const char* sampler : {"independent", "pssmlt"}) {
    const BuiltScene scene = build_small("path", sampler);
    const RenderSettings settings = endless(3);
    const RenderCallbacks none;
    Session session(scene, settings, none);
    session.prepare();
    for (int round = 0; round < group_count; ++round) session.step();
    const GroupBlocks g = session.group_blocks();
    const bool chains = std::string(sampler) == "pssmlt";
    ASSERT_EQ(g.means.size(), static_cast<size_t>(chains ? group_count : pair_count)) << sampler;
    ASSERT_EQ(g.means[0].size(), 2u);  // 16 + 3 columns of 13 pixels
    EXPECT_EQ(g.across, 2);
    double mean = 0.0;
    for (const auto& row : g.means) {
      mean += (16.0 * row[0] + 3.0 * row[1]) / 19.0 / static_cast<double>(g.means.size());
    }
    const Image picture = session.result(false).image;
    double expected = 0.0;
    for (size_t i = 0; i < picture.data.size(); i += 3) {
      const Rgb c(picture.data[i], picture.data[i + 1], picture.data[i + 2]);
      expected += static_cast<double>(luminance(c)) / (19 * 13);
    }
    EXPECT_NEAR(mean / expected, 1.0, 1e-5) << sampler;
    ASSERT_EQ(g.common.size(), 2u);
    for (const double deviation : g.common) EXPECT_EQ(deviation > 0.0, chains);
    EXPECT_NEAR(g.common_variance(), scene.layers[0].sampler->scale_relative_variance(), 1e-12);
  }
}

// The same scene by another technique: as if it had been built for it.
TEST(WithLayers, IsTheSceneUnderAnotherTechnique) {
  const SceneDescription description = parse_string(test::small_scene(), "small");
  BuildOptions options;
  options.defaults = default_plugins();
  options.integrator = "path";
  options.sampler = "sobol";
  const BuiltScene first = build_scene(description, options);
  options.integrator = "bdpt";
  options.sampler = "independent";
  options.set = {"integrator.maxdepth=3"};
  const BuiltScene other = with_layers(first, description, options);
  const BuiltScene whole = build_scene(description, options);
  EXPECT_EQ(other.scene, first.scene);
  EXPECT_EQ(other.settings_hash, whole.settings_hash);
  EXPECT_NE(other.settings_hash, first.settings_hash);
  EXPECT_EQ(other.scene_hash, whole.scene_hash);
  EXPECT_EQ(render(other, settings_for(4)).image.data, render(whole, settings_for(4)).image.data);
  const PluginValues& values = other.layers[0].integrator_values;
  const auto depth = std::ranges::find(values, "maxdepth", [](const auto& v) { return v.first; });
  ASSERT_NE(depth, values.end());
  EXPECT_EQ(depth->second, "3");
}

}  // namespace
}  // namespace pssmlt
