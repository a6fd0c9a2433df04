// Reading a texture's own texture parameters, for plugins that exist for float and for Rgb.
#pragma once

#include <type_traits>

#include "core/scene/parameters.h"
#include "core/texture.h"

namespace pssmlt {

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

}  // namespace pssmlt
