// What the integrators promise beyond agreeing with one another: closed forms at great depth, every
// strategy by itself, path classes and lengths that add up, parameters that are refused.
#include <gtest/gtest.h>

#include "core/path/path_expression.h"
#include "tests/support/render_text.h"

namespace pssmlt::test {
namespace {

// A room without a front wall, seen whole, lit by what `lights` says; 12 x 12 pixels.
std::string room_with(const std::string& lights) {
  return R"(
Film "rgb" "integer xresolution" 12 "integer yresolution" 12
PixelFilter "box"
LookAt 0 1 -3.4  0 1 0  0 1 0
Camera "perspective" "float fov" 52
Integrator "path" "integer maxdepth" 3
WorldBegin
Material "diffuse" "rgb reflectance" [ .7 .7 .7 ]
Shape "trianglemesh"
  "integer indices" [ 0 1 2 0 2 3  0 4 5 0 5 1  3 2 6 3 6 7  0 3 7 0 7 4  1 5 6 1 6 2 ]
  "point3 P" [ -1 0 1  1 0 1  1 2 1  -1 2 1  -1 0 -1  1 0 -1  1 2 -1  -1 2 -1 ]
)" + lights;
}

const char* const lamp = R"(
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 5 5 5 ] "bool twosided" true
  Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
    "point3 P" [ -.6 1.6 -.6  .6 1.6 -.6  .6 1.7 .6  -.6 1.7 .6 ]
AttributeEnd
)";
const char* const point =
    "LightSource \"point\" \"rgb I\" [ 2 2 2 ] \"point3 from\" [ .2 1.2 -.3 ]\n";
const char* const sky = "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";
const char* const sun =
    "LightSource \"distant\" \"rgb L\" [ 2 2 2 ] \"point3 from\" [ .3 .5 -1 ]\n";
const char* const ball = R"(
AttributeBegin
  Material "dielectric" "float eta" 1.5
  Translate .2 .6 .1
  Shape "sphere" "float radius" .5
AttributeEnd
)";

Estimate mean_of(const Job& job, int renders, uint64_t seed = 1) {
  return estimate(render_blocks(job, renders, 0, seed)[0]);
}
double mean_of(const Job& job) { return block_means(render_text(job, 1).image, 0)[0]; }

// Student's t between independent estimates of 12 renders each. 30 comparisons a program run at
// 1e-9 each keep false alarms below 1e-7 (the degrees of freedom are taken at their least, 11).
void expect_same(const Estimate& a, const Estimate& b, const std::string& what) {
  static const double limit = student_limit(1e-9, 11.0);
  const double error = std::sqrt(a.variance + b.variance);
  EXPECT_LT(std::abs(a.mean - b.mean), limit * error + 1e-6 * b.mean)
      << what << ": " << a.mean << " +- " << a.error() << " against " << b.mean << " +- "
      << b.error();
  EXPECT_GT(b.mean, 0.0) << what;
}

struct StrategyCase {
  const char* name;
  const char* lights;
  int least_s;   // 0: the light can be hit
  int direct_s;  // largest s for paths without scattering
};

// Each strategy's unweighted estimate is an estimate of the whole by itself.
TEST(Bdpt, EveryStrategyAlone) {
  const StrategyCase cases[] = {
      {"lamp", lamp, 0, 1}, {"point", point, 1, -1}, {"sky", sky, 0, 0}, {"sun", sun, 1, -1}};
  for (const StrategyCase& c : cases) {
    for (int bounces = 0; bounces <= 2; ++bounces) {
      if (bounces == 0 && c.direct_s < 0) continue;
      const std::string depth = std::to_string(bounces);
      const std::vector<std::string> range = {"integrator.mindepth=" + depth,
                                              "integrator.maxdepth=" + depth};
      const Estimate path = mean_of({room_with(c.lights), "path", "independent", range, 32}, 12);
      const int last = bounces == 0 ? 0 : bounces + 1;
      for (int s = c.least_s; s <= last; ++s) {
        std::vector<std::string> set = range;
        set.push_back("integrator.unweighted=true");
        set.push_back("integrator.s=" + std::to_string(s));
        const Estimate one =
            mean_of({room_with(c.lights), "bdpt", "independent", set, 32}, 12, 100);
        expect_same(one, path,
                    std::string(c.name) + " bounces " + depth + " s " + std::to_string(s));
      }
    }
  }
}

