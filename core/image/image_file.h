// What crosses the border to the modules that know file formats and displays. Each function is
// looked up by its name in the module named (Registry::module).
#pragma once

#include <cstdint>

#include "core/image/embedded_file.h"
#include "core/image/image.h"

namespace pssmlt {

// An image as its file stores it, upper row first, channels interleaved.
struct ImageFile {
  int width = 0, height = 0, channels = 0;
  std::vector<std::string> channel_names;
  bool integer = false;        // stored as integers: encoded, [0, 1] stands for the full range
  std::vector<uint8_t> bytes;  // filled if stored with 8 bits, else
  std::vector<float> floats;   // filled
  ImageMetadata metadata;      // attributes that are text, in the file's order (EXR, PNG)
  // Index of a channel by its name, or -1.
  int find(const std::string& name) const;
};

// As stored; also of embedded files (core/image/embedded_file.h). Throws Error with the file and
// the reason: missing, not an image, truncated.
ImageFile read_image_file(const std::string& path);
// As floats, decoded as read_image() says.
Image decode_image(const ImageFile& file, const std::string& encoding);

// Module "image_io".
inline constexpr const char* read_symbol = "pssmlt_read_image";
using ReadFunction = void(const std::string& path, ImageFile& out);
inline constexpr const char* read_bytes_symbol = "pssmlt_read_image_bytes";
using ReadBytesFunction = void(const EmbeddedFile& file, ImageFile& out);
// `format`: the file's ending. Floats. Throws Failure.
inline constexpr const char* write_symbol = "pssmlt_write_image";
using WriteFunction = void(const std::string& path, const std::string& format, const Image& image,
                           const ImageMetadata& metadata);
// 8-bit pixels, already encoded for display. Throws Failure.
inline constexpr const char* write_bytes_symbol = "pssmlt_write_bytes";
struct ByteImage {
  int width = 0, height = 0, channels = 0;
  std::vector<uint8_t> data;
};
using WriteBytesFunction = void(const std::string& path, const std::string& format,
                                const ByteImage& image);

// Module "display": linear Rec.709, 3 channels, to what a display shows, [0, 1]. Throws Error if
// there is no such view.
inline constexpr const char* display_symbol = "pssmlt_display";
using DisplayFunction = void(std::vector<float>& rgb, int width, int height,
                             const std::string& view);

}  // namespace pssmlt
