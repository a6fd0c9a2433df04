#include "core/base/transform.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace pssmlt {
namespace {

bool all_finite(const dmat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

// |det| over the product of the columns' lengths (Hadamard's bound): 1 for orthogonal columns, 0
// for a singular matrix, independent of the scale of each column.
template <typename Matrix>
double hadamard_ratio(const Matrix& m) {
  Matrix unit = m;
  for (int c = 0; c < Matrix::length(); ++c) {
    // The largest entry is divided out first, so that squaring it cannot overflow.
    double largest = 0.0;
    for (int r = 0; r < Matrix::length(); ++r) largest = std::max(largest, std::abs(m[c][r]));
    if (largest == 0.0) return 0.0;
    unit[c] /= largest;
    unit[c] /= glm::length(unit[c]);
  }
  return std::abs(glm::determinant(unit));
}

// The better of the column and the row ratio: scaling along the axes of either space, however
// unequal, is no sign of singularity. The threshold leaves a factor of 1000 over rounding.
template <typename Matrix>
bool has_full_rank(const Matrix& m) {
  const double ratio = std::max(hadamard_ratio(m), hadamard_ratio(glm::transpose(m)));
  return ratio > 1e-13;
}

bool is_affine(const dmat4& m) {
  return m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0;
}

}  // namespace

Transform::Transform(const dmat4& m) : m_(m), inverse_(glm::inverse(m)) {}

Transform Transform::translate(const dvec3& t) {
  return {glm::translate(dmat4(1.0), t), glm::translate(dmat4(1.0), -t)};
}

Transform Transform::scale(const dvec3& s) {
  return {glm::scale(dmat4(1.0), s), glm::scale(dmat4(1.0), 1.0 / s)};
}

Transform Transform::rotate(double degrees, const dvec3& axis) {
  const dmat4 m = glm::rotate(dmat4(1.0), glm::radians(degrees), axis);
  return {m, glm::transpose(m)};
}

dmat4 Transform::look_at(const dvec3& eye, const dvec3& look, const dvec3& up) {
  // pbrt's camera space is left-handed: x right, y up, z along the view.
  const dvec3 z = glm::normalize(look - eye);
  const dvec3 right = glm::cross(glm::normalize(up), z);
  // Nearly parallel up and view leave only rounding in the cross product.
  if (!(glm::length(right) > 1e-12)) return dmat4(0.0);
  const dvec3 x = glm::normalize(right);
  const dvec3 y = glm::cross(z, x);
  const dmat4 world_from_camera(glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0),
                                glm::dvec4(eye, 1.0));
  return glm::inverse(world_from_camera);
}

bool Transform::is_invertible(const dmat4& m) {
  if (!all_finite(m)) return false;
  if (!(is_affine(m) ? has_full_rank(glm::dmat3(m)) : has_full_rank(m))) return false;
  return all_finite(glm::inverse(m));
}

dvec3 Transform::point(const dvec3& p) const {
  const glm::dvec4 q = m_ * glm::dvec4(p, 1.0);
  return q.w == 1.0 ? dvec3(q) : dvec3(q) / q.w;
}

dvec3 Transform::vector(const dvec3& v) const { return dvec3(m_ * glm::dvec4(v, 0.0)); }

dvec3 Transform::normal(const dvec3& n) const { return glm::transpose(glm::dmat3(inverse_)) * n; }

bool Transform::swaps_handedness() const { return glm::determinant(glm::dmat3(m_)) < 0.0; }

}  // namespace pssmlt
