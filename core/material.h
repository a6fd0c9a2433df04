// Materials: what a surface point scatters.
#pragma once

#include <memory>

#include "core/bsdf.h"
#include "core/hit.h"
#include "core/texture.h"

namespace pssmlt {

// What a material can do at all, for SceneFeatures and for path classes.
struct MaterialTraits {
  bool diffuse_lobes = false;   // connectible: eval can be non-zero (D in path expressions)
  bool delta_lobes = false;     // S in path expressions
  bool transmits = false;       // can scatter to the other side
  bool draws_numbers = false;   // reads its MaterialNumbers
  bool passes_through = false;  // invisible (interface): rays go straight on
};

// The two numbers of u that a vertex keeps for its material (mix takes the first).
struct MaterialNumbers {
  float first = 0.f, second = 0.f;
};

class Material {
 public:
  virtual ~Material() = default;
  // Evaluates textures at the hit and draws what is random from `u`; the Bsdf lives in `storage`.
  // Returns nullptr where nothing scatters (black).
  virtual const Bsdf* bsdf(const Hit& hit, MaterialNumbers u, BsdfStorage& storage) const = 0;
  virtual MaterialTraits traits() const = 0;
  // Height field [m] that bends the shading frame (pbrt's "displacement"); null: none.
  virtual const Texture<float>* displacement() const { return nullptr; }
};

}  // namespace pssmlt
