// Subsurface scattering against what its parameters promise. Means over the picture at z_limit
// standard errors (false alarm 1e-7 each) plus the error of the formula that is inverted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/color/fresnel.h"
#include "tests/support/render_text.h"
#include "tests/support/statistics.h"

namespace pssmlt::test {
namespace {

struct Mean {
  double value = 0.0, error = 0.0;
};

// Of the picture's luminance, over independent renders.
Mean mean_of(const std::string& scene, double spp) {
  constexpr int renders = 8;
  double sum = 0.0, squares = 0.0;
  for (uint64_t seed = 1; seed <= renders; ++seed) {
    const Job job{.scene = scene, .integrator = "path", .sampler = "sobol", .spp = spp};
    const double x = block_means(render_text(job, seed).image, 0)[0];
    sum += x;
    squares += x * x;
  }
  const double mean = sum / renders;
  return {mean, std::sqrt(std::max(0.0, squares / renders - mean * mean) / (renders - 1))};
}

// A thick body under a white sky, seen at this cosine.
std::string half_space(double mu, const std::string& material) {
  return fmt::format(R"(
LookAt {} 0 {}  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.1 .1 -.1 .1 ]
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
Integrator "path" "integer maxdepth" 3000
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "subsurface" {}
Shape "bilinearmesh" "point3 P" [ -9 -9 0  9 -9 0  -9 9 0  9 9 0 ]
)",
                     5 * std::sqrt(1 - mu * mu), 5 * mu, material);
}

// By reciprocity the share of diffuse light that comes back is the mean over directions of what a
// white sky shows.
TEST(Subsurface, GivesBackTheReflectanceThatWasAsked) {
  constexpr int views = 4;
  for (const auto& [reflectance, g, tolerance] :
       {std::array{.3, 0., .008}, {.7, 0., .008}, {.8, .6, .015}}) {
    double back = 0.0, entered = 0.0, variance = 0.0;
    for (int i = 0; i < views; ++i) {
      const double mu = std::sqrt((i + .5) / views);
      const double f = static_cast<double>(fresnel_dielectric(static_cast<float>(mu), 1.33f));
      const Mean m = mean_of(
          half_space(mu, fmt::format("\"rgb reflectance\" [ {0} {0} {0} ] \"rgb mfp\" [ .01 .01 "
                                     ".01 ] \"float eta\" 1.33 \"float g\" {1}",
                                     reflectance, g)),
          128);
      back += m.value - f;
      entered += 1.0 - f;
      variance += m.error * m.error;
    }
    EXPECT_NEAR(back / entered, reflectance, tolerance + z_limit * std::sqrt(variance) / entered)
        << g;
    EXPECT_LT(std::sqrt(variance) / entered, .003);
  }
}

// A profile gives back what was asked by construction, at each angle: what is not reflected enters,
// and what leaves under a white sky is the profile's integral, the rest of a thousandth cut off.
TEST(Subsurface, DiffusesTheReflectanceThatWasAsked) {
  for (const double mu : {1., .4}) {
    for (const double reflectance : {.2, .8}) {
      const double f = static_cast<double>(fresnel_dielectric(static_cast<float>(mu), 1.33f));
      const Mean m = mean_of(
          half_space(mu,
                     fmt::format("\"string method\" \"diffusion\" \"rgb reflectance\" [ {0} {0} "
                                 "{0} ] \"rgb mfp\" [ .01 .02 .005 ]",
                                 reflectance)),
          256);
      EXPECT_NEAR(m.value, f + (1.0 - f) * reflectance, z_limit * m.error + 1e-3) << mu;
      EXPECT_LT(m.error, .003);
    }
  }
}

// Each path is white if the channels scatter alike, and the mean is if they do not.
TEST(Subsurface, WithoutAbsorptionLosesNothing) {
  for (const auto& [scattering, spp] : {std::pair{"5 5 5", 64.0}, {"4 5 4.5", 512.0}}) {
    const Mean m = mean_of(fmt::format(R"(
LookAt 0 0 4  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.5 .5 -.5 .5 ]
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
Integrator "path" "integer maxdepth" 3000
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
Material "subsurface" "rgb sigma_a" [ 0 0 0 ] "rgb sigma_s" [ {} ] "float g" .5 "float eta" 1.4
Shape "sphere"
)",
                                       scattering),
                           spp);
    EXPECT_NEAR(m.value, 1.0, z_limit * m.error + 1e-5) << scattering;
    EXPECT_LT(m.error, spp > 64.0 ? .004 : 1e-5);
  }
}

}  // namespace
}  // namespace pssmlt::test
