// Observer, illuminants, black bodies, colour spaces and the tables of named spectra.
#include "core/color/spectrum.h"

#include <gtest/gtest.h>

#include <set>

#include "core/color/color_space.h"
#include "core/color/named_spectra.h"

namespace pssmlt {
namespace {

dvec2 chromaticity(const dvec3& xyz) { return dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

dvec2 chromaticity_of(const std::string& name) {
  return chromaticity(emission_xyz(*named_spectrum(name), Outside::Clamp));
}

void expect_near(const dvec3& value, const dvec3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

TEST(Observer, IntegralsAreThePublishedOnes) {
  // Sums at 1 nm of CIE 018:2019: 106.865, 106.857, 106.892.
  const dvec3 sum = xyz_integral([](double) { return 1.; });
  EXPECT_NEAR(sum.x, 106.865, 0.02);
  EXPECT_NEAR(sum.y, 106.857, 0.02);
  EXPECT_NEAR(sum.z, 106.892, 0.02);
  EXPECT_EQ(cie_1931(555.).y, 1.);
  EXPECT_EQ(cie_1931(359.9), dvec3(0.));
  EXPECT_EQ(cie_1931(830.1), dvec3(0.));
  EXPECT_GT(cie_1931(830.).x, 0.);
  EXPECT_NEAR(cie_1931(557.5).y, 0.9975, 1e-6);
}

TEST(Illuminants, ChromaticitiesAreThePublishedOnes) {
  // CIE 15:2004, tables T.3 and T.8.1, and SMPTE ST 2065-1. One wrong digit of a table moves them.
  const std::vector<std::pair<std::string, dvec2>> published = {
      {"stdillum-A", {0.44757, 0.40745}},   {"stdillum-D50", {0.34567, 0.35851}},
      {"stdillum-D65", {0.31272, 0.32903}}, {"illum-acesD60", {0.32168, 0.33767}},
      {"stdillum-F1", {0.3131, 0.3371}},    {"stdillum-F2", {0.3721, 0.3751}},
      {"stdillum-F3", {0.4091, 0.3941}},    {"stdillum-F4", {0.4402, 0.4031}},
      {"stdillum-F5", {0.3138, 0.3452}},    {"stdillum-F6", {0.3779, 0.3882}},
      {"stdillum-F7", {0.3129, 0.3292}},    {"stdillum-F8", {0.3458, 0.3586}},
      {"stdillum-F9", {0.3741, 0.3727}},    {"stdillum-F10", {0.3458, 0.3588}},
      {"stdillum-F11", {0.3805, 0.3769}},   {"stdillum-F12", {0.4370, 0.4042}}};
  // The narrow bands of FL10 to FL12 depend on how 5 nm tables are summed (here: interpolated).
  const double tolerance = 5e-4;
  for (const auto& [name, xy] : published) {
    const dvec2 measured = chromaticity_of(name);
    EXPECT_NEAR(measured.x, xy.x, tolerance) << name;
    EXPECT_NEAR(measured.y, xy.y, tolerance) << name;
  }
}

TEST(Blackbody, ChromaticityFollowsThePlanckianLocus) {
  // Wyszecki and Stiles, Color Science, table 1(5.3.3), made for c2 = 1.4388e-2 m K.
  const std::vector<std::pair<double, dvec2>> locus = {{1500., {0.5857, 0.3931}},
                                                       {2700., {0.4599, 0.4106}},
                                                       {5500., {0.3324, 0.3410}},
                                                       {10000., {0.2806, 0.2883}}};
  for (const auto& [temperature, xy] : locus) {
    const dvec2 measured =
        chromaticity(emission_xyz(blackbody_samples(temperature), Outside::Clamp));
    EXPECT_NEAR(measured.x, xy.x, 3e-4) << temperature;
    EXPECT_NEAR(measured.y, xy.y, 3e-4) << temperature;
  }
}

TEST(Samples, AreLinearInBetweenAndEndAsAsked) {
  const Samples samples = {{400.f, 1.f}, {500.f, 3.f}, {510.f, 5.f}};
  for (const Outside outside : {Outside::Zero, Outside::Clamp}) {
    EXPECT_DOUBLE_EQ(evaluate(samples, 400., outside), 1.);
    EXPECT_DOUBLE_EQ(evaluate(samples, 450., outside), 2.);
    EXPECT_DOUBLE_EQ(evaluate(samples, 505., outside), 4.);
    EXPECT_DOUBLE_EQ(evaluate(samples, 510., outside), 5.);
    EXPECT_EQ(evaluate({}, 500., outside), 0.);
    EXPECT_EQ(evaluate({{550.f, 2.f}}, 550., outside), 2.);
  }
  EXPECT_EQ(evaluate(samples, 399., Outside::Zero), 0.);
  EXPECT_EQ(evaluate(samples, 511., Outside::Zero), 0.);
  EXPECT_EQ(evaluate(samples, 399., Outside::Clamp), 1.);
  EXPECT_EQ(evaluate(samples, 511., Outside::Clamp), 5.);
}

TEST(Reflectance, ConstantIsNeutralAndWhiteIsD65) {
  expect_near(reflectance_rgb([](double) { return 0.25; }), dvec3(0.25), 1e-12);
  expect_near(emission_rgb(*named_spectrum("stdillum-D65"), Outside::Clamp), dvec3(1.), 1e-9);
  EXPECT_NEAR((rec709_from_xyz() * dvec3(0.)).x, 0., 0.);
}

TEST(ColorSpaces, MatricesAreThePublishedOnes) {
  // IEC 61966-2-1, to the four digits it gives; its white is rounded to (0.3127, 0.3290).
  const glm::dmat3& m = rec709_from_xyz();
  expect_near(glm::transpose(m)[0], dvec3(3.2406, -1.5372, -0.4986), 1e-3);
  expect_near(glm::transpose(m)[1], dvec3(-0.9689, 1.8758, 0.0415), 1e-3);
  expect_near(glm::transpose(m)[2], dvec3(0.0557, -0.2040, 1.0570), 1e-3);
  // ITU-R BT.2087 (inverse), green and red of BT.2020.
  const glm::dmat3& rec2020 = *rec709_from("rec2020", SpectrumUse::Illuminant);
  expect_near(rec2020[0], dvec3(1.6605, -0.1246, -0.0182), 1e-3);
  expect_near(rec2020[1], dvec3(-0.5877, 1.1329, -0.1006), 1e-3);
  const glm::dmat3& p3 = *rec709_from("dci-p3", SpectrumUse::Albedo);
  expect_near(p3[0], dvec3(1.2249, -0.0420, -0.0197), 1e-3);
  EXPECT_EQ(*rec709_from("srgb", SpectrumUse::Albedo), glm::dmat3(1.));
  EXPECT_EQ(rec709_from("adobe", SpectrumUse::Albedo), nullptr);
}

TEST(ColorSpaces, WhiteIsWhite) {
  for (const std::string& name : color_space_names())
    for (const SpectrumUse use : {SpectrumUse::Albedo, SpectrumUse::Unbounded})
      expect_near(*rec709_from(name, use) * dvec3(1.), dvec3(1.), 1e-9);
  for (const char* name : {"dci-p3", "rec2020"})
    expect_near(*rec709_from(name, SpectrumUse::Illuminant) * dvec3(1.), dvec3(1.), 1e-9);
  // The light of ACES is D60.
  const dvec3 d60 = emission_rgb(*named_spectrum("illum-acesD60"), Outside::Clamp);
  expect_near(*rec709_from("aces2065-1", SpectrumUse::Illuminant) * dvec3(1.), d60, 1e-9);
  EXPECT_GT(d60.x, 1.02);
}

TEST(NamedSpectra, AllAreUsable) {
  std::set<std::string> seen;
  for (const std::string& name : named_spectrum_names()) {
    EXPECT_TRUE(seen.insert(name).second) << name;
    const Samples samples = *named_spectrum(name);
    ASSERT_GE(samples.size(), 2u) << name;
    for (size_t i = 0; i < samples.size(); ++i) {
      EXPECT_GE(samples[i].y, 0.f) << name;
      if (i > 0) {
        EXPECT_LT(samples[i - 1].x, samples[i].x) << name;
      }
    }
  }
  EXPECT_EQ(seen.size(), 40u);
  EXPECT_FALSE(named_spectrum("metal-Unobtainium-eta"));
}

// The names of pbrt-v4's format (https://pbrt.org/fileformat-v4).
TEST(NamedSpectra, AllOfTheFormatAreThere) {
  for (const char* metal : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"})
    for (const char* part : {"-eta", "-k"})
      EXPECT_TRUE(named_spectrum(std::string("metal-") + metal + part)) << metal << part;
  for (const char* glass : {"BK7", "BAF10", "FK51A", "LASF9", "F5", "F10", "F11"})
    EXPECT_TRUE(named_spectrum(std::string("glass-") + glass)) << glass;
  for (const char* light : {"A", "D50", "D65", "F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9",
                            "F10", "F11", "F12"})
    EXPECT_TRUE(named_spectrum(std::string("stdillum-") + light)) << light;
  EXPECT_TRUE(named_spectrum("illum-acesD60"));
}

// The light of the temperature becomes grey, grey stays as bright as it was to a few per cent.
TEST(WhiteBalance, TurnsItsLightWhite) {
  for (const double t : {2000.0, 3500.0, 4500.0, 5503.0, 6504.0, 9000.0, 20000.0}) {
    const dvec3 light = rec709_from_xyz() * emission_xyz(blackbody_samples(t), Outside::Clamp);
    const dvec3 seen = white_balance(t) * light;
    // Daylight is a little greener than a black body of its temperature.
    const double allowed = t < 4000.0 ? 1e-6 : 0.09;
    EXPECT_NEAR(seen.x / seen.y, 1.0, allowed) << t;
    EXPECT_NEAR(seen.z / seen.y, 1.0, allowed) << t;
  }
  // CIE D50 by the same formula as its published coordinates (0.34567, 0.35851).
  const dvec3 d50(0.34567 / 0.35851, 1.0, (1.0 - 0.34567 - 0.35851) / 0.35851);
  const dvec3 seen = white_balance(5000.0) * rec709_from_xyz() * d50;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1.0, 2e-3);
}

TEST(NamedSpectra, GlassesHaveTheirCatalogueIndexAtTheHeliumLine) {
  // n_d at 587.56 nm, Schott catalogue.
  const std::vector<std::pair<const char*, double>> catalogue = {
      {"glass-BK7", 1.51680},   {"glass-BAF10", 1.67003}, {"glass-FK51A", 1.48656},
      {"glass-LASF9", 1.85025}, {"glass-F5", 1.67271},    {"glass-SF5", 1.67271},
      {"glass-F10", 1.72828},   {"glass-SF11", 1.78472}};
  for (const auto& [name, n] : catalogue)
    EXPECT_NEAR(evaluate(*named_spectrum(name), 587.56, Outside::Clamp), n, 1e-4) << name;
}

}  // namespace
}  // namespace pssmlt
