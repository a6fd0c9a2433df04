// Do the error bars hold? Many small renders of each technique with seeds of their own: how often
// the 95 % interval of the picture's mean, and of the means of its blocks, holds the truth, which a
// much longer render of other seeds gives. `bench/coverage [renders] [scene] [technique...]`;
// docs/results.md has a table. Scenes have finite kurtosis: no light is met by chance alone,
// nothing is close to a lamp or the camera.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "app/defaults.h"
#include "core/render/session.h"
#include "core/scene/parser.h"

namespace {

using namespace pssmlt;

constexpr const char* room = R"(Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "box"
LookAt 0 -4 1.2  0 0 .8  0 0 1
Camera "perspective" "float fov" 45
WorldBegin
AttributeBegin
Translate 0 -1 3
AreaLightSource "diffuse" "rgb L" [ 8 7 6 ] "bool twosided" true
Shape "disk" "float radius" .5
AttributeEnd
Material "diffuse" "rgb reflectance" [ .7 .6 .5 ]
Shape "disk" "float radius" 6
AttributeBegin
Translate 0 0 .6
Shape "sphere" "float radius" .6
AttributeEnd
Translate 0 4 0
Rotate 90 1 0 0
Material "diffuse" "rgb reflectance" [ .3 .5 .7 ]
Shape "disk" "float radius" 6
)";
constexpr const char* garden = R"(Film "rgb" "integer xresolution" 32 "integer yresolution" 32
PixelFilter "box"
LookAt 0 -4 1.2  0 0 .8  0 0 1
Camera "perspective" "float fov" 45
WorldBegin
LightSource "infinite" "rgb L" [ .4 .5 .7 ]
LightSource "distant" "point3 from" [ 1 -1 2 ] "point3 to" [ 0 0 0 ] "rgb L" [ 2 1.8 1.5 ]
Material "diffuse" "rgb reflectance" [ .5 .6 .3 ]
Shape "disk" "float radius" 6
Translate 0 0 .7
Material "conductor" "float roughness" .4
Shape "sphere" "float radius" .7
)";

struct SmallScene {
  const char* name;
  const char* text;
};
constexpr SmallScene scenes[] = {{"room", room}, {"garden", garden}};

struct Technique {
  std::string name, integrator, sampler;
  double spp = 32.0;
  std::vector<std::string> set = {};
};
// Small pictures need no 100000 candidates.
const std::vector<std::string> chains = {"sampler.bootstrapsamples=4000", "sampler.chains=128"};
// A limit that leaves chains something to do in scenes as quiet as these.
const std::vector<std::string> excess = {"sampler.threshold=1.5", "sampler.chainshare=0.3",
                                         "sampler.bootstrapsamples=4000", "sampler.stickiness=8"};
const std::vector<std::string> spread = {"sampler.threshold=1.5", "sampler.mutations=1",
                                         "sampler.chainlength=20", "sampler.pilotsamples=4000"};
const std::vector<Technique> techniques = {
    {"path/independent", "path", "independent"},
    {"path/stratified", "path", "stratified"},
    {"path/sobol", "path", "sobol"},
    {"light/independent", "light", "independent"},
    {"light/sobol", "light", "sobol"},
    {"bdpt/independent", "bdpt", "independent"},
    {"bdpt/sobol", "bdpt", "sobol"},
    {"pssmlt/path", "path", "pssmlt", 64.0, chains},
    {"pssmlt/bdpt", "bdpt", "pssmlt", 64.0, chains},
    {"excess/path", "path", "excess", 64.0, excess},
    {"excess/bdpt", "bdpt", "excess", 64.0, excess},
    {"erpt/path", "path", "erpt", 64.0, spread},
    {"erpt/bdpt", "bdpt", "erpt", 64.0, spread},
};

BuiltScene build(const SmallScene& scene, const Technique& t) {
  BuildOptions options;
  options.defaults = default_plugins();
  options.integrator = t.integrator;
  options.sampler = t.sampler;
  options.set = {"integrator.maxdepth=3"};
  options.set.insert(options.set.end(), t.set.begin(), t.set.end());
  return build_scene(parse_string(scene.text, scene.name), options);
}

// Means of the picture and of its blocks with their half widths, as the program states them.
struct Interval {
  double mean = 0.0, half_width = 0.0;
};
struct Estimates {
  Interval picture;
  std::vector<Interval> blocks;
};

// `common`: deviation of what all groups have in common.
Interval interval(const std::vector<double>& groups, double common) {
  const auto n = static_cast<double>(groups.size());
  double mean = 0.0, variance = 0.0;
  for (const double g : groups) mean += g / n;
  for (const double g : groups) variance += (g - mean) * (g - mean) / (n * (n - 1.0));
  return {mean, student_quantile(n - 1.0) * std::sqrt(variance + common * common)};
}

