// Pixel arrays, and reading and writing them through the image module (OpenImageIO), which is
// loaded at the first call and never by a scene without images.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/rgb.h"

namespace pssmlt {

// Row-major, upper row first; channels interleaved: data[(y * width + x) * channels + c].
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<std::string> channel_names;  // "R", "G", "B", "albedo.R", ...; empty: R, G, B
  std::vector<float> data;
  Image() = default;
  Image(int w, int h, int c)
      : width(w),
        height(h),
        channels(c),
        data(static_cast<size_t>(w) * static_cast<size_t>(h) * static_cast<size_t>(c)) {}
  float* pixel(int x, int y) { return &data[(static_cast<size_t>(y) * width + x) * channels]; }
  const float* pixel(int x, int y) const {
    return &data[(static_cast<size_t>(y) * width + x) * channels];
  }
};

// Metadata written into the file where the format can hold it (EXR).
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

// How float images become 8-bit ones.
struct DisplaySettings {
  std::string view;  // OpenColorIO view; "": sRGB (the configuration's default view)
};

// Reads the file as floats. encoding: "sRGB", "linear", "gamma N", or "" for the format's own
// (8-bit files sRGB, float files linear). Throws Error if the file is missing or broken.
Image read_image(const std::string& path, const std::string& encoding);
// Writes atomically (temporary file, then rename). The ending chooses the format: exr, pfm, hdr
// (float) or png, jpg (through the display transform). Throws Failure with the reason.
void write_image(const std::string& path, const Image& image, const ImageMetadata& metadata,
                 const DisplaySettings& display);
// Throws Error now if `path` could not be written later: unknown ending, missing folder, no
// permission. Creates and removes a temporary file beside it.
void check_writable(const std::string& path);
// Throws Error now if there is no such view, naming those there are.
void check_view(const DisplaySettings& display);

}  // namespace pssmlt
