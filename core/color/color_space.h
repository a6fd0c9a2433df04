// RGB colour spaces of scene files and their conversion to linear Rec.709.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/rgb.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// XYZ (Y = 1 for white) to linear Rec.709, computed from the primaries of ITU-R BT.709 and the
// chromaticity of D65 as tabulated, so that D65 is exactly neutral.
const glm::dmat3& rec709_from_xyz();

// Linear RGB of a colour space ("srgb", "dci-p3", "rec2020", "aces2065-1") to linear Rec.709, not
// clipped; null if the name is not known. Illuminant converts the light itself: (1, 1, 1) is the
// space's white. Albedo and Unbounded convert a factor: (1, 1, 1) stays (1, 1, 1) by adaptation of
// the space's white to D65 (Bradford), which matters for aces2065-1 only.
const glm::dmat3* rec709_from(std::string_view color_space, SpectrumUse use);

const std::vector<std::string>& color_space_names();

// XYZ, Y = 1, of light of a temperature [K]: CIE daylight from 4000 K on, a black body below.
// Throws nothing; temperature in 100 K to 25000 K.
dvec3 white_xyz(double temperature);

// Linear Rec.709 in which the light of white_xyz becomes the white of Rec.709 (Bradford).
glm::dmat3 white_balance(double temperature);

}  // namespace pssmlt
