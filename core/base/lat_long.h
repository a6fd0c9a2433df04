// Maps of the sphere by longitude (across) and latitude (down), the form that most environment
// images have: the upper edge is +z, the lower -z, the left and right edges meet at +x, a quarter
// of the width to the right is +y.
//
// Rows have equal angles; inside a row the map is bent so that equal areas of it are equal solid
// angles. A pixel then covers what it covers in such an image, and is sampled uniformly.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/math.h"

namespace pssmlt {

class LatLong {
 public:
  explicit LatLong(int rows) {
    for (int i = 0; i <= rows; ++i) cosines_.push_back(std::cos(std::numbers::pi * i / rows));
  }

  // The direction, unit, of a point of the unit square.
  dvec3 direction(const dvec2& uv) const {
    const double y = uv.y * rows();
    const int row = std::clamp(static_cast<int>(y), 0, rows() - 1);
    const double z = cosine(row) + (y - row) * (cosine(row + 1) - cosine(row));
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z)), phi = 2.0 * std::numbers::pi * uv.x;
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  // Its inverse, for unit directions.
  dvec2 square(const dvec3& d) const {
    const double turns = std::atan2(d.y, d.x) * (0.5 * std::numbers::inv_pi);
    const double theta = std::atan2(std::sqrt(d.x * d.x + d.y * d.y), d.z);
    const int row =
        std::clamp(static_cast<int>(theta * std::numbers::inv_pi * rows()), 0, rows() - 1);
    const double part = (cosine(row) - d.z) / (cosine(row) - cosine(row + 1));
    return {turns < 0.0 ? turns + 1.0 : turns, (row + std::clamp(part, 0.0, 1.0)) / rows()};
  }
  // Solid angle of a row over that of an average one.
  double weight(int row) const { return 0.5 * rows() * (cosine(row) - cosine(row + 1)); }
  // The same for the row that a point of the unit square lies in.
  double weight_at(double v) const {
    return weight(std::clamp(static_cast<int>(v * rows()), 0, rows() - 1));
  }

 private:
  int rows() const { return static_cast<int>(cosines_.size()) - 1; }
  double cosine(int i) const { return cosines_[static_cast<size_t>(i)]; }
  std::vector<double> cosines_;  // at the edges of the rows
};

}  // namespace pssmlt
