// Reading a texture's own texture parameters, for plugins that exist for float and for Rgb.
#pragma once

#include <type_traits>

#include "core/noise.h"
#include "core/scene/parameters.h"
#include "core/texture.h"

namespace pssmlt {

// A number or a colour that textures do not vary, not limited to [0, 1].
template <typename T>
T plain_value(Parameters& p, std::string_view name, float fallback, std::string_view doc) {
  if constexpr (std::is_same_v<T, float>) {
    return p.number(name, fallback, "", doc);
  } else {
    return p.rgb(name, Rgb(fallback), SpectrumUse::Unbounded, "", doc);
  }
}

// The named texture, or a constant from the value given or from the fallback. Colours are not
// limited to [0, 1]: what uses the texture knows what it stands for.
template <typename T>
std::shared_ptr<const Texture<T>> value_texture(Parameters& p, std::string_view name,
                                                float fallback, std::string_view doc) {
  if constexpr (std::is_same_v<T, float>) {
    return p.float_texture(name, fallback, "", doc);
  } else {
    return p.rgb_texture(name, Rgb(fallback), SpectrumUse::Unbounded, "", doc);
  }
}

// "octaves" and "roughness" of sums of noise.
inline Octaves read_octaves(Parameters& p) {
  Octaves octaves;
  octaves.count = p.integer("octaves", 8, "", "octaves of noise, each about half as wide");
  octaves.roughness =
      p.number("roughness", 0.5f, "", "weight of an octave over that of the one before");
  // Frequencies beyond overflow.
  if (octaves.count < 0 || octaves.count > 64)
    p.fail("octaves", "\"octaves\" must lie between 0 and 64");
  return octaves;
}

}  // namespace pssmlt
