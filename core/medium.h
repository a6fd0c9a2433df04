// Participating media: what scatters, absorbs and emits between surfaces. Plugins of the kind
// "medium" (MakeNamedMedium).
//
// A medium knows its optical depth along a ray exactly and can invert it: free flight takes one
// number an edge, whatever lies on it, and the density of every path is a function of the path
// alone (Pharr, Jakob, Humphreys 2023, chapter 11; Novak et al. 2018, Monte Carlo Methods for
// Volumetric Light Transport Simulation, section 3).
#pragma once

#include <optional>

#include "core/base/ray.h"
#include "core/bsdf.h"
#include "core/plugin/plugin_name.h"

namespace pssmlt {

// A medium at a point, by channel.
struct MediumPoint {
  Rgb extinction{0.f};  // sigma_t: absorption and scattering [1/m]
  Rgb scattering{0.f};  // sigma_s [1/m]
  Rgb emission{0.f};    // radiance gained along the way [W/(m^3 sr)]
};

struct MediumTraits {
  bool scatters = false;  // sigma_s is not zero everywhere
  bool emits = false;
};

class Medium : public PluginNamed {
 public:
  virtual ~Medium() = default;
  virtual MediumTraits traits() const = 0;
  // Integral of the extinction over the ray from 0 to t_max [1]. t_max may be infinite, and so may
  // the result; never NaN.
  virtual Rgb optical_depth(const Ray& ray) const = 0;
  // Where on the ray, from 0 to t_max [m], the optical depth of `channel` reaches `depth` (>= 0);
  // nullopt if it does not. The inverse of optical_depth().
  virtual std::optional<float> distance(const Ray& ray, int channel, float depth) const = 0;
  virtual MediumPoint at(const vec3& position) const = 0;
  // How light is redirected at a point, in `storage`: eval() is the phase function [1/sr] in any
  // frame, no cosine; both directions point away from the point. Never null.
  virtual const Bsdf* phase(const vec3& position, BsdfStorage& storage) const = 0;
};

// The media on both sides of a surface; null: vacuum.
struct MediumInterface {
  const Medium* inside = nullptr;
  const Medium* outside = nullptr;
  // What a ray along `direction` enters; ng points outside.
  const Medium* toward(const vec3& direction, const vec3& ng) const {
    return glm::dot(direction, ng) > 0.f ? outside : inside;
  }
};

inline float mean(const Rgb& c) { return (c.x + c.y + c.z) * (1.f / 3.f); }
inline Rgb transmittance_of(const Rgb& optical_depth) { return glm::exp(-optical_depth); }

}  // namespace pssmlt
