// Turbulence: creases, as a sum of octaves of the magnitude of Perlin's noise in the texture's
// space. Octaves finer than two pixels count with their mean.
#include "core/plugin/plugin.h"
#include "core/texture_mapping.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

class Wrinkled final : public Texture<float> {
 public:
  static constexpr const char* summary = "sum of octaves of the magnitude of noise";

  explicit Wrinkled(Parameters& p) : mapping_(p), octaves_(read_octaves(p)) {}
  float evaluate(const Hit& hit) const override {
    return turbulence(mapping_.map(hit), octaves_.seen(mapping_.footprint(hit)));
  }

 private:
  TextureMapping3D mapping_;
  Octaves octaves_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_FLOAT_TEXTURE_PLUGIN("wrinkled", pssmlt::Wrinkled)
