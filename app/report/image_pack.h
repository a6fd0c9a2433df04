// Float images as compressed text that the report's page can load by a script tag, and back. The
// steps are: quantise, take G, R - G, B - G of the codes, split bytes, deflate, base64.
#pragma once

#include <cstdint>
#include <string>

#include "core/image/image.h"

namespace pssmlt {

enum class Precision {
  exact,       // half floats times a power of two: relative error <= 2^-11
  logarithmic  // 8 bits, logarithmic: relative error <= 2^(step / 2) - 1, at most 4.5 %
};

// What an encoding could not keep. Values are counted, three for each pixel.
struct PackLosses {
  int64_t clamped = 0;     // finite, outside the range: stored as its end
  int64_t non_finite = 0;  // NaN, infinite: exact keeps them, logarithmic stores one code for all
};

// exact: code = bits of the half float nearest to value * 2^exponent. The exponent puts the largest
//   magnitude just below 2^16, so that nothing is clamped, unless typical values (geometric mean)
//   would fall below 2^-10: then they are put there and what is too large is clamped to 65504.
// logarithmic: code 0 = zero (negative values too, counted as clamped), 255 = not finite,
//   c in 1..254 = 2^(low + (c - 1) step). The largest value has code 254; step is at most 1/8;
//   values below half a step under 2^low become 0.
struct PackedImage {
  int width = 0, height = 0;
  Precision precision = Precision::exact;
  int exponent = 0;              // exact
  double low = 0.0, step = 0.0;  // logarithmic, in powers of two
  PackLosses losses;
  // zlib stream of three planes (of codes G, R - G, B - G), each the low bytes of all pixels, then,
  // of 16-bit codes, the high ones.
  std::string deflated;
};

// `image`: 1 channel, or R, G, B by name or place. Throws Error for other numbers of channels and
// for sizes that do not fit the data.
PackedImage pack_image(const Image& image, Precision precision);
// What a reader sees: 3 channels; the page's decoder does the same. Throws Failure if `deflated` is
// broken.
Image unpack_image(const PackedImage& packed);
// JavaScript: one call pssmltReport.image({...}) with the header as JSON and the data in base64.
std::string image_script(const std::string& id, const PackedImage& packed);

}  // namespace pssmlt
