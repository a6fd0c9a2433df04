#include "core/lens/aperture.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/error.h"
#include "core/base/math.h"

namespace pssmlt {
namespace {

constexpr int resolution = 256;
using Shape = std::function<double(const dvec2&)>;

// Corners all around the centre, the first one at angle `start`.
bool inside(const std::vector<dvec2>& corners, const dvec2& p) {
  bool in = false;
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const dvec2 &a = corners[i], &b = corners[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

dvec2 corner(double radius, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return radius * dvec2(std::cos(angle), std::sin(angle));
}

// Sizes and directions are those of the format's own renderer; the image is upside down in it.
Shape shape(const std::string& name) {
  if (name == "gaussian")
    return [](const dvec2& p) { return std::max(0.0, std::exp(-glm::dot(p, p)) - std::exp(-1.0)); };
  if (name == "square")
    return [](const dvec2& p) { return std::max(std::abs(p.x), std::abs(p.y)) <= 0.5 ? 1.0 : 0.0; };
  std::vector<dvec2> corners;
  if (name == "pentagon")
    for (int i = 0; i < 5; ++i) corners.push_back(corner(0.8, 90.0 + 72.0 * i));
  if (name == "star") {
    const double inner = corner(1.0, 72.0).x / corner(1.0, 36.0).x;  // of a pentagram
    for (int i = 0; i < 10; ++i) corners.push_back(corner(i % 2 == 1 ? 1.0 : inner, 36.0 * i));
  }
  if (corners.empty()) return {};
  return [corners](const dvec2& p) { return inside(corners, p) ? 1.0 : 0.0; };
}

// Centre of a texel, y up, in units of the opening's radius.
dvec2 center(const Image& image, int x, int y) {
  return {-1.0 + 2.0 * (x + 0.5) / image.width, 1.0 - 2.0 * (y + 0.5) / image.height};
}

}  // namespace

Aperture::Aperture(Image image) : image_(std::move(image)), reach_(0.0) {
  double sum = 0.0;
  const dvec2 texel_size(2.0 / image_.width, 2.0 / image_.height);
  for (int y = 0; y < image_.height; ++y) {
    for (int x = 0; x < image_.width; ++x) {
      const float v = *image_.pixel(x, y);
      sum += static_cast<double>(v);
      // Interpolation spreads a texel over its neighbours.
      if (v > 0.f)
        reach_ = std::max(reach_, glm::length(glm::abs(center(image_, x, y)) + texel_size));
    }
  }
  reach_ = std::min(reach_, std::numbers::sqrt2);
  if (!(sum > 0.0)) throw Error("the image of the aperture lets no light through");
  const double count = static_cast<double>(image_.width) * image_.height;
  const double scale = 0.25 * std::numbers::pi * count / sum;
  for (float& v : image_.data) v = static_cast<float>(scale * static_cast<double>(v));
}

std::optional<Aperture> Aperture::built_in(const std::string& name) {
  if (name == "circular") return Aperture();
  const Shape value = shape(name);
  if (!value) return std::nullopt;
  Image image(resolution, resolution, 1);
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const dvec2 p = center(image, x, y);
      *image.pixel(x, y) = static_cast<float>(value({p.x, -p.y}));
    }
  }
  return Aperture(std::move(image));
}

Aperture Aperture::from_image(const std::string& file) {
  const Image given = read_image(file, "");
  if (given.width <= 0 || given.height <= 0) throw Error(file + ": the image is empty");
  const int colours = given.channels >= 3 ? 3 : 1;  // the rest is opacity
  Image image(given.width, given.height, 1);
  for (int y = 0; y < given.height; ++y) {
    for (int x = 0; x < given.width; ++x) {
      float sum = 0.f;
      for (int c = 0; c < colours; ++c) sum += given.pixel(x, y)[c];
      if (!(std::isfinite(sum) && sum >= 0.f))
        throw Error(file + ": an aperture needs finite values from 0 on");
      *image.pixel(x, y) = sum / static_cast<float>(colours);
    }
  }
  return Aperture(std::move(image));
}

double Aperture::texel(int x, int y) const {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return 0.0;
  return static_cast<double>(*image_.pixel(x, y));
}

double Aperture::value(const dvec2& at) const {
  if (image_.width == 0) return glm::dot(at, at) <= 1.0 ? 1.0 : 0.0;
  const dvec2 p = 0.5 * dvec2(at.x + 1.0, 1.0 - at.y) * dvec2(image_.width, image_.height) - 0.5;
  if (!(glm::length(at) <= reach_)) return 0.0;
  const dvec2 low = glm::floor(p), w = p - low;
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
  return (1.0 - w.y) * ((1.0 - w.x) * texel(x, y) + w.x * texel(x + 1, y)) +
         w.y * ((1.0 - w.x) * texel(x, y + 1) + w.x * texel(x + 1, y + 1));
}

}  // namespace pssmlt
