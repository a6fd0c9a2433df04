// How stored pixel values stand for linear ones.
#pragma once

#include <string>

namespace pssmlt {

class Encoding {
 public:
  // "sRGB", "linear" or "gamma N" (pbrt-v4's names); throws Error on anything else.
  static Encoding parse(const std::string& text);
  static Encoding linear() { return {Kind::linear, 1.f}; }
  static Encoding srgb() { return {Kind::srgb, 1.f}; }

  bool is_linear() const { return kind_ == Kind::linear; }
  // Stored value in [0, 1] to linear (IEC 61966-2-1 for sRGB).
  float to_linear(float stored) const;
  // The inverse.
  float from_linear(float value) const;

 private:
  enum class Kind { linear, srgb, gamma };
  Encoding(Kind kind, float gamma) : kind_(kind), gamma_(gamma) {}
  Kind kind_;
  float gamma_;
};

}  // namespace pssmlt
