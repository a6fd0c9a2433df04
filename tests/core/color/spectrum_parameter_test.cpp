// Parameters of scene files as RGB: the three uses, the three types, files, clipping and errors.
#include "core/color/spectrum_parameter.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "core/color/color_space.h"
#include "core/color/color_warnings.h"
#include "core/color/named_spectra.h"

namespace pssmlt {
namespace {

class Folder final : public SceneResolver {
 public:
  std::shared_ptr<const Texture<float>> float_texture(const std::string&,
                                                      const Location&) override {
    return nullptr;
  }
  std::shared_ptr<const Texture<Rgb>> rgb_texture(const std::string&, const Location&) override {
    return nullptr;
  }
  std::string resolve_path(const std::string& name) const override {
    return (std::filesystem::path(testing::TempDir()) / name).string();
  }
  std::shared_ptr<const Material> material(const std::string&, const Location&) override {
    return nullptr;
  }
};

Parameter numbers(ParameterType type, std::vector<float> values, const char* space = nullptr) {
  Parameter p{};
  p.type = type;
  p.name = "L";
  p.where = {std::make_shared<const std::string>("scene.pbrt"), 12, 3};
  p.floats = std::move(values);
  if (space != nullptr) p.color_space = std::make_shared<const std::string>(space);
  return p;
}

Parameter named(const std::string& name) {
  Parameter p = numbers(ParameterType::Spectrum, {});
  p.strings = {name};
  return p;
}

Rgb converted(const Parameter& p, SpectrumUse use) { return spectrum_to_rgb(p, use, Folder()); }

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of(const Parameter& p, SpectrumUse use = SpectrumUse::Illuminant) {
  return error_of([&] { converted(p, use); });
}

void expect_near(const Rgb& value, const Rgb& expected, float tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

class SpectrumParameter : public testing::Test {
 protected:
  void SetUp() override { take_color_warnings(); }
};

TEST_F(SpectrumParameter, RgbPassesThrough) {
  const Rgb c(0.1f, 0.5f, 0.9f);
  for (const SpectrumUse use :
       {SpectrumUse::Albedo, SpectrumUse::Illuminant, SpectrumUse::Unbounded})
    for (const char* space : {static_cast<const char*>(nullptr), "srgb"})
      EXPECT_EQ(converted(numbers(ParameterType::Rgb, {c.x, c.y, c.z}, space), use), c);
  const Parameter bright = numbers(ParameterType::Rgb, {20.f, 0.f, 3.f});
  EXPECT_EQ(converted(bright, SpectrumUse::Illuminant), Rgb(20.f, 0.f, 3.f));
  EXPECT_EQ(converted(bright, SpectrumUse::Unbounded), Rgb(20.f, 0.f, 3.f));
  EXPECT_TRUE(take_color_warnings().empty());
}

TEST_F(SpectrumParameter, AlbedoAboveOneIsClippedAndReported) {
  EXPECT_EQ(converted(numbers(ParameterType::Rgb, {1.5f, 0.5f, 0.2f}), SpectrumUse::Albedo),
            Rgb(1.f, 0.5f, 0.2f));
  const std::vector<std::string> warnings = take_color_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("scene.pbrt:12:3"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("\"L\""), std::string::npos) << warnings[0];
  EXPECT_TRUE(take_color_warnings().empty());
}

TEST_F(SpectrumParameter, WideGamutIsConvertedAndClipped) {
  const Rgb inside = converted(numbers(ParameterType::Rgb, {0.5f, 0.4f, 0.3f}, "rec2020"),
                               SpectrumUse::Illuminant);
  expect_near(inside, Rgb(*rec709_from("rec2020", SpectrumUse::Illuminant) * dvec3(0.5, 0.4, 0.3)),
              1e-6f);
  EXPECT_TRUE(take_color_warnings().empty());
  const Rgb green =
      converted(numbers(ParameterType::Rgb, {0.f, 1.f, 0.f}, "rec2020"), SpectrumUse::Illuminant);
  EXPECT_EQ(green.x, 0.f);
  EXPECT_NEAR(green.y, 1.133f, 1e-3f);
  EXPECT_EQ(green.z, 0.f);
  EXPECT_EQ(take_color_warnings().size(), 1u);
}

TEST_F(SpectrumParameter, WarningsAreCountedBeyondAHundred) {
  for (int i = 0; i < 130; ++i)
    converted(numbers(ParameterType::Rgb, {-1.f, 0.f, 0.f}), SpectrumUse::Illuminant);
  const std::vector<std::string> warnings = take_color_warnings();
  ASSERT_EQ(warnings.size(), 101u);
  EXPECT_NE(warnings.back().find("30 more"), std::string::npos);
}

TEST_F(SpectrumParameter, IlluminantsAreScaledToLuminanceOne) {
  expect_near(converted(named("stdillum-D65"), SpectrumUse::Illuminant), Rgb(1.f), 1e-5f);
  for (const float temperature : {2700.f, 4000.f, 5500.f, 6504.f, 12000.f}) {
    const Rgb rgb =
        converted(numbers(ParameterType::Blackbody, {temperature}), SpectrumUse::Illuminant);
    EXPECT_NEAR(luminance(rgb), 1.f, 1e-3f) << temperature;
  }
  // The magnitude of a spectrum does not matter.
  const Rgb dim = converted(numbers(ParameterType::Spectrum, {400.f, 1.f, 700.f, 2.f}),
                            SpectrumUse::Illuminant);
  const Rgb bright = converted(numbers(ParameterType::Spectrum, {400.f, 50.f, 700.f, 100.f}),
                               SpectrumUse::Illuminant);
  expect_near(dim, bright, 1e-5f);
  EXPECT_NEAR(luminance(dim), 1.f, 1e-3f);
  EXPECT_TRUE(take_color_warnings().empty());
}

TEST_F(SpectrumParameter, BlackBodiesHaveTheColourOfThePlanckianLocus) {
  // From the chromaticities (0.4599, 0.4106), (0.3324, 0.3410) and (0.3135, 0.3237) with Y = 1
  // through the matrix of IEC 61966-2-1.
  const auto rgb = [](float temperature) {
    return converted(numbers(ParameterType::Blackbody, {temperature}), SpectrumUse::Illuminant);
  };
  expect_near(rgb(2700.f), Rgb(1.935f, 0.804f, 0.192f), 0.01f);
  expect_near(rgb(5500.f), Rgb(1.143f, 0.971f, 0.866f), 0.01f);
  expect_near(rgb(6504.f), Rgb(1.f), 0.05f);
  // Below about 1900 K blue is out of gamut.
  EXPECT_TRUE(take_color_warnings().empty());
  EXPECT_EQ(rgb(1500.f).z, 0.f);
  EXPECT_EQ(take_color_warnings().size(), 1u);
}

TEST_F(SpectrumParameter, SpectraOfFactorsAreLitByD65) {
  const Parameter grey = numbers(ParameterType::Spectrum, {300.f, 0.3f, 900.f, 0.3f});
  expect_near(converted(grey, SpectrumUse::Albedo), Rgb(0.3f), 1e-6f);
  expect_near(converted(grey, SpectrumUse::Unbounded), Rgb(0.3f), 1e-6f);
  const Parameter large = numbers(ParameterType::Spectrum, {300.f, 4.f, 900.f, 4.f});
  expect_near(converted(large, SpectrumUse::Unbounded), Rgb(4.f), 1e-5f);
  EXPECT_TRUE(take_color_warnings().empty());
  expect_near(converted(large, SpectrumUse::Albedo), Rgb(1.f), 1e-6f);
  EXPECT_EQ(take_color_warnings().size(), 1u);
  // What is not given is zero: nearly nothing is seen outside 400 to 700 nm.
  const Parameter narrow = numbers(ParameterType::Spectrum, {400.f, 0.3f, 700.f, 0.3f});
  expect_near(converted(narrow, SpectrumUse::Albedo), Rgb(0.3f), 2e-3f);
  const Rgb bk7 = converted(named("glass-BK7"), SpectrumUse::Unbounded);
  expect_near(bk7, Rgb(1.519f), 0.01f);
  EXPECT_LT(bk7.x, bk7.z);
}

TEST_F(SpectrumParameter, FilesAreRead) {
  const std::string name = "spectrum_parameter_test.spd";
  std::ofstream(Folder().resolve_path(name))
      << "# measured\n300 0.3 # violet\n\n  600.5\t+3e-1\r\n900 0.3";
  const std::vector<vec2> samples = spectrum_samples(named(name), Folder());
  const std::vector<vec2> expected = {{300.f, 0.3f}, {600.5f, 0.3f}, {900.f, 0.3f}};
  EXPECT_EQ(samples, expected);
  expect_near(converted(named(name), SpectrumUse::Albedo), Rgb(0.3f), 1e-6f);
  std::ofstream(Folder().resolve_path(name)) << "300 0.3\n400 0,3\n";
  EXPECT_NE(error_of(named(name)).find("line 2"), std::string::npos) << error_of(named(name));
  std::ofstream(Folder().resolve_path(name)) << "# nothing\n";
  EXPECT_NE(error_of(named(name)).find("empty"), std::string::npos);
  std::filesystem::remove(Folder().resolve_path(name));
  EXPECT_NE(error_of(named(name)).find("does not exist"), std::string::npos);
}

TEST_F(SpectrumParameter, SamplesOfNamedSpectra) {
  EXPECT_EQ(spectrum_samples(named("metal-Au-k"), Folder()), *named_spectrum("metal-Au-k"));
  EXPECT_FALSE(spectrum_samples(numbers(ParameterType::Blackbody, {3000.f}), Folder()).empty());
  const Parameter rgb = numbers(ParameterType::Rgb, {1.f, 1.f, 1.f});
  EXPECT_NE(error_of([&] { spectrum_samples(rgb, Folder()); }).find("spectrum is expected"),
            std::string::npos);
}

TEST_F(SpectrumParameter, MistakesAreErrorsAtTheParameter) {
  const std::string unknown = error_of(named("metal-Au-etta"));
  EXPECT_EQ(unknown.find("scene.pbrt:12:3: parameter \"L\": named spectrum 'metal-Au-etta' is not "
                         "supported yet"),
            0u)
      << unknown;
  EXPECT_NE(unknown.find("metal-Au-eta'"), std::string::npos) << unknown;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  using enum ParameterType;
  for (const auto& [p, part] : std::vector<std::pair<Parameter, std::string>>{
           {numbers(Rgb, {1.f, 2.f}), "three components"},
           {numbers(Rgb, {1.f, nan, 2.f}), "finite"},
           {numbers(Rgb, {1.f, 1.f, 1.f}, "rec2021"), "did you mean 'rec2020'"},
           {numbers(Blackbody, {}), "one temperature"},
           {numbers(Blackbody, {-5.f}), "between"},
           {numbers(Blackbody, {nan}), "between"},
           {numbers(Spectrum, {}), "empty"},
           {numbers(Spectrum, {400.f, 1.f, 500.f}), "odd count"},
           {numbers(Spectrum, {500.f, 1.f, 400.f, 1.f}), "must ascend"},
           {numbers(Spectrum, {500.f, 1.f, 500.f, 1.f}), "must ascend"},
           {numbers(Spectrum, {500.f, nan, 600.f, 1.f}), "finite"}}) {
    const std::string message = error_of(p);
    EXPECT_EQ(message.find("scene.pbrt:12:3"), 0u) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST_F(SpectrumParameter, NegativeSamplesAndBlackAreHandled) {
  EXPECT_EQ(converted(numbers(ParameterType::Spectrum, {400.f, 0.f, 700.f, 0.f}),
                      SpectrumUse::Illuminant),
            Rgb(0.f));
  EXPECT_TRUE(take_color_warnings().empty());
  const Rgb clipped = converted(numbers(ParameterType::Spectrum, {300.f, -1.f, 900.f, -1.f}),
                                SpectrumUse::Unbounded);
  EXPECT_EQ(clipped, Rgb(0.f));
  EXPECT_EQ(take_color_warnings().size(), 1u);
}

}  // namespace
}  // namespace pssmlt
