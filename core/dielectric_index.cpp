#include "core/dielectric_index.h"

#include <algorithm>

#include "core/base/log.h"
#include "core/color/spectrum.h"

namespace pssmlt {
namespace {

constexpr double helium_d = 587.6;  // [nm]

float from_spectrum(Parameters& p, const char* doc) {
  const Samples samples = *p.spectrum("eta", "", doc);
  const auto [low, high] = std::ranges::minmax(samples, {}, &vec2::y);
  const auto eta = static_cast<float>(evaluate(samples, helium_d, Outside::Clamp));
  if (low.y != high.y) {
    const std::string place = to_string(p.where());
    log_info((place.empty() ? "" : place + ": ") + p.owner() +
             ": dispersion is not rendered yet; eta = " + std::to_string(eta) +
             ", the value at 587.6 nm, is used");
  }
  return eta;
}

float from_rgb(Parameters& p, const char* doc) {
  const Rgb eta = p.rgb("eta", Rgb(1.5f), SpectrumUse::Unbounded, "", doc);
  if (eta.x != eta.y || eta.y != eta.z)
    p.fail("eta", "a refractive index that varies with colour is not supported yet");
  return eta.x;
}

float read(Parameters& p) {
  constexpr const char* doc = "refractive index of the inside over that of the outside, or a glass";
  const std::optional<ParameterType> type = p.type("eta");
  if (type == ParameterType::Spectrum) return from_spectrum(p, doc);
  if (type == ParameterType::Rgb) return from_rgb(p, doc);
  return p.number("eta", 1.5f, "", doc);
}

}  // namespace

float read_dielectric_index(Parameters& p) {
  const float eta = read(p);
  if (!(eta > 0.f)) p.fail("eta", "the refractive index must be positive");
  return eta;
}

}  // namespace pssmlt
