// Scattering coefficients of well-known media, by the names that pbrt-v4 gives them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/rgb.h"

namespace pssmlt {

struct ScatteringPreset {
  Rgb scattering{0.f};  // reduced sigma_s' [1/mm]
  Rgb absorption{0.f};  // sigma_a [1/mm]
};

// nullopt if nothing has this name.
std::optional<ScatteringPreset> scattering_preset(std::string_view name);
std::vector<std::string> scattering_preset_names();

}  // namespace pssmlt
