#include "app/live/half_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace pssmlt {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr int most_exponent = 120;

int exponent_for(const Image& image) {
  double sum = 0.0;
  int64_t count = 0;
  for (const float v : image.data) {
    if (!std::isfinite(v)) continue;
    sum += std::abs(v);
    ++count;
  }
  if (sum <= 0.0) return 0;
  return std::clamp(-std::ilogb(sum / static_cast<double>(count)), -most_exponent, most_exponent);
}

void append(std::string& bytes, int32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

uint16_t half_bits(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  const uint32_t sign = bits >> 16 & 0x8000u;
  uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<uint16_t>(sign | 0x7e00u);
  magnitude = std::min(magnitude, std::bit_cast<uint32_t>(65504.f));
  if (magnitude < std::bit_cast<uint32_t>(0x1p-14f)) {
    // Adding 0.5 leaves the multiple of 2^-24, rounded, in the lowest bits.
    const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
    return static_cast<uint16_t>(sign | (std::bit_cast<uint32_t>(shifted) - 0x3f000000u));
  }
  // Exponent 127 becomes 15; half of the bits that are dropped, and one more if the last bit that
  // stays is odd, rounds to even.
  const uint32_t odd = magnitude >> 13 & 1u;
  return static_cast<uint16_t>(sign | ((magnitude - (112u << 23) + 0xfffu + odd) >> 13));
}

float half_value(uint16_t bits) {
  const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
  const float sign = bits & 0x8000 ? -1.f : 1.f;
  if (exponent == 31) return mantissa != 0 ? std::nanf("") : sign * INFINITY;
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(mantissa), -24);
  return sign * std::ldexp(static_cast<float>(mantissa + 1024), exponent - 25);
}

std::string half_image(const Image& image) {
  const int exponent = exponent_for(image);
  const float factor = std::ldexp(1.f, exponent);
  const auto channels = static_cast<size_t>(image.channels);
  const size_t pixels = image.data.size() / std::max<size_t>(channels, 1);
  std::string bytes = "PSH1";
  bytes.reserve(16 + 6 * pixels);
  append(bytes, image.width);
  append(bytes, image.height);
  append(bytes, exponent);
  std::vector<uint16_t> halves(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      halves[3 * i + c] = half_bits(image.data[i * channels + std::min(c, channels - 1)] * factor);
    }
  }
  bytes.append(reinterpret_cast<const char*>(halves.data()), 2 * halves.size());
  return bytes;
}

}  // namespace pssmlt
