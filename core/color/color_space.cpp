#include "core/color/color_space.h"

#include <array>
#include <glm/matrix.hpp>

#include "core/color/named_spectra.h"

namespace pssmlt {
namespace {

struct Definition {
  std::string_view name;
  std::array<dvec2, 3> primaries;  // chromaticities (x, y) of red, green and blue
  std::string_view white;          // a named spectrum
};

// ITU-R BT.709, SMPTE EG 432-1 (the display variant with D65), ITU-R BT.2020, SMPTE ST 2065-1.
constexpr std::array<Definition, 4> definitions = {{
    {"srgb", {{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}}, "stdillum-D65"},
    {"dci-p3", {{{0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}}}, "stdillum-D65"},
    {"rec2020", {{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}}, "stdillum-D65"},
    {"aces2065-1", {{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}}}, "illum-acesD60"},
}};

dvec3 xyz_of(const dvec2& xy) { return {xy.x / xy.y, 1., (1. - xy.x - xy.y) / xy.y}; }

dvec3 white_of(const Definition& space) {
  return emission_xyz(*named_spectrum(space.white), Outside::Clamp);
}

// Columns are the primaries, scaled so that (1, 1, 1) is the white point with Y = 1.
glm::dmat3 xyz_from(const Definition& space) {
  const glm::dmat3 primaries(xyz_of(space.primaries[0]), xyz_of(space.primaries[1]),
                             xyz_of(space.primaries[2]));
  const dvec3 scale = glm::inverse(primaries) * white_of(space);
  return glm::dmat3(primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z);
}

// Linear Bradford adaptation of XYZ from one white to another (Lam 1985; ICC.1:2010, annex E).
glm::dmat3 bradford(const dvec3& from, const dvec3& to) {
  const glm::dmat3 cone =
      glm::transpose(glm::dmat3(dvec3(0.8951, 0.2664, -0.1614), dvec3(-0.7502, 1.7135, 0.0367),
                                dvec3(0.0389, -0.0685, 1.0296)));
  const dvec3 gain = (cone * to) / (cone * from);
  const glm::dmat3 scale(dvec3(gain.x, 0., 0.), dvec3(0., gain.y, 0.), dvec3(0., 0., gain.z));
  return glm::inverse(cone) * scale * cone;
}

// Chromaticity of CIE daylight (CIE 015:2018, section 4.1.2), for 4000 K to 25000 K. Temperatures
// are in the scale of 1968, which had another second radiation constant.
dvec2 daylight(double temperature) {
  const double t = 1e3 / (temperature * 1.4388 / 1.4380);
  const double x = temperature <= 7000. ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                                        : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
  return {x, -0.275 + x * (2.870 - x * 3.000)};
}

struct Conversions {
  glm::dmat3 light, factor;
};

std::array<Conversions, definitions.size()> all_conversions() {
  std::array<Conversions, definitions.size()> all;
  for (size_t i = 0; i < all.size(); ++i) {
    const glm::dmat3 to_xyz = xyz_from(definitions[i]);
    const glm::dmat3 adapt = bradford(white_of(definitions[i]), d65_white());
    all[i] = {rec709_from_xyz() * to_xyz, rec709_from_xyz() * adapt * to_xyz};
  }
  all[0] = {glm::dmat3(1.), glm::dmat3(1.)};  // exactly
  return all;
}

}  // namespace

const glm::dmat3& rec709_from_xyz() {
  static const glm::dmat3 matrix = glm::inverse(xyz_from(definitions[0]));
  return matrix;
}

dvec3 white_xyz(double temperature) {
  return temperature >= 4000. ? xyz_of(daylight(temperature))
                              : emission_xyz(blackbody_samples(temperature), Outside::Clamp);
}

glm::dmat3 white_balance(double temperature) {
  const glm::dmat3 adapt = bradford(white_xyz(temperature), d65_white());
  return rec709_from_xyz() * adapt * glm::inverse(rec709_from_xyz());
}

const glm::dmat3* rec709_from(std::string_view color_space, SpectrumUse use) {
  static const std::array<Conversions, definitions.size()> all = all_conversions();
  for (size_t i = 0; i < all.size(); ++i)
    if (definitions[i].name == color_space)
      return use == SpectrumUse::Illuminant ? &all[i].light : &all[i].factor;
  return nullptr;
}

const std::vector<std::string>& color_space_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Definition& space : definitions) list.emplace_back(space.name);
    return list;
  }();
  return names;
}

}  // namespace pssmlt
