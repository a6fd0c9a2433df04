#include "app/report/image_pack.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/report/half_log.h"
#include "core/base/error.h"

namespace pssmlt {
namespace {

std::array<size_t, 3> rgb_of(const Image& image) {
  if (image.channels == 1) return {0, 0, 0};
  if (image.channels < 3) throw Error("a report's image needs 1 or at least 3 channels");
  std::array<size_t, 3> channels = {0, 1, 2};
  for (size_t c = 0; c < 3 && !image.channel_names.empty(); ++c) {
    const auto at = std::ranges::find(image.channel_names, std::string(1, "RGB"[c]));
    if (at == image.channel_names.end()) return {0, 1, 2};
    channels[c] = static_cast<size_t>(at - image.channel_names.begin());
  }
  return channels;
}

std::vector<float> rgb_values(const Image& image) {
  const auto channels = static_cast<size_t>(std::max(image.channels, 0));
  const auto pixels = static_cast<size_t>(std::max(image.width, 0)) *
                      static_cast<size_t>(std::max(image.height, 0));
  const std::array<size_t, 3> from = rgb_of(image);
  if (pixels == 0 || image.data.size() != pixels * channels ||
      *std::ranges::max_element(from) >= channels) {
    throw Error("a report's image whose size does not fit its data");
  }
  std::vector<float> values(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    for (size_t c = 0; c < 3; ++c) values[3 * i + c] = image.data[i * channels + from[c]];
  }
  return values;
}

// G, R - G, B - G (modulo 2^16, or 2^8): noise is much the same in all channels, which saves 15 to
// 30 %. Prediction from neighbours on top of it makes noisy renders larger.
std::array<std::vector<uint16_t>, 3> planes_of(const std::vector<uint16_t>& codes) {
  std::array<std::vector<uint16_t>, 3> planes;
  for (auto& plane : planes) plane.resize(codes.size() / 3);
  for (size_t i = 0; i < codes.size() / 3; ++i) {
    const uint16_t g = codes[3 * i + 1];
    planes[0][i] = g;
    planes[1][i] = static_cast<uint16_t>(codes[3 * i] - g);
    planes[2][i] = static_cast<uint16_t>(codes[3 * i + 2] - g);
  }
  return planes;
}

std::string deflate(const std::string& bytes) {
  z_stream stream{};
  // Z_FILTERED: fewer short matches, which noise has by accident.
  if (deflateInit2(&stream, 6, Z_DEFLATED, 15, 9, Z_FILTERED) != Z_OK) {
    throw Failure("zlib could not compress an image");
  }
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  std::string in = bytes;  // next_in is not const
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int result = ::deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw Failure("zlib could not compress an image");
  return out;
}

// One plane: the low bytes of all pixels, then, of 16-bit codes, the high bytes.
std::string bytes_of(const std::vector<uint16_t>& plane, bool wide) {
  std::string bytes;
  bytes.reserve(plane.size() * (wide ? 2 : 1));
  for (const uint16_t v : plane) bytes += static_cast<char>(v & 0xff);
  if (!wide) return bytes;
  for (const uint16_t v : plane) bytes += static_cast<char>(v >> 8);
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

}  // namespace

PackedImage pack_image(const Image& image, Precision precision) {
  PackedImage packed;
  const std::vector<float> values = rgb_values(image);
  packed.width = image.width;
  packed.height = image.height;
  packed.precision = precision;
  const bool wide = precision == Precision::exact;
  std::string bytes;
  for (const auto& plane : planes_of(quantise(values, packed))) bytes += bytes_of(plane, wide);
  packed.deflated = deflate(bytes);
  return packed;
}

Image unpack_image(const PackedImage& packed) {
  const bool wide = packed.precision == Precision::exact;
  Image image(packed.width, packed.height, 3);
  const size_t pixels = image.data.size() / 3, stride = pixels * (wide ? 2 : 1);
  std::string bytes(3 * stride, '\0');
  uLongf size = bytes.size();
  const auto* source = reinterpret_cast<const Bytef*>(packed.deflated.data());
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, source, packed.deflated.size()) !=
          Z_OK ||
      size != bytes.size()) {
    throw Failure("a packed image is broken");
  }
  std::array<std::vector<uint16_t>, 3> planes;
  for (size_t c = 0; c < 3; ++c) {
    planes[c].resize(pixels);
    for (size_t i = 0; i < pixels; ++i) {
      const auto low = static_cast<unsigned char>(bytes[c * stride + i]);
      const auto high =
          wide ? static_cast<unsigned char>(bytes[c * stride + pixels + i]) : uint8_t{0};
      planes[c][i] = static_cast<uint16_t>(low | high << 8);
    }
  }
  const std::vector<float> values = code_values(packed);
  const size_t mask = values.size() - 1;
  for (size_t i = 0; i < pixels; ++i) {
    const unsigned g = planes[0][i];
    image.data[3 * i] = values[(planes[1][i] + g) & mask];
    image.data[3 * i + 1] = values[g & mask];
    image.data[3 * i + 2] = values[(planes[2][i] + g) & mask];
  }
  return image;
}

std::string image_script(const std::string& id, const PackedImage& packed) {
  const bool exact = packed.precision == Precision::exact;
  nlohmann::json header = {{"id", id},
                           {"width", packed.width},
                           {"height", packed.height},
                           {"precision", exact ? "exact" : "logarithmic"},
                           {"clamped", packed.losses.clamped},
                           {"non_finite", packed.losses.non_finite},
                           {"data", base64(packed.deflated)}};
  if (exact) {
    header["exponent"] = packed.exponent;
  } else {
    header["low"] = packed.low;
    header["step"] = packed.step;
  }
  return "pssmltReport.image(" + header.dump() + ");\n";
}

}  // namespace pssmlt
