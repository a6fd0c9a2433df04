// How a small step moves one number of the torus [0,1), in 32-bit fixed point. The distance is a
// function of 31 random bits and the 32nd is its sign, so that a step and its reverse have exactly
// the same probability, and integer overflow is the torus: the uniform distribution is invariant.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/base/random.h"

namespace pssmlt {

enum class KernelShape : uint8_t { kelemen, gaussian, cauchy };

class Kernel {
 public:
  // scale, in units of the torus: kelemen: the largest distance s2 < 1/2, with s1 = s2 / ratio
  // (Kelemen et al. 2002, section 4: s1 = 1/1024, s2 = 1/64); gaussian: standard deviation; cauchy:
  // half width. Larger scales than 1 are 1.
  Kernel(KernelShape shape, double scale, double ratio = 16.0)
      : shape_(shape),
        scale_(static_cast<float>(std::min(scale, largest(shape)) * 0x1p32)),
        log2_ratio_(static_cast<float>(std::log2(ratio))) {}

  // The number after a step that the 32 random bits decide.
  uint32_t step(uint32_t x, uint32_t bits) const { return shift(x, distance_of(bits), bits); }
  // Four numbers at once.
  RandomBlock step(const RandomBlock& x, const RandomBlock& bits) const {
    RandomBlock moved;
    if (shape_ == KernelShape::kelemen) {
      for (size_t i = 0; i < 4; ++i) moved[i] = shift(x[i], kelemen(bits[i]), bits[i]);
    } else {
      for (size_t i = 0; i < 4; ++i) moved[i] = step(x[i], bits[i]);
    }
    return moved;
  }

 private:
  // Kelemen's distances stay within half the torus, which is as far as one can go.
  static double largest(KernelShape shape) { return shape == KernelShape::kelemen ? 0.4999 : 1.0; }
  // 2^x for x in [-32, 0], relative error below 4e-6: the step's shape, not its symmetry.
  static float exp2_fast(float x) {
    const auto whole = static_cast<int32_t>(x) - 1;  // x - whole in [0, 1]
    const float f = x - static_cast<float>(whole);
    float p = 0.0136703095f;
    p = 0.0517449978f + p * f;
    p = 0.241604357f + p * f;
    p = 0.692972922f + p * f;
    p = 1.00000349f + p * f;
    return p * std::bit_cast<float>((whole + 127) << 23);
  }
  static uint32_t shift(uint32_t x, uint32_t distance, uint32_t bits) {
    const uint32_t sign = 0u - (bits >> 31);
    return x + ((distance ^ sign) - sign);
  }
  // The bits of the distance as a number, exact, in (0, 1).
  static float unit(uint32_t bits) {
    return (static_cast<float>(static_cast<int32_t>(bits >> 9 & 0x3FFFFFu)) + 0.5f) * 0x1p-22f;
  }
  // Free of branches, for vector instructions.
  uint32_t kelemen(uint32_t bits) const {
    const float distance = scale_ * exp2_fast(-log2_ratio_ * unit(bits));
    return static_cast<uint32_t>(static_cast<int32_t>(distance));
  }
  uint32_t distance_of(uint32_t bits) const {
    switch (shape_) {
      case KernelShape::kelemen:
        return kelemen(bits);
      case KernelShape::gaussian:
        return to_torus(scale_ * half_normal(unit(bits)));
      case KernelShape::cauchy:
        break;
    }
    return to_torus(scale_ * std::tan(0.5f * std::numbers::pi_v<float> * unit(bits)));
  }
  // Distances beyond once around are wrapped.
  static uint32_t to_torus(float distance) {
    return static_cast<uint32_t>(static_cast<uint64_t>(static_cast<int64_t>(distance)));
  }
  // Quantile of |X|, X standard normal: sqrt 2 erfinv(u) (Giles 2010, Approximating the erfinv
  // Function, single precision).
  static float half_normal(float u) {
    float w = -std::log((1.f - u) * (1.f + u));
    float p;
    if (w < 5.f) {
      w -= 2.5f;
      p = 2.81022636e-08f;
      p = 3.43273939e-07f + p * w;
      p = -3.5233877e-06f + p * w;
      p = -4.39150654e-06f + p * w;
      p = 0.00021858087f + p * w;
      p = -0.00125372503f + p * w;
      p = -0.00417768164f + p * w;
      p = 0.246640727f + p * w;
      p = 1.50140941f + p * w;
    } else {
      w = std::sqrt(w) - 3.f;
      p = -0.000200214257f;
      p = 0.000100950558f + p * w;
      p = 0.00134934322f + p * w;
      p = -0.00367342844f + p * w;
      p = 0.00573950773f + p * w;
      p = -0.0076224613f + p * w;
      p = 0.00943887047f + p * w;
      p = 1.00167406f + p * w;
      p = 2.83297682f + p * w;
    }
    return std::numbers::sqrt2_v<float> * p * u;
  }

  KernelShape shape_;
  float scale_;  // in units of 2^-32
  float log2_ratio_;
};

}  // namespace pssmlt