Estimates estimate(const BuiltScene& scene, double spp, uint64_t seed) {
  RenderSettings settings;
  settings.spp = spp;
  settings.seed = seed;
  settings.threads = 1;
  const RenderCallbacks none;
  Session session(scene, settings, none);
  session.prepare();
  while (session.step()) {
  }
  const ErrorEstimate error = session.result(false).error;
  Estimates e;
  if (!error.mean_known) return e;
  e.picture = {error.mean, 0.5 * (error.mean_high - error.mean_low)};
  const GroupBlocks groups = session.group_blocks();
  for (size_t b = 0; b < groups.means.at(0).size(); ++b) {
    std::vector<double> column;
    for (const auto& row : groups.means) column.push_back(row[b]);
    e.blocks.push_back(interval(column, groups.common[b]));
  }
  return e;
}

// The truth for a class of techniques: `path` sees all, `light` not what is mirrored or seen
// directly.
std::vector<double> truth(const SmallScene& scene, const Technique& t, std::vector<double>& error) {
  Technique best = t;
  best.sampler = "sobol";
  best.set.clear();
  if (t.integrator != "light") best.integrator = "path";
  const BuiltScene built = build(scene, best);
  constexpr int seeds = 16;
  std::vector<double> sum, squares;
  for (int s = 0; s < seeds; ++s) {
    const Estimates e = estimate(built, 1024.0, 1'000'000 + static_cast<uint64_t>(s));
    std::vector<double> values = {e.picture.mean};
    for (const Interval& b : e.blocks) values.push_back(b.mean);
    sum.resize(values.size()), squares.resize(values.size());
    for (size_t i = 0; i < values.size(); ++i)
      sum[i] += values[i], squares[i] += values[i] * values[i];
  }
  error.clear();
  for (size_t i = 0; i < sum.size(); ++i) {
    sum[i] /= seeds;
    error.push_back(std::sqrt(std::max(0.0, squares[i] / seeds - sum[i] * sum[i]) / (seeds - 1.0)));
  }
  return sum;
}

struct Coverage {
  double held = 0.0, count = 0.0, z2 = 0.0, width = 0.0, sum = 0.0, squares = 0.0;
  void add(const Interval& i, double truth) {
    held += std::fabs(i.mean - truth) <= i.half_width ? 1.0 : 0.0;
    width += i.half_width / truth;
    sum += i.mean / truth - 1.0;
    squares += (i.mean / truth - 1.0) * (i.mean / truth - 1.0);
    count += 1.0;
  }
  double share() const { return 100.0 * held / count; }
  double deviation() const { return std::sqrt(squares / count); }
  // Stated deviation (half width over Student's quantile) over the true one.
  double stated() const { return width / count / 2.04 / deviation(); }
};

void measure(const SmallScene& scene, const Technique& t, int renders,
             const std::vector<double>& truth, const std::vector<double>& truth_error) {
  const BuiltScene built = build(scene, t);
  Coverage picture, blocks;
  for (int r = 0; r < renders; ++r) {
    const Estimates e = estimate(built, t.spp, 1 + static_cast<uint64_t>(r));
    picture.add(e.picture, truth[0]);
    for (size_t b = 0; b < e.blocks.size(); ++b) blocks.add(e.blocks[b], truth[b + 1]);
  }
  fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {:.2g} | {:.2g} |\n", scene.name,
             t.name, renders, picture.share(), blocks.share(), picture.stated(), blocks.stated(),
             picture.deviation(), truth_error[0] / truth[0] / picture.deviation());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int renders = argc > 1 ? std::atoi(argv[1]) : 1000;
  fmt::print(
      "| scene | technique | renders | picture [%] | blocks [%] | stated/true, picture | blocks | "
      "relative deviation | truth's error / deviation |\n|---|---|---|---|---|---|---|---|---|\n");
  const auto named = [&](const std::string& name) {
    for (int a = 2; a < argc; ++a) {
      if (name == argv[a]) return true;
    }
    return false;
  };
  const bool one_scene = named(scenes[0].name) != named(scenes[1].name);
  bool one_technique = false;
  for (const Technique& t : techniques) one_technique = one_technique || named(t.name);
  for (const SmallScene& scene : scenes) {
    if (one_scene && !named(scene.name)) continue;
    for (const bool light : {false, true}) {
      std::vector<double> error, exact;
      for (const Technique& t : techniques) {
        const bool wanted = !one_technique || named(t.name);
        if (!wanted || (t.integrator == "light") != light) continue;
        if (exact.empty()) exact = truth(scene, t, error);
        measure(scene, t, renders, exact, error);
      }
    }
  }
  return 0;
}
