#include "core/base/motion.h"

namespace pssmlt {

Pose Pose::of(const dmat4& matrix) {
  Pose pose;
  pose.translation = dvec3(matrix[3]);
  const glm::dmat3 m(matrix);
  glm::dmat3 q;
  q[0] = glm::normalize(m[0]);
  q[1] = glm::normalize(m[1] - q[0] * glm::dot(q[0], m[1]));
  q[2] = glm::cross(q[0], q[1]);  // a rotation; a mirrored matrix gets a negative stretch along z
  pose.rotation = glm::normalize(glm::quat_cast(q));
  pose.stretch = glm::transpose(q) * m;
  pose.stretch[0][1] = pose.stretch[0][2] = pose.stretch[1][2] = 0.0;  // rounding
  return pose;
}

dmat4 Pose::matrix() const {
  dmat4 m(glm::mat3_cast(rotation) * stretch);
  m[3] = dvec4(translation, 1.0);
  return m;
}

MovingTransform::MovingTransform(const Transform& start, const Transform& end)
    : poses_{Pose::of(start.matrix()), Pose::of(end.matrix())} {
  if (glm::dot(poses_[0].rotation, poses_[1].rotation) < 0.0) {
    poses_[1].rotation = -poses_[1].rotation;
  }
}

Transform MovingTransform::at(float time) const {
  const double t = static_cast<double>(time);
  const auto& [a, b] = poses_;
  Pose pose;
  pose.translation = glm::mix(a.translation, b.translation, t);
  pose.rotation = glm::slerp(a.rotation, b.rotation, t);
  pose.stretch = a.stretch * (1.0 - t) + b.stretch * t;
  return Transform(pose.matrix());
}

}  // namespace pssmlt
