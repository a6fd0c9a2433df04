// What the materials of this project share: the parameters that all of them read, and roughness.
#pragma once

#include <memory>
#include <optional>

#include "core/material.h"
#include "core/microfacet.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// Reads "displacement", "normalmap" and "normals" (with "normalscale"), of which at most one may be
// given.
class BumpedMaterial : public Material {
 public:
  const ShadingNormals* shading_normals() const final { return shading_normals_.get(); }

 protected:
  explicit BumpedMaterial(Parameters& p);
  bool bumped() const { return shading_normals_ != nullptr; }

 private:
  std::shared_ptr<const ShadingNormals> shading_normals_;
};

// Reads "roughness", "uroughness" and "vroughness", each behind `prefix`, and "remaproughness".
class RoughnessTextures {
 public:
  explicit RoughnessTextures(Parameters& p, const std::string& prefix = "");
  // Widths [1] along dpdu and dpdv, >= 0; NaN where a texture fails.
  vec2 alpha(const Hit& hit) const;
  // alpha(), if it is the same everywhere.
  std::optional<vec2> constant() const {
    return is_constant_ ? std::optional(constant_) : std::nullopt;
  }
  // For Material::isotropic(): the same width everywhere and in all directions.
  bool isotropic() const { return is_constant_ && constant_.x == constant_.y; }
  // Whether lobes are wide and whether they are mirrors; both where textures decide.
  bool may_be_rough() const { return !is_constant_ || !is_smooth_; }
  bool may_be_smooth() const { return !is_constant_ || is_smooth_; }

 private:
  float width(float roughness) const;
  std::shared_ptr<const Texture<float>> u_, v_;
  bool remap_ = true;
  bool is_constant_ = false, is_smooth_ = true;
  vec2 constant_{0.f};  // alpha() if it is
};

// A Bsdf whose every value is NaN, for points where a texture failed: the sample that meets it is
// dropped and counted.
const Bsdf* invalid_bsdf(BsdfStorage& storage);

// Clamped to [0, upper]. NaN, the sign of a texture that failed, stays NaN and so is counted.
inline float clamp_keep_nan(float x, float upper) { return x < 0.f ? 0.f : x > upper ? upper : x; }
inline Rgb clamp_reflectance(const Rgb& c) {
  return {clamp_keep_nan(c.x, 1.f), clamp_keep_nan(c.y, 1.f), clamp_keep_nan(c.z, 1.f)};
}

}  // namespace pssmlt
