// What scenes say about a metal: the parameters that "conductor" and "coatedconductor" share.
#pragma once

#include <memory>
#include <string>

#include "core/material.h"
#include "core/rough_mirror.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// Reads <prefix>eta and <prefix>k, or "reflectance" instead of both. Throws Error if both are
// given.
class Metal {
 public:
  // outside: refractive index above the metal.
  Metal(Parameters& p, const std::string& prefix, float outside);
  // At a point; nullopt where a texture failed. Black: nothing is reflected there.
  std::optional<MetalReflectance> at(const Hit& hit) const;
  bool reads_derivatives() const { return reflectance_ && reflectance_->reads_derivatives(); }

 private:
  FresnelCurve read_curve(Parameters& p, const std::string& prefix);
  FresnelCurve read_index(Parameters& p, const std::string& prefix) const;
  float outside_;
  std::shared_ptr<const Texture<Rgb>> reflectance_;  // if it varies; the curve is then not used
  FresnelCurve curve_;
};

}  // namespace pssmlt
