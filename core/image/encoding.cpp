#include "core/image/encoding.h"

#include <charconv>
#include <cmath>

#include "core/base/error.h"

namespace pssmlt {

Encoding Encoding::parse(const std::string& text) {
  if (text == "linear") return linear();
  if (text == "sRGB") return srgb();
  constexpr std::string_view prefix = "gamma ";
  if (text.starts_with(prefix)) {
    float gamma = 0.f;
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data() + prefix.size(), end, gamma);
    if (error == std::errc() && after == end && gamma > 0.f && std::isfinite(gamma))
      return {Kind::gamma, gamma};
  }
  throw Error("unknown encoding '" + text + "': sRGB, linear or gamma N expected");
}

float Encoding::to_linear(float stored) const {
  switch (kind_) {
    case Kind::srgb:
      return stored <= 0.04045f ? stored / 12.92f : std::pow((stored + 0.055f) / 1.055f, 2.4f);
    case Kind::gamma:
      return std::pow(stored, gamma_);
    case Kind::linear:
      break;
  }
  return stored;
}

float Encoding::from_linear(float value) const {
  switch (kind_) {
    case Kind::srgb:
      return value <= 0.0031308f ? value * 12.92f : 1.055f * std::pow(value, 1.f / 2.4f) - 0.055f;
    case Kind::gamma:
      return std::pow(value, 1.f / gamma_);
    case Kind::linear:
      break;
  }
  return value;
}

}  // namespace pssmlt
