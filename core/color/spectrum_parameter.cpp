#include "core/color/spectrum_parameter.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/color/color_space.h"
#include "core/color/color_warnings.h"
#include "core/color/named_spectra.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

struct Spectrum {
  Samples samples;
  Outside outside;
};

[[noreturn]] void fail(const Parameter& p, const std::string& message) {
  throw Error(p.where, "parameter \"" + p.name + "\": " + message);
}

void warn(const Parameter& p, const std::string& message) {
  const std::string place = to_string(p.where);
  add_color_warning((place.empty() ? "" : place + ": ") + "parameter \"" + p.name +
                    "\": " + message);
}

std::string text(const dvec3& c) {
  std::string result = "(";
  for (int i = 0; i < 3; ++i) result.append(i > 0 ? ", " : "").append(std::to_string(c[i]));
  return result.append(")");
}

// Numbers of one line up to a '#'; false if something else is found.
bool append_numbers(std::string_view line, std::vector<double>& numbers) {
  line = line.substr(0, line.find('#'));
  const char* p = line.data();
  const char* const end = p + line.size();
  constexpr std::string_view blanks = " \t\r";
  while (p != end) {
    if (blanks.find(*p) != std::string_view::npos) {
      ++p;
      continue;
    }
    double value = 0.;
    const auto [after, error] = std::from_chars(*p == '+' ? p + 1 : p, end, value);
    if (error != std::errc()) return false;
    if (after != end && blanks.find(*after) == std::string_view::npos) return false;
    numbers.push_back(value);
    p = after;
  }
  return true;
}

// Pairs of numbers as samples; `source` names them in messages.
Samples checked_samples(const Parameter& p, const std::vector<double>& numbers,
                        const std::string& source) {
  if (numbers.empty()) fail(p, source + " is empty: pairs of wavelength [nm] and value expected");
  if (numbers.size() % 2 != 0)
    fail(p, source + " has an odd count of numbers: pairs of wavelength [nm] and value expected");
  Samples samples;
  bool negative = false;
  for (size_t i = 0; i < numbers.size(); i += 2) {
    const vec2 sample{float(numbers[i]), float(numbers[i + 1])};
    if (!std::isfinite(sample.x) || !std::isfinite(sample.y))
      fail(p, source + " has a value that is not a finite number");
    if (!samples.empty() && sample.x <= samples.back().x)
      fail(p, source + ": wavelengths must ascend, but " + std::to_string(sample.x) +
                  " nm follows " + std::to_string(samples.back().x) + " nm");
    negative = negative || sample.y < 0.f;
    samples.emplace_back(sample.x, std::fmax(sample.y, 0.f));
  }
  if (negative) warn(p, source + " has negative values, which were set to 0");
  return samples;
}

Samples read_file(const Parameter& p, const std::string& path) {
  const std::string source = "spectrum file '" + path + "'";
  std::ifstream file(path);
  if (!file) fail(p, source + " cannot be read");
  std::vector<double> numbers;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
    if (!append_numbers(line, numbers))
      fail(p, source + ", line " + std::to_string(number) + ": wavelength [nm] and value expected");
  if (file.bad()) fail(p, source + " cannot be read to its end");
  return checked_samples(p, numbers, source);
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

Spectrum named_or_file(const Parameter& p, const SceneResolver& resolver) {
  if (p.strings.size() != 1) fail(p, "one spectrum expected");
  const std::string& name = p.strings[0];
  if (std::optional<Samples> known = named_spectrum(name)) return {*known, Outside::Clamp};
  const std::string path = resolver.resolve_path(name);
  if (is_file(path)) return {read_file(p, path), Outside::Zero};
  if (name.find('.') != std::string::npos || name.find('/') != std::string::npos)
    fail(p, "spectrum file '" + path + "' does not exist");
  fail(p, "named spectrum '" + name + "' is not supported yet" +
              suggestion(name, named_spectrum_names()));
}

Spectrum blackbody(const Parameter& p) {
  if (p.floats.size() != 1) fail(p, "one temperature [K] expected");
  const double temperature = p.floats[0];
  // Below 100 K nothing visible is left in single precision.
  if (!(temperature >= 100. && temperature <= 1e9))
    fail(p, "the temperature must be between 100 K and 1e9 K");
  return {blackbody_samples(temperature), Outside::Clamp};
}

Spectrum load(const Parameter& p, const SceneResolver& resolver) {
  if (p.type == ParameterType::Blackbody) return blackbody(p);
  if (p.type != ParameterType::Spectrum)
    fail(p, "a spectrum is expected, not " + std::string(to_string(p.type)));
  if (!p.strings.empty()) return named_or_file(p, resolver);
  return {checked_samples(p, {p.floats.begin(), p.floats.end()}, "the spectrum"), Outside::Zero};
}

// Linear Rec.709, not clipped.
dvec3 from_rgb(const Parameter& p, SpectrumUse use) {
  if (p.floats.size() != 3) fail(p, "three components expected");
  const dvec3 c(p.floats[0], p.floats[1], p.floats[2]);
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z))
    fail(p, "the colour has a component that is not a finite number");
  if (p.color_space == nullptr) return c;
  const glm::dmat3* const to_rec709 = rec709_from(*p.color_space, use);
  if (to_rec709 == nullptr)
    fail(p, "unknown colour space '" + *p.color_space + "'" +
                suggestion(*p.color_space, color_space_names()));
  return *to_rec709 * c;
}

// Linear Rec.709, not clipped.
dvec3 from_spectrum(const Parameter& p, SpectrumUse use, const Spectrum& spectrum) {
  const Samples& samples = spectrum.samples;
  if (use == SpectrumUse::Illuminant) return emission_rgb(samples, spectrum.outside);
  double limit = std::numeric_limits<double>::infinity();
  if (use == SpectrumUse::Albedo) {
    limit = 1.;
    for (const vec2& sample : samples)
      if (sample.y > 1.f) {
        warn(p, "the reflectance exceeds 1 at " + std::to_string(sample.x) +
                    " nm and was clipped to 1");
        break;
      }
  }
  return reflectance_rgb(
      [&](double lambda) { return std::min(limit, evaluate(samples, lambda, spectrum.outside)); });
}

// Into the range of the use, with a warning if the change can be seen.
Rgb clipped(const Parameter& p, SpectrumUse use, const dvec3& c) {
  const double upper = use == SpectrumUse::Albedo ? 1. : double(std::numeric_limits<float>::max());
  const dvec3 result = glm::clamp(c, 0., upper);
  const dvec3 change = glm::abs(result - c);
  const double largest = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  if (std::max({change.x, change.y, change.z}) > 1e-4 * largest)
    warn(p, "the colour " + text(c) + " in linear Rec.709 is out of range and was clipped to " +
                text(result));
  return Rgb(result);
}

}  // namespace

Rgb spectrum_to_rgb(const Parameter& parameter, SpectrumUse use, const SceneResolver& resolver) {
  if (parameter.type == ParameterType::Rgb)
    return clipped(parameter, use, from_rgb(parameter, use));
  return clipped(parameter, use, from_spectrum(parameter, use, load(parameter, resolver)));
}

std::vector<vec2> spectrum_samples(const Parameter& parameter, const SceneResolver& resolver) {
  return load(parameter, resolver).samples;
}

}  // namespace pssmlt
