// Pictures put together: masks hold by experiment, a crop shows what the full picture shows there,
// layers under different samplers sum to the whole, and chains err as their statistics say.
#include <gtest/gtest.h>

#include "tests/correctness/classes.h"
#include "tests/correctness/scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/statistics.h"

namespace pssmlt::test {
namespace {

// All kinds of light, mirrors and glass, in a few pixels.
std::string everything(const std::string& options) {
  return R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
PixelFilter "box"
LookAt 0 1 -3.2  0 1 0  0 1 0
Camera "perspective" "float fov" 50
)" + options +
         R"(
WorldBegin
)" + room +
         R"(
LightSource "infinite" "rgb L" [ .5 .5 .5 ]
LightSource "point" "rgb I" [ 1 1 1 ] "point3 from" [ .4 1.5 -.4 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 3 3 3 ] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [ -.6 1.9 -.4  .6 1.9 -.4  -.6 1.9 .4  .6 1.9 .4 ]
AttributeEnd
AttributeBegin
  Material "dielectric" "float eta" 1.5
  Translate -.4 .6 0
  Shape "sphere" "float radius" .5
AttributeEnd
AttributeBegin
  Material "conductor" "rgb reflectance" [ .9 .9 .9 ] "float roughness" 0
  Translate .55 .4 .2
  Shape "sphere" "float radius" .4
AttributeEnd
MakeNamedMedium "glow" "string type" "homogeneous" "rgb sigma_a" [ 1 1 1 ]
  "rgb sigma_s" [ 2 2 2 ] "rgb Le" [ 1 1 1 ]
AttributeBegin
  MediumInterface "glow" ""
  Material "interface"
  Translate 0 .4 -.7
  Shape "sphere" "float radius" .25
AttributeEnd
)";
}

const std::string chains = R"(
Sampler "pssmlt" "integer bootstrapsamples" 16384 "integer chains" 32
  "float filmprobability" 0.1 "float streamprobability" 0.2
  "float largestepprobability" .5
)";

class Masks : public testing::TestWithParam<std::string> {};

// Every class of up to four segments by itself: light is found if and only if the mask says so.
// Deterministic: fixed seeds; in a class that is seen 49152 samples find something.
TEST_P(Masks, HoldByExperiment) {
  const std::string& integrator = GetParam();
  const std::string scene = everything("Integrator \"path\" \"integer maxdepth\" 3");
  const PathExpression mask(sees(integrator));
  for (const std::string& path : all_classes(3)) {
    const Job job{.scene = scene,
                  .integrator = integrator,
                  .sampler = "independent",
                  .set = {"integrator.paths=" + path},
                  .spp = 256};
    // Most classes are found at once.
    double mean = 0.0;
    for (const double spp : {4.0, 256.0, 32768.0}) {
      // One of some twenty parts a sample: what is to be seen is looked for longer.
      if (spp > 256.0 && !(is_for_chains(integrator) && mask.matches(path))) continue;
      Job now = job;
      now.spp = spp;
      if (mean == 0.0) mean = block_means(render_text(now, 1).image, 0)[0];
    }
    if (path.size() == 2 && path[0] == 'P') {
      EXPECT_EQ(mean, 0.0) << "no camera sees a point: " << integrator;
    } else {
      EXPECT_EQ(mean > 0.0, mask.matches(path)) << integrator << " " << path;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Masks, testing::ValuesIn(integrators()),
                         [](const auto& test) { return test.param; });

struct Window {
  int x0, x1, y0, y1;
};

double window_mean(const Image& picture, const Window& w) {
  double sum = 0.0;
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const float* c = picture.pixel(x, y);
      sum += static_cast<double>(luminance(Rgb(c[0], c[1], c[2])));
    }
  }
  return sum / ((w.x1 - w.x0) * (w.y1 - w.y0));
}

