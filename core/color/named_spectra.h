// Spectra that scenes call by pbrt-v4's names: "metal-Au-eta", "glass-BK7", "stdillum-D65", ...
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/color/spectrum.h"

namespace pssmlt {

// The spectrum, to be continued by its end values over the visible range (Outside::Clamp); nullopt
// if the name is not known.
std::optional<Samples> named_spectrum(std::string_view name);

// All names, in the order of their tables.
const std::vector<std::string>& named_spectrum_names();

}  // namespace pssmlt
