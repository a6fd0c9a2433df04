// Errors of float and double arithmetic as measured, beside the bounds that docs/numerics.md
// derives. `build/bin/test_numerics | grep numerics:` prints the note's table.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/base/math.h"
#include "core/base/random.h"

namespace pssmlt::test {

// Unit roundoff: the largest relative error of one operation that is rounded to nearest.
inline constexpr long double float_unit = 0x1p-24L, double_unit = 0x1p-53L;

// The worst of many errors, each in units of its own bound: 1 is the bound.
class Worst {
 public:
  Worst(std::string quantity, std::string bound)
      : quantity_(std::move(quantity)), bound_(std::move(bound)) {}
  // NaN counts as infinitely bad.
  void add(long double error, long double bound) {
    const long double share = std::abs(error) / bound;
    if (error == 0.0L) return;
    if (!(share <= share_)) share_ = std::isnan(share) ? INFINITY : share;
    if (!(std::abs(error) <= error_)) error_ = std::isnan(error) ? INFINITY : std::abs(error);
  }
  // Prints the line of the table and holds what was measured to the bound.
  void check() const {
    std::printf("numerics: %s | %s | %.2Lg | %.2Lg\n", quantity_.c_str(), bound_.c_str(), error_,
                share_);
    EXPECT_LE(share_, 1.0L) << quantity_ << ": worst " << error_;
  }
  long double error() const { return error_; }

 private:
  std::string quantity_, bound_;
  long double share_ = 0.0L, error_ = 0.0L;
};

inline long double relative(long double found, long double exact) {
  return exact == 0.0L ? (found == 0.0L ? 0.0L : INFINITY) : found / exact - 1.0L;
}

// Log-uniform in [low, high].
inline double spread(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, static_cast<double>(random.next()));
}

// In 80 bits, for references.
struct LongVec {
  long double x = 0, y = 0, z = 0;
  LongVec() = default;
  LongVec(long double a, long double b, long double c) : x(a), y(b), z(c) {}
  explicit LongVec(const vec3& v)
      : x(static_cast<long double>(v.x)),
        y(static_cast<long double>(v.y)),
        z(static_cast<long double>(v.z)) {}
  LongVec operator+(const LongVec& o) const { return {x + o.x, y + o.y, z + o.z}; }
  LongVec operator-(const LongVec& o) const { return {x - o.x, y - o.y, z - o.z}; }
  LongVec operator*(long double f) const { return {x * f, y * f, z * f}; }
};
inline long double dot(const LongVec& a, const LongVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LongVec cross(const LongVec& a, const LongVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline long double norm(const LongVec& a) { return std::sqrt(dot(a, a)); }
inline LongVec unit(const LongVec& a) { return a * (1.0L / norm(a)); }

}  // namespace pssmlt::test
