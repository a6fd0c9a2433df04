// Materials: what a surface point scatters.
#pragma once

#include <memory>

#include "core/bsdf.h"
#include "core/hit.h"
#include "core/plugin/plugin_name.h"
#include "core/shading_normals.h"
#include "core/texture.h"

namespace pssmlt {

// What a material can do at all, for SceneFeatures and for path classes.
struct MaterialTraits {
  bool diffuse_lobes = false;   // connectible: eval can be non-zero (D in path expressions)
  bool delta_lobes = false;     // S in path expressions
  bool transmits = false;       // can scatter to the other side
  bool draws_numbers = false;   // reads its MaterialNumbers
  bool disperses = false;       // reads the path's wavelength (core/path/dispersion.h)
  bool passes_through = false;  // invisible (interface): rays go straight on
};

class Medium;
class PrimarySample;

// Vertices of the shared stream that one hit's walk between layers may read.
inline constexpr int walk_vertices = 11;

// The two numbers of u that a vertex keeps for its material (mix takes the first), and where
// materials that need more find theirs (core/layered/walk_numbers.h).
struct MaterialNumbers {
  float first = 0.f, second = 0.f;
  PrimarySample* sample = nullptr;  // null: no walk
  int walk = 0;                     // first of walk_vertices vertices of the shared stream
};

class Material : public PluginNamed {
 public:
  virtual ~Material() = default;
  // Evaluates textures at the hit and draws what is random from `u`; the Bsdf lives in `storage`.
  // Returns nullptr where nothing scatters (black).
  virtual const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const = 0;
  virtual MaterialTraits traits() const = 0;
  // What bends the shading frame (pbrt's "displacement" and "normalmap"); null: nothing.
  virtual const ShadingNormals* shading_normals() const { return nullptr; }
  // True if scattering depends on none of the hit's dpdu, dpdv, dndu and dndv, textures included,
  // and looks the same turned around the shading normal: hits are then found without derivatives.
  virtual bool isotropic() const { return false; }
  // The medium behind surfaces of this material, where scenes name none; null: what they name.
  virtual std::shared_ptr<const Medium> interior() const { return nullptr; }
};

}  // namespace pssmlt
