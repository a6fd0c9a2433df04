#include "core/dielectric_index.h"

#include <algorithm>

#include "core/base/log.h"
#include "core/cauchy_index.h"

namespace pssmlt {
namespace {

constexpr const char* doc =
    "refractive index of the inside over that of the outside, or a glass's spectrum";

float from_rgb(Parameters& p, const char* name) {
  const Rgb eta = p.rgb(name, Rgb(1.5f), SpectrumUse::Unbounded, "", doc);
  if (eta.x != eta.y || eta.y != eta.z)
    p.fail(name, "a refractive index is given by wavelength, not by colour: use a spectrum");
  return eta.x;
}

}  // namespace

DielectricIndex::DielectricIndex(Parameters& p, const char* name, float fallback) {
  const std::optional<ParameterType> type = p.type(name);
  float least = 0.f;
  if (type == ParameterType::Spectrum) {
    samples_ = *p.spectrum(name, "", doc);
    const auto [low, high] = std::ranges::minmax(samples_, {}, &vec2::y);
    at_d_ = static_cast<float>(evaluate(samples_, helium_d, Outside::Clamp));
    least = low.y;
    if (low.y == high.y) samples_.clear();
  } else {
    at_d_ = type == ParameterType::Rgb ? from_rgb(p, name) : p.number(name, fallback, "", doc);
    least = at_d_;
  }
  if (!(least > 0.f)) p.fail(name, "the refractive index must be positive");
}

float read_dielectric_index(Parameters& p, const char* name, float fallback) {
  const DielectricIndex index(p, name, fallback);
  if (index.varies() && !p.describing()) {
    const std::string place = to_string(p.where());
    log_info((place.empty() ? "" : place + ": ") + p.owner() +
             ": only \"dielectric\" disperses by a spectrum; eta = " +
             std::to_string(index.at_d()) + ", the value at 587.6 nm, is used");
  }
  return index.at_d();
}

}  // namespace pssmlt
