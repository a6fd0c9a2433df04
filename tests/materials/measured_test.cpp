// Materials from files of measurements: tables written from formulas are read back as them, and
// samples follow their densities.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/warp.h"
#include "tests/support/chi_square.h"
#include "tests/support/make_plugin.h"
#include "tests/support/measured_files.h"
#include "tests/support/temporary_folder.h"

namespace pssmlt {
namespace {

using namespace test;

const Rgb grey(.2f, .5f, .8f);
Rgb lambert(const vec3&, const vec3&) { return grey * inv_pi; }

struct Made {
  explicit Made(const std::string& bytes, const std::string& name = "table") {
    const std::string path = own_file(name);
    write_bytes(path, bytes);
    material = make_material("measured", {text("filename", path)});
    bsdf = material->bsdf(Hit(), {}, storage);
  }
  std::shared_ptr<const Material> material;
  BsdfStorage storage;
  const Bsdf* bsdf;
};

vec3 above(RandomStream& random, float lowest) {
  const float x = random.next();
  const float y = random.next();
  return direction_at_height(lowest + (1.f - lowest) * x, y);
}

// A rough conductor, by the plugin of that name.
struct Conductor {
  explicit Conductor(float ax, float ay)
      : material(make_material("conductor",
                               {number("uroughness", ax), number("vroughness", ay),
                                flag("remaproughness", false), rgb("reflectance", .9f, .6f, .3f)})),
        bsdf(material->bsdf(Hit(), {}, storage)) {}
  Brdf f() const {
    return
        [this](const vec3& wo, const vec3& wi) { return bsdf->eval(wo, wi, Transport::radiance); };
  }
  std::shared_ptr<const Material> material;
  BsdfStorage storage;
  const Bsdf* bsdf;
};

std::vector<float> circle(float from, float to, int n) {
  std::vector<float> angles;
  for (int i = 0; i < n; ++i)
    angles.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(n - 1));
  return angles;
}

// Largest relative difference of two in the mean over directions, and its largest single one.
struct Difference {
  double mean = 0., most = 0.;
};
Difference difference(const Bsdf& a, const Brdf& b, float lowest = .25f) {
  RandomStream random(9, RandomUse::test);
  Difference d;
  constexpr int pairs = 4000;
  for (int i = 0; i < pairs; ++i) {
    const vec3 wo = above(random, lowest);
    const vec3 wi = above(random, lowest);
    const Rgb x = a.eval(wo, wi, Transport::radiance), y = b(wo, wi);
    for (int c = 0; c < 3; ++c) {
      const double relative = double(std::abs(x[c] - y[c])) / double(std::max(y[c], 1e-2f));
      d.mean += relative / (3. * pairs);
      d.most = std::max(d.most, relative);
    }
  }
  return d;
}

// The table's own error, with its second order: twice the nodes, less than half of it. Single pairs
// are off by more where a cell reaches below the horizon.
TEST(Measured, LambertFromTensorsIsLambert) {
  double coarser = infinity;
  for (const int size : {24, 48, 96}) {
    RglOptions options{.normals = Ggx(1.f, 1.f), .size = size};
    options.theta = circle(.01f, .5f * pi - .01f, 24);
    Made table(tensor_file(lambert, options).bytes());
    const Difference d = difference(*table.bsdf, lambert);
    EXPECT_LT(d.mean, .5 * coarser) << size;
    EXPECT_LT(d.most, .25) << size;
    coarser = d.mean;
  }
  EXPECT_LT(coarser, 1.5e-3);
}

TEST(Measured, LambertFromMerlIsLambertExactly) {
  Made table(merl_file(lambert));
  const Difference d = difference(*table.bsdf, lambert, 0.f);
  EXPECT_LT(d.most, 1e-5);
}

TEST(Measured, ConductorFromTensors) {
  const Conductor metal(.4f, .4f);
  Made table(tensor_file(metal.f(), {.normals = Ggx(.4f, .4f), .size = 64}).bytes());
  const Difference d = difference(*table.bsdf, metal.f());
  EXPECT_LT(d.mean, .02);
  EXPECT_LT(d.most, .25);
}

TEST(Measured, ConductorFromMerl) {
  const Conductor metal(.3f, .3f);
  Made table(merl_file(metal.f(), {90, 90, 180}));
  const Difference d = difference(*table.bsdf, metal.f());
  EXPECT_LT(d.mean, .005);
  EXPECT_LT(d.most, .05);
}

// Azimuths over a whole circle, and over the half and the quarter that this material needs.
TEST(Measured, AnisotropicConductorFromTensors) {
  const Conductor metal(.6f, .3f);
  const std::vector<std::vector<float>> ranges = {circle(-pi, pi, 17), circle(0.f, 2.f * pi, 17),
                                                  circle(0.f, pi, 9), circle(0.f, .5f * pi, 5)};
  for (const auto& phi : ranges) {
    Made table(tensor_file(metal.f(), {.normals = Ggx(.6f, .3f), .phi = phi, .size = 48}).bytes());
    const Difference d = difference(*table.bsdf, metal.f());
    EXPECT_LT(d.mean, .06) << phi.size();
    EXPECT_LT(d.most, .6) << phi.size();
  }
}

TEST(Measured, WithoutJacobianTheFileHasTheCosineTimesF) {
  Made table(
      tensor_file(lambert, {.normals = Ggx(1.f, 1.f), .jacobian = false, .size = 48}).bytes());
  const Difference d = difference(*table.bsdf, lambert);
  EXPECT_LT(d.mean, .01);
  EXPECT_LT(d.most, .25);
}

// Constant spectra are grey, whatever the wavelengths; a band becomes the colour that the spectra
// of scene files become.
TEST(Measured, SpectraBecomeRgbAsElsewhere) {
  const auto white = [](const vec3&, const vec3&) { return Rgb(.5f * inv_pi); };
  RglOptions options{.normals = Ggx(1.f, 1.f), .size = 16};
  for (float l = 390.f; l < 700.f; l += 10.f) options.wavelengths.push_back(l);
  const vec3 wo = polar(.3f, 1.f), wi = polar(.5f, 2.f);
  Made neutral(tensor_file(white, options).bytes());
  const Rgb n = neutral.bsdf->eval(wo, wi, Transport::radiance);
  EXPECT_NEAR(n.x / n.y, 1.f, 1e-4f);
  EXPECT_NEAR(n.z / n.y, 1.f, 1e-4f);
  Made bands(tensor_file(lambert, options).bytes());
  const Rgb b = bands.bsdf->eval(wo, wi, Transport::radiance);
  // The same bands, with the same slopes between 10 nm, in a scene.
  std::vector<float> spectrum;
  for (const float l : options.wavelengths) {
    spectrum.push_back(l);
    spectrum.push_back(band(grey, l));
  }
  spectrum.insert(spectrum.begin(), {350.f, grey.z});
  spectrum.insert(spectrum.end(), {840.f, grey.x});
  const auto paint =
      make_material("diffuse", {floats(ParameterType::Spectrum, "reflectance", spectrum)});
  BsdfStorage storage;
  const Rgb expected = paint->bsdf(Hit(), {}, storage)->albedo(wo);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[c] / n.y * .5f, expected[c], 2e-3f) << c;
}