TEST(Bdpt, LampSeenByTheLensAlone) {
  const std::string scene = room_with(lamp);
  const Estimate path = mean_of({scene, "path", "independent", {"integrator.maxdepth=0"}, 64}, 12);
  const Estimate lens = mean_of({scene,
                                 "bdpt",
                                 "independent",
                                 {"integrator.unweighted=true", "integrator.s=1", "integrator.t=1"},
                                 64},
                                12, 100);
  expect_same(lens, path, "s = t = 1");
}

TEST(Bdpt, HeuristicsAgree) {
  const std::string scene = room_with(std::string(lamp) + ball + sky);
  const Estimate power =
      mean_of({scene, "bdpt", "independent", {"integrator.heuristic=power"}, 32}, 12);
  const Estimate balance =
      mean_of({scene, "bdpt", "independent", {"integrator.heuristic=balance"}, 32}, 12, 100);
  expect_same(power, balance, "heuristics");
}

// Inside a sphere that emits L = 1 and reflects everything, radiance after d bounces is d + 1. At
// d = 40 there are vertices past those that are all joined with one another.
TEST(Integrators, LosslessSphereAtGreatDepth) {
  const std::string scene = R"(
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
PixelFilter "box"
Camera "perspective" "float fov" 60
Integrator "path" "integer maxdepth" 40
WorldBegin
Material "diffuse" "rgb reflectance" [ 1 1 1 ]
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
ReverseOrientation
Shape "sphere" "float radius" 1
)";
  for (const char* integrator : {"path", "bdpt", "light"}) {
    const Estimate e = mean_of({scene, integrator, "independent", {}, 16}, 12);
    expect_same(e, {41.0, 0.0}, integrator);
    EXPECT_LT(e.error(), 0.02 * e.mean) << integrator;
  }
}

TEST(Integrators, LeastAndGreatestDepthCutTheSeries) {
  // 0.5^2 + 0.5^3 + 0.5^4 of the same sphere at half its reflectance.
  const std::string scene = R"(
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
Integrator "path" "integer maxdepth" 4 "integer mindepth" 2
WorldBegin
Material "diffuse" "rgb reflectance" [ .5 .5 .5 ]
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
ReverseOrientation
Shape "sphere" "float radius" 1
)";
  for (const char* integrator : {"path", "bdpt", "light"}) {
    expect_same(mean_of({scene, integrator, "independent", {}, 64}, 12), {0.4375, 0.0}, integrator);
  }
}

// Numbers have addresses, so that a filter changes nothing about the paths that pass it: classes
// that split all paths add up sample by sample, whatever the weights.
TEST(Integrators, PathClassesAddUp) {
  const std::string scene = room_with(std::string(lamp) + ball + sky + point);
  for (const char* integrator : {"path", "light", "bdpt", "multiplexed", "whitted"}) {
    const auto mean = [&](const std::string& paths) {
      return mean_of({scene, integrator, "independent", {"integrator.paths=" + paths}, 8});
    };
    const double whole = mean("L.*E");
    EXPECT_GT(whole, 0.0);
    const double split = mean("LS*E") + mean("LS+D.*E") + mean("LD.*E");
    EXPECT_NEAR(split, whole, 1e-5 * whole) << integrator;
    const double by_light = mean("A.*E") + mean("I.*E") + mean("P.*E");
    EXPECT_NEAR(by_light, whole, 1e-5 * whole) << integrator;
    EXPECT_NEAR(mean("L.*E & LD.*E"), mean("LD.*E"), 1e-5 * whole) << integrator;
  }
}

// Not `multiplexed`, whose numbers choose the length.
TEST(Integrators, LengthsAddUp) {
  const std::string scene = room_with(std::string(lamp) + ball + sky + point);
  for (const char* integrator : {"path", "light", "bdpt", "whitted"}) {
    const auto mean = [&](int least, int most) {
      return mean_of({scene,
                      integrator,
                      "independent",
                      {"integrator.mindepth=" + std::to_string(least),
                       "integrator.maxdepth=" + std::to_string(most)},
                      8});
    };
    const double whole = mean(1, 4);
    EXPECT_NEAR(mean(1, 1) + mean(2, 2) + mean(3, 3) + mean(4, 4), whole, 1e-5 * whole)
        << integrator;
  }
}

