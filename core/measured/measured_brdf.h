// Reflectance from tables of measurements. All directions are local, above the surface (z > 0).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/base/rgb.h"

namespace pssmlt {

class MeasuredBrdf {
 public:
  virtual ~MeasuredBrdf() = default;
  // The table's f(wo, wi) [1/sr]; where the table tells its directions apart wo is the first.
  virtual Rgb eval(const vec3& wo, const vec3& wi) const = 0;
  // Density of sample(wo) at wi [1/sr], positive for all wi.
  virtual float pdf(const vec3& wo, const vec3& wi) const = 0;
  // A direction; nullopt where it fell below the surface, which pdf() leaves out.
  virtual std::optional<vec3> sample(const vec3& wo, float u_lobe, const vec2& u) const = 0;
};

// The file's table, by what the file holds, not by its name: RGL's tensors or a MERL table. Throws
// Error with a message that names no place.
std::shared_ptr<const MeasuredBrdf> read_measured_brdf(const std::string& path);

}  // namespace pssmlt