std::vector<std::pair<std::string, std::string>> tables() {
  static const Conductor narrow(.15f, .15f), skewed(.5f, .25f);
  const Brdf glossy = [](const vec3& wo, const vec3& wi) {
    return .5f * lambert(wo, wi) + .5f * narrow.f()(wo, wi);
  };
  return {
      {"merl lambert", merl_file(lambert)},
      {"merl glossy", merl_file(glossy)},
      {"merl narrow", merl_file(narrow.f())},
      {"rgl lambert", tensor_file(lambert, {.normals = Ggx(1.f, 1.f)}).bytes()},
      {"rgl conductor", tensor_file(narrow.f(), {.normals = Ggx(.15f, .15f)}).bytes()},
      {"rgl anisotropic",
       tensor_file(skewed.f(), {.normals = Ggx(.5f, .25f), .phi = circle(-pi, pi, 9)}).bytes()},
      {"rgl half",
       tensor_file(skewed.f(), {.normals = Ggx(.5f, .25f), .phi = circle(0.f, pi, 5)}).bytes()}};
}

std::optional<BsdfSample> draw(const Bsdf& bsdf, RandomStream& random, const vec3& wo,
                               Transport mode) {
  const float lobe = random.next();
  const float x = random.next();
  const float y = random.next();
  return bsdf.sample(wo, lobe, {x, y}, mode);
}

