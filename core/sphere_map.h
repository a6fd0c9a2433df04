// A function of direction given by an image, equal-area or by longitude and latitude, turned and
// perhaps stretched by a linear map, with directions sampled exactly in proportion to its
// luminance.
#pragma once

#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "core/base/distribution.h"
#include "core/base/equal_area.h"
#include "core/base/lat_long.h"
#include "core/light_image.h"

namespace pssmlt {

class SphereMap {
 public:
  SphereMap() = default;
  // `image` is square if it is an equal-area map; `to_render` maps its space to render space and is
  // invertible.
  SphereMap(LightImage image, SphereMapping mapping, const glm::dmat3& to_render)
      : image_(std::move(image)), to_render_(to_render), to_image_(glm::inverse(to_render)) {
    if (mapping == SphereMapping::lat_long) lat_long_.emplace(image_.height);
    determinant_ = std::abs(glm::determinant(to_image_));
    std::vector<float> weights;
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x)
        weights.push_back(luminance(image_.at(x, y)) * row_weight(y));
    distribution_ = Distribution2D(weights, image_.width, image_.height);
  }

  bool empty() const { return image_.empty(); }
  const LightImage& image() const { return image_; }
  bool equal_area() const { return !lat_long_; }
  // The direction, in the image's space, of a point of the unit square that the image fills.
  dvec3 direction(const dvec2& uv) const {
    return lat_long_ ? lat_long_->direction(uv) : square_to_sphere(uv);
  }
  // Solid angle of the pixels of a row over that of an average one.
  float row_weight(int y) const {
    return lat_long_ ? static_cast<float>(lat_long_->weight(y)) : 1.f;
  }
  // Of the image, in luminance; the mean over the sphere unless the map is stretched.
  float mean() const {
    return static_cast<float>(distribution_.sum() / static_cast<double>(image_.pixels.size()));
  }

  // The pixel seen in a direction in render space.
  const Rgb& value(const vec3& direction) const {
    return image_.nearest(to_square(glm::normalize(to_image_ * dvec3(direction))));
  }

  struct Sample {
    vec3 direction;  // unit, in render space
    float pdf;       // [1/sr]
  };
  // nullopt if the image is black there.
  std::optional<Sample> sample(const dvec2& u) const {
    if (!(distribution_.sum() > 0.0)) return std::nullopt;
    const auto point = distribution_.sample(u);
    const vec3 towards(glm::normalize(to_render_ * direction(point.uv)));
    // Rounding may have moved the direction into the next pixel: value and density are those there.
    const float density = pdf(towards);
    if (!(density > 0.f)) return std::nullopt;
    return Sample{towards, density};
  }
  // Density of sample() [1/sr].
  float pdf(const vec3& direction) const {
    const dvec3 d = to_image_ * dvec3(direction);
    const double length = glm::length(d);
    // Solid angle in the image's space over that in render space: 1 for rotations.
    const double stretch = determinant_ / (length * length * length);
    const dvec2 uv = to_square(d / length);
    const double crowding = lat_long_ ? 1.0 / lat_long_->weight_at(uv.y) : 1.0;
    return static_cast<float>(distribution_.pdf(uv) * stretch * crowding *
                              (0.25 * std::numbers::inv_pi));
  }

 private:
  dvec2 to_square(const dvec3& d) const {
    return lat_long_ ? lat_long_->square(d) : sphere_to_square(d);
  }

  LightImage image_;
  std::optional<LatLong> lat_long_;  // nullopt: an equal-area map
  glm::dmat3 to_render_{1.0}, to_image_{1.0};
  double determinant_ = 1.0;  // of to_image_
  Distribution2D distribution_;
};

}  // namespace pssmlt
