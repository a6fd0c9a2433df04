// Transformations that change over time, for motion blur.
#pragma once

#include <array>

#include <glm/gtc/quaternion.hpp>

#include "core/base/transform.h"

namespace pssmlt {

// M = T R S: rotation, and a stretch S that is upper triangular (the factors of a QR
// decomposition of M's linear part), which is what Embree interpolates.
struct Pose {
  dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dmat3 stretch{1.0};
  // Precondition: the matrix is affine and invertible.
  static Pose of(const dmat4& matrix);
  dmat4 matrix() const;
};

// Between two transformations: translation and stretch linear, rotation along the shorter arc at
// constant speed (Shoemake 1985). Time runs from 0 to 1.
class MovingTransform {
 public:
  MovingTransform(const Transform& start, const Transform& end);
  Transform at(float time) const;
  // The rotation of the end has the sign that makes the arc the shorter one.
  const std::array<Pose, 2>& poses() const { return poses_; }

 private:
  std::array<Pose, 2> poses_;
};

}  // namespace pssmlt
