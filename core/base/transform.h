// Affine and projective transformations, composed in double.
#pragma once

#include "core/base/math.h"

namespace pssmlt {

// A 4x4 matrix with its inverse, column vectors (p' = M p). Composition keeps both in double.
class Transform {
 public:
  Transform() : m_(1.0), inverse_(1.0) {}
  // Precondition: m is invertible (callers check with is_invertible first where it is input).
  explicit Transform(const dmat4& m);
  Transform(const dmat4& m, const dmat4& inverse) : m_(m), inverse_(inverse) {}

  static Transform translate(const dvec3& t);
  static Transform scale(const dvec3& s);
  // Angle in degrees, as pbrt's Rotate.
  static Transform rotate(double degrees, const dvec3& axis);
  // World to camera, as pbrt's LookAt. Returns a singular or non-finite matrix if degenerate: check
  // with is_invertible(m).
  static dmat4 look_at(const dvec3& eye, const dvec3& look, const dvec3& up);
  // False if m is singular or has non-finite entries.
  static bool is_invertible(const dmat4& m);

  const dmat4& matrix() const { return m_; }
  const dmat4& inverse_matrix() const { return inverse_; }
  Transform inverse() const { return {inverse_, m_}; }
  friend Transform operator*(const Transform& a, const Transform& b) {
    return {a.m_ * b.m_, b.inverse_ * a.inverse_};
  }

  // Points are divided by w where the matrix is projective.
  dvec3 point(const dvec3& p) const;
  dvec3 vector(const dvec3& v) const;
  // By the inverse transpose; not normalised.
  dvec3 normal(const dvec3& n) const;
  vec3 point(const vec3& p) const { return vec3(point(dvec3(p))); }
  vec3 vector(const vec3& v) const { return vec3(vector(dvec3(v))); }
  vec3 normal(const vec3& n) const { return vec3(normal(dvec3(n))); }

  // True if the transformation mirrors (negative determinant of the linear part).
  bool swaps_handedness() const;

 private:
  dmat4 m_, inverse_;
};

}  // namespace pssmlt
