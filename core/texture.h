// Textures: functions of a surface point. The footprint that filters an image is a property of the
// point (its distance to the camera), never of the path that reached it, so that every strategy of
// a bidirectional method evaluates the same f.
#pragma once

#include <memory>

#include "core/base/rgb.h"
#include "core/hit.h"

namespace pssmlt {

// T is float or Rgb.
template <typename T>
class Texture {
 public:
  virtual ~Texture() = default;
  // Value at the hit. Uses position, uv, dpdu, dpdv, footprint; draws no random numbers. Thread
  // safe. A failure (unreadable tile) returns NaN, which drops and counts the sample.
  virtual T evaluate(const Hit& hit) const = 0;
  // True if evaluate() does not depend on the hit: callers may fold the value.
  virtual bool constant() const { return false; }
  // False if evaluate() asks the hit for none of dpdu, dpdv, dndu, dndv.
  virtual bool reads_derivatives() const { return !constant(); }
};

template <typename T>
class ConstantTexture final : public Texture<T> {
 public:
  explicit ConstantTexture(const T& value) : value_(value) {}
  T evaluate(const Hit&) const override { return value_; }
  bool constant() const override { return true; }

 private:
  T value_;
};

template <typename T>
std::shared_ptr<const Texture<T>> constant_texture(const T& value) {
  return std::make_shared<const ConstantTexture<T>>(value);
}

}  // namespace pssmlt
