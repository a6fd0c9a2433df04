// montage OUTPUT IMAGE...: puts pictures of one size side by side, with a thin white line between
// them, and writes them as one (PNG and JPEG through the display transform).
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"

namespace {
using namespace pssmlt;

constexpr int gap = 4;  // [pixels]

Image beside(const std::vector<Image>& parts) {
  const int width = parts[0].width, height = parts[0].height;
  const int count = static_cast<int>(parts.size());
  Image sum(count * width + (count - 1) * gap, height, 3);
  std::ranges::fill(sum.data, 1.f);
  for (int i = 0; i < count; ++i) {
    const Image& part = parts[static_cast<size_t>(i)];
    if (part.width != width || part.height != height || part.channels < 3) {
      throw Error("the pictures differ in size");
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::copy_n(part.pixel(x, y), 3, sum.pixel(i * (width + gap) + x, y));
      }
    }
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: montage OUTPUT IMAGE...\n");
    return 2;
  }
  try {
    std::vector<Image> parts;
    for (int i = 2; i < argc; ++i) parts.push_back(read_image(argv[i], "linear"));
    write_image(argv[1], beside(parts), {}, {});
  } catch (const std::exception& e) {
    fmt::print(stderr, "montage: {}\n", e.what());
    return 1;
  }
  return 0;
}
