#include "core/light_image.h"

#include <algorithm>
#include <array>

#include "core/base/log.h"
#include "core/image/image.h"

namespace pssmlt {
namespace {

Image read(const Parameters& p, const std::string& file) {
  try {
    return read_image(file, "");
  } catch (const Error& e) {
    p.fail("filename", e.what());
  }
}

}  // namespace

const Rgb& LightImage::nearest(const dvec2& uv) const {
  return at(std::clamp(static_cast<int>(uv.x * width), 0, width - 1),
            std::clamp(static_cast<int>(uv.y * height), 0, height - 1));
}

LightImage read_light_image(const Parameters& p, const std::string& file) {
  const Image image = read(p, file);
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  if (count == 0) p.fail("filename", "'" + file + "' is empty");
  LightImage result{image.width, image.height, {}};
  result.pixels.reserve(count);
  size_t clipped = 0;
  for (size_t i = 0; i < count; ++i) {
    const float* const c = &image.data[i * static_cast<size_t>(image.channels)];
    const Rgb value = image.channels < 3 ? Rgb(c[0]) : Rgb(c[0], c[1], c[2]);
    if (!is_finite(value))
      p.fail("filename", "'" + file + "' has pixels that are not finite numbers");
    result.pixels.push_back(glm::max(value, Rgb(0.f)));
    clipped += result.pixels.back() != value;
  }
  if (clipped != 0)
    log_warning("'" + file + "': " + std::to_string(clipped) +
                " pixels with negative components were clipped to 0");
  return result;
}

SphereMapping read_sphere_mapping(Parameters& p) {
  constexpr std::array<std::string_view, 2> names = {"equalarea", "equirectangular"};
  const std::string name = p.choice("mapping", names[0], names,
                                    "How the image covers the sphere: a square equal-area map, or "
                                    "longitude across, latitude down.");
  return name == names[0] ? SphereMapping::equal_area : SphereMapping::lat_long;
}

LightImage read_sphere_image(const Parameters& p, const std::string& file, SphereMapping mapping) {
  LightImage image = read_light_image(p, file);
  if (mapping == SphereMapping::equal_area && image.width != image.height)
    p.fail("filename", "'" + file + "' has " + std::to_string(image.width) + " x " +
                           std::to_string(image.height) +
                           " pixels: maps of the sphere must be square equal-area maps (for maps "
                           "of longitude and latitude say \"string mapping\" \"equirectangular\")");
  return image;
}

}  // namespace pssmlt
