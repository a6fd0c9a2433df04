#include "app/report/half_log.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace pssmlt {
namespace {

constexpr float half_max = 65504.f;
constexpr int log_codes = 254;  // of positive values; 0 and 255 are special
constexpr double max_step = 1.0 / 8, min_step = 1.0 / 64;

// Of the finite values that are not 0.
struct Range {
  float largest = 0.f;                                      // magnitude
  float smallest = std::numeric_limits<float>::infinity();  // positive
  double log_mean = 0.0;                                    // of log2 of the magnitudes
};

Range range_of(std::span<const float> values) {
  Range range;
  double sum = 0.0;
  int64_t count = 0;
  for (const float v : values) {
    if (v == 0.f || !std::isfinite(v)) continue;
    range.largest = std::max(range.largest, std::abs(v));
    if (v > 0.f) range.smallest = std::min(range.smallest, v);
    sum += std::log2(std::abs(v));
    ++count;
  }
  if (count > 0) range.log_mean = sum / static_cast<double>(count);
  return range;
}

int exponent_for(const Range& range) {
  if (range.largest == 0.f) return 0;
  const int of_largest = 15 - std::ilogb(range.largest);
  const int of_typical = -10 - static_cast<int>(std::floor(range.log_mean));
  return std::max(of_largest, of_typical);
}

std::vector<uint16_t> to_half(std::span<const float> values, PackedImage& header) {
  header.exponent = exponent_for(range_of(values));
  std::vector<uint16_t> codes(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    float v = values[i];
    if (!std::isfinite(v)) {
      ++header.losses.non_finite;
      codes[i] = std::isnan(v) ? 0x7e00 : v > 0.f ? 0x7c00 : 0xfc00;
      continue;
    }
    v = std::ldexp(v, header.exponent);
    if (std::abs(v) > half_max) {
      // What rounds down to the largest half is not out of range.
      if (std::abs(v) >= 65520.f) ++header.losses.clamped;
      v = std::copysign(half_max, v);
    }
    codes[i] = glm::packHalf1x16(v);
  }
  return codes;
}

void choose_steps(const Range& range, PackedImage& header) {
  const double high = range.largest > 0.f ? std::log2(range.largest) : 0.0;
  const double low = std::isfinite(range.smallest) ? std::log2(range.smallest) : high;
  header.step = std::clamp((high - low) / (log_codes - 1), min_step, max_step);
  header.low = high - (log_codes - 1) * header.step;
}

uint16_t log_code(float v, PackedImage& header) {
  if (!std::isfinite(v)) {
    ++header.losses.non_finite;
    return 255;
  }
  if (v <= 0.f) {
    if (v < 0.f) ++header.losses.clamped;
    return 0;
  }
  const double place = std::round((std::log2(v) - header.low) / header.step) + 1.0;
  if (place < 1.0) ++header.losses.clamped;
  return static_cast<uint16_t>(std::clamp(place, 0.0, static_cast<double>(log_codes)));
}

}  // namespace

std::vector<uint16_t> quantise(std::span<const float> values, PackedImage& header) {
  if (header.precision == Precision::exact) return to_half(values, header);
  Range range = range_of(values);
  // Negative values have no logarithm; the range is that of the positive ones.
  range.largest = 0.f;
  for (const float v : values) {
    if (std::isfinite(v)) range.largest = std::max(range.largest, v);
  }
  choose_steps(range, header);
  std::vector<uint16_t> codes(values.size());
  std::ranges::transform(values, codes.begin(), [&](float v) { return log_code(v, header); });
  return codes;
}

std::vector<float> code_values(const PackedImage& header) {
  const bool exact = header.precision == Precision::exact;
  std::vector<float> values(exact ? 65536 : 256);
  for (size_t code = 0; code < values.size(); ++code) {
    if (exact) {
      values[code] = std::ldexp(glm::unpackHalf1x16(static_cast<uint16_t>(code)), -header.exponent);
    } else if (code == 255) {
      values[code] = std::numeric_limits<float>::quiet_NaN();
    } else if (code > 0) {
      const double place = header.low + (static_cast<double>(code) - 1.0) * header.step;
      values[code] = static_cast<float>(std::exp2(place));
    }
  }
  return values;
}

}  // namespace pssmlt
