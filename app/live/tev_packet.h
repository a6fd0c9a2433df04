// Packets of the protocol by which programs show pictures in the viewer tev
// (https://github.com/Tom94/tev): a length that counts itself, as 32 bits, then a type byte and
// fields, all little-endian, texts ended by a zero byte.
#pragma once

#include <string>

#include "core/image/image.h"

namespace pssmlt {

inline constexpr int tev_port = 14158;

enum class TevType : char { create_image = 4, update_image = 6 };  // update: its third version

// An empty picture of this name, with the channels R, G and B; it replaces one of the same name.
std::string tev_create(const std::string& name, int width, int height);

// A window of the picture, pixels [x, x + width) x [y, y + height). `image` has three channels.
struct TevWindow {
  int x = 0, y = 0, width = 0, height = 0;
};
std::string tev_update(const std::string& name, const Image& image, const TevWindow& window);

}  // namespace pssmlt
