// What the stop of a lens system lets through: all of a disk, or by an image.
#pragma once

#include <optional>
#include <string>

#include "core/image/image.h"

namespace pssmlt {

class Aperture {
 public:
  // A circle.
  Aperture() = default;
  // "gaussian", "square", "pentagon", "star" or "circular"; nullopt for another name.
  static std::optional<Aperture> built_in(const std::string& name);
  // The mean of the image's colour channels, scaled so that as much light passes as through the
  // circle. Throws Error if the image is empty, lets nothing through or has values that are no
  // finite numbers from 0 on.
  static Aperture from_image(const std::string& file);

  // Transmission [1] at a point of the stop, in units of the radius of its opening.
  double value(const dvec2& at) const;
  // Radius, in these units, of the circle outside of which nothing passes.
  double reach() const { return reach_; }

 private:
  explicit Aperture(Image image);
  double texel(int x, int y) const;
  Image image_{0, 0, 1};  // empty: a circle
  double reach_ = 1.0;
};

}  // namespace pssmlt