// The mean over a window of the full picture, and of the crop alone: not square, odd, one pixel.
TEST(Crop, ShowsWhatTheFullPictureShowsThere) {
  constexpr int renders = 24;
  const Window windows[] = {{3, 10, 7, 10}, {0, 5, 1, 12}, {9, 10, 3, 4}};
  // Three comparisons a sampler, at 4e-8: false alarms below 10^-6 for up to eight of them.
  const double limit = student_limit(4e-8, renders - 1);
  for (const std::string& sampler : samplers()) {
    Job job{.scene = everything(chains + "Integrator \"bdpt\" \"integer maxdepth\" 2"),
            .integrator = sees_most(),
            .sampler = sampler,
            .spp = 128};
    std::vector<Image> full;
    for (uint64_t seed = 1; seed <= renders; ++seed) full.push_back(render_text(job, seed).image);
    for (const Window& w : windows) {
      job.crop = {w.x0, w.x1, w.y0, w.y1};
      std::vector<double> inside, alone;
      for (const Image& picture : full) inside.push_back(window_mean(picture, w));
      for (uint64_t seed = 101; seed <= 100 + renders; ++seed) {
        const Image picture = render_text(job, seed).image;
        ASSERT_EQ(picture.width, w.x1 - w.x0);
        ASSERT_EQ(picture.height, w.y1 - w.y0);
        alone.push_back(block_means(picture, 0)[0]);
      }
      const Estimate a = estimate(inside), b = estimate(alone);
      const double error = std::sqrt(a.variance + b.variance);
      EXPECT_LE(std::abs(a.mean - b.mean), limit * error)
          << sampler << ", window at " << w.x0 << ", " << w.y0 << ": " << a.mean << " +- "
          << a.error() << " against " << b.mean << " +- " << b.error();
      EXPECT_LT(limit * error, .5 * a.mean) << sampler << ": too noisy to tell anything";
    }
  }
}

// Direct light without chains, the rest by chains, against one path tracer.
TEST(Layers, DirectLightAndChainsSumToTheWhole) {
  const std::string layers = R"(
LayerBegin "direct" Sampler "sobol" Integrator "path" "integer maxdepth" 1 LayerEnd
LayerBegin "rest" )" + chains +
                             R"( Integrator "path" "integer mindepth" 2 "integer maxdepth" 3
LayerEnd
)";
  const std::string whole = "Integrator \"path\" \"integer maxdepth\" 3";
  const Job sum{.scene = everything(layers), .spp = 128};
  const Job one{.scene = everything(whole), .sampler = "sobol", .spp = 64};
  const Blocks truth = summarise(render_blocks(one, 32, 6));
  const Blocks blocks = summarise(render_blocks(sum, 32, 6, 101));
  // False alarms below 10^-6; powers as stated.
  expect_agreement(blocks, truth, {5e-7, .1, .02}, "two layers");
}

// Many seeds of short Metropolis renders: scatter around a long render by other means, block by
// block, must be what Student's t of the seeds says, i.e. the mean of all is right to its own
// standard error: chi-square of the z-scores of the blocks, over 100 seeds. Neighbouring blocks of
// a chain are anticorrelated (the sum is known better than its parts), which makes the statistic
// smaller, not larger. With t at 99 degrees of freedom in place of normal scores the variance is
// 1.02 instead of 1. False alarms: 10^-7.
TEST(Chains, ScatterAroundTheTruth) {
  const AgreementScene scene = normals_scene();
  Job job{.scene = scene.text, .integrator = sees_most(), .sampler = "pssmlt", .spp = 16};
  const Blocks chain = summarise(render_blocks(job, 100, 8));
  job.sampler = default_plugins().sampler;
  job.spp = 64;
  const Blocks truth = summarise(render_blocks(job, 32, 8, 1001));
  double statistic = 0.0;
  const size_t blocks = truth.estimates.size() - 1;
  for (size_t i = 0; i < blocks; ++i) {
    const Estimate &a = chain.estimates[i], &b = truth.estimates[i];
    const double z2 = (a.mean - b.mean) * (a.mean - b.mean) / (a.variance + b.variance);
    statistic += z2 / 1.02;
  }
  EXPECT_GT(chi_square_tail(statistic, static_cast<double>(blocks)), 1e-7) << statistic;
  expect_agreement(chain, truth, {5e-7, .12, .02}, "chains");
}

}  // namespace
}  // namespace pssmlt::test
