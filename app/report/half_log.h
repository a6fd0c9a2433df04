// Quantisers of the report's images: half floats with a common exponent, and 8-bit logarithms.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/report/image_pack.h"

namespace pssmlt {

// Each chooses its range, fills the header's fields and losses, and returns one code a value
// (16 or 8 bits).
std::vector<uint16_t> quantise(std::span<const float> values, PackedImage& header);
// The value of each code: 65536 or 256 entries.
std::vector<float> code_values(const PackedImage& header);

}  // namespace pssmlt
