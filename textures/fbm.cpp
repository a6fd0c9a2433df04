// Fractional Brownian motion: clouds, as a sum of octaves of Perlin's noise in the texture's space.
// About 0 in the mean; octaves finer than two pixels are left out.
#include "core/plugin/plugin.h"
#include "core/texture_mapping.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

class Fbm final : public Texture<float> {
 public:
  static constexpr const char* summary = "sum of octaves of noise, positive and negative";

  explicit Fbm(Parameters& p) : mapping_(p), octaves_(read_octaves(p)) {}
  float evaluate(const Hit& hit) const override {
    return fbm(mapping_.map(hit), octaves_.seen(mapping_.footprint(hit)));
  }

 private:
  TextureMapping3D mapping_;
  Octaves octaves_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_FLOAT_TEXTURE_PLUGIN("fbm", pssmlt::Fbm)