// 21 tests at 1e-7 each.
TEST(Measured, DirectionsFollowTheirDensity) {
  uint64_t seed = 1;
  for (const auto& [name, bytes] : tables()) {
    Made table(bytes);
    for (const vec3& wo : {polar(.1f, 1.f), polar(.9f, -2.f), -polar(1.3f, 2.f)}) {
      const auto result = chi_square_sphere(
          [&](RandomStream& random) -> std::optional<vec3> {
            const auto s = draw(*table.bsdf, random, wo, Transport::radiance);
            return s ? std::optional(s->wi) : std::nullopt;
          },
          [&](const vec3& wi) { return double(table.bsdf->pdf(wo, wi)); },
          {.samples = 50'000, .fine = 32, .seed = seed++});
      EXPECT_GT(result.p, false_alarm) << name << " " << wo.z;
      EXPECT_NEAR(result.integral + result.failures, 1., 1e-2) << name << " " << wo.z;
    }
  }
}

// What samples say is what eval and pdf say, and their mean is the integral of f cos.
TEST(Measured, SamplesSayWhatEvalSays) {
  RandomStream random(3, RandomUse::test);
  for (const auto& [name, bytes] : tables()) {
    Made table(bytes);
    for (const Transport mode : {Transport::radiance, Transport::importance}) {
      const vec3 wo = polar(.7f, -1.f);
      double sum = 0., squares = 0., integral = 0.;
      constexpr int samples = 20000, steps = 400;
      for (int i = 0; i < samples; ++i) {
        const auto s = draw(*table.bsdf, random, wo, mode);
        if (!s) continue;
        ASSERT_NEAR(s->pdf, table.bsdf->pdf(wo, s->wi), 1e-3f * s->pdf);
        ASSERT_NEAR(s->pdf_reverse, table.bsdf->pdf(s->wi, wo), 1e-3f * s->pdf_reverse);
        const Rgb expected = table.bsdf->eval(wo, s->wi, mode) * (s->wi.z / s->pdf);
        ASSERT_NEAR(s->weight.y, expected.y, 1e-3f * expected.y);
        sum += double(s->weight.y);
        squares += sqr(double(s->weight.y));
      }
      for (int j = steps / 2; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
          const vec3 wi = direction_of({(i + .5) / steps, (j + .5) / steps});
          integral += double(table.bsdf->eval(wo, wi, mode).y * wi.z);
        }
      integral *= 4. * std::numbers::pi / (double(steps) * steps);
      const double mean = sum / samples;
      const double error = std::sqrt(std::max(0., squares / samples - mean * mean) / samples);
      EXPECT_NEAR(mean, integral, z_limit * error + 5e-3) << name;
    }
  }
}

// MERL's coordinates make f symmetric; of the other tables importance is the exact adjoint. Both
// sides are alike.
TEST(Measured, IsReciprocalAsFarAsTheDataAre) {
  RandomStream random(4, RandomUse::test);
  for (const auto& [name, bytes] : tables()) {
    Made table(bytes);
    for (int i = 0; i < 1000; ++i) {
      const vec3 a = above(random, 0.01f);
      const vec3 b = above(random, 0.01f);
      const Rgb f = table.bsdf->eval(a, b, Transport::radiance);
      EXPECT_EQ(f, table.bsdf->eval(b, a, Transport::importance));
      EXPECT_EQ(f, table.bsdf->eval(-a, -b, Transport::radiance));
      EXPECT_TRUE(is_black(table.bsdf->eval(a, -b, Transport::radiance)));
      if (name.starts_with("rgl")) continue;
      const Rgb back = table.bsdf->eval(b, a, Transport::radiance);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], back[c], 2e-3f * f[c] + 1e-5f) << name;
    }
  }
}

// A table that reflects more than it gets is used as it is.
TEST(Measured, DataAreNotChanged) {
  const auto bright = [](const vec3&, const vec3&) { return Rgb(1.4f * inv_pi); };
  Made table(merl_file(bright));
  EXPECT_NEAR(table.bsdf->albedo({0.f, 0.f, 1.f}).y, 1.4f, .02f);
  EXPECT_NEAR(table.bsdf->eval(polar(.3f, 0.f), polar(.4f, 1.f), Transport::radiance).y,
              1.4f * inv_pi, 1e-4f);
  const auto s = table.bsdf->sample(polar(.3f, 0.f), .2f, {.3f, .4f}, Transport::radiance);
  ASSERT_TRUE(s);
  EXPECT_GT(s->weight.y, 1.f);
}

}  // namespace
}  // namespace pssmlt
