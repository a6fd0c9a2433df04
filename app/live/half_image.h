// The picture as the live page reads it: half floats, not compressed: on loopback
// bandwidth is free, and deflating would take its time from the render.
#pragma once

#include <cstdint>
#include <string>

#include "core/image/image.h"

namespace pssmlt {

// Bits of the half float nearest to the value, ties to even; beyond 65504: the largest one, with
// sign. NaN stays NaN.
uint16_t half_bits(float value);
float half_value(uint16_t bits);

// 16 bytes: "PSH1", then width, height, exponent as 32-bit integers; then R, G, B of every pixel as
// half floats, upper row first, all little-endian. What is stored is value * 2^exponent; the
// exponent puts the mean magnitude of the finite values near 1. A single channel is repeated.
std::string half_image(const Image& image);

}  // namespace pssmlt