// sees() names what an integrator finds: outside of it the picture is black, inside it is not.
TEST(Integrators, MaskAndCodeStayTogether) {
  const std::string scene = room_with(std::string(lamp) + ball + sky + point);
  const char* const classes[] = {"AE",      "IE",      "LDE",    "LDDE",  "LDS+E",
                                 "LS+DE",   "IS+E",    "AS+E",   "PS+E",  "PS+DE",
                                 "LS+DS+E", "PS+DS+E", "LD.*DE", "PD.*E", "PE"};
  for (const char* integrator : {"path", "light", "bdpt", "multiplexed", "whitted"}) {
    const BuiltScene built = build_text({scene, integrator, "independent"});
    const PathExpression mask(built.layers[0].integrator->sees());
    for (const char* one : classes) {
      const bool blind =
          PathExpression::disjoint(mask, PathExpression(one), built.scene->features(), 0, 5);
      const double mean =
          mean_of({scene,
                   integrator,
                   "independent",
                   {std::string("integrator.paths=") + one, "integrator.maxdepth=5"},
                   128});
      EXPECT_EQ(mean > 0.0, !blind) << integrator << " " << one << " " << mean;
    }
  }
}

TEST(Integrators, RefuseParametersThatDoNotFit) {
  const std::pair<const char*, const char*> bad[] = {{"path", "integrator.maxdepth=-1"},
                                                     {"path", "integrator.mindepth=-1"},
                                                     {"path", "integrator.mindepth=9"},
                                                     {"path", "integrator.maxdepth=300000000"},
                                                     {"path", "integrator.paths=L.*X"},
                                                     {"path", "integrator.lightsampler=any"},
                                                     {"bdpt", "integrator.heuristic=best"},
                                                     {"bdpt", "integrator.s=-2"},
                                                     {"bdpt", "integrator.t=0"},
                                                     {"light", "integrator.paths="},
                                                     {"whitted", "integrator.nonsense=1"}};
  for (const auto& [integrator, set] : bad) {
    EXPECT_THROW(build_text({room_with(lamp), integrator, "independent", {set}}), Error) << set;
  }
}

// Integrators of pbrt's under which the same picture appears here, with what does not apply to it.
TEST(Integrators, SayWhatIsNotApplied) {
  const std::pair<const char*, const char*> told[] = {
      {R"("path" "bool regularize" true)", "regularize is not applied"},
      {R"("bdpt" "bool visualizeweights" true)", "--per-strategy"},
      {R"("sppm" "float radius" 1)", "\"radius\" does not apply"},
      {R"("simplepath" "bool samplelights" false)", "\"samplelights\" does not apply"},
      {R"("randomwalk" "integer maxdepth" 3)", "stands for \"path\""}};
  for (const auto& [integrator, message] : told) {
    const BuiltScene built = build_text({std::string("Integrator ") + integrator + " WorldBegin"});
    EXPECT_TRUE(std::ranges::any_of(built.log, [&, text = message](const std::string& line) {
      return line.find(text) != std::string::npos;
    })) << integrator;
  }
  EXPECT_THROW(build_text({"Integrator \"sppm\" \"integer maxdpeth\" 3 WorldBegin"}), Error);
}

// A name that is near one of the chosen sampler's is no slip if the scene's own sampler has it.
TEST(Integrators, AnotherSamplersParametersAreNoSlips) {
  const std::string scene = "Sampler \"sobol\" \"integer pixelsamples\" 4 WorldBegin";
  const BuiltScene built = build_text({scene, "path", "pssmlt"});
  EXPECT_TRUE(std::ranges::any_of(built.log, [](const std::string& line) {
    return line.find("\"pixelsamples\" does not apply") != std::string::npos;
  }));
  const std::string slip = "Sampler \"sobol\" \"integer pilotsample\" 4 WorldBegin";
  EXPECT_THROW(build_text({slip, "path", "pssmlt"}), Error);
}

TEST(Integrators, AnEmptyWorldIsBlack) {
  const std::string scene =
      "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\nWorldBegin\n";
  for (const char* integrator : {"path", "light", "bdpt", "multiplexed", "whitted"}) {
    EXPECT_EQ(mean_of({scene, integrator, "independent", {}, 4}), 0.0) << integrator;
    EXPECT_GT(mean_of({scene + sky, integrator, "independent", {}, 4}), -1.0) << integrator;
  }
}

}  // namespace
}  // namespace pssmlt::test
