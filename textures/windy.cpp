// Waves on water under wind that varies from place to place: the product of two sums of octaves of
// Perlin's noise in the texture's space, the wind's ten times as wide as the waves'. Meant as a
// displacement; about 0 in the mean.
#include "core/noise.h"
#include "core/plugin/plugin.h"
#include "core/texture.h"
#include "core/texture_mapping.h"

namespace pssmlt {
namespace {

constexpr float wind_frequency = 0.1f;
constexpr Octaves wind{.count = 3}, waves{.count = 6};

class Windy final : public Texture<float> {
 public:
  static constexpr const char* summary = "waves under varying wind, positive and negative";

  explicit Windy(Parameters& p) : mapping_(p) {}
  float evaluate(const Hit& hit) const override {
    const vec3 p = mapping_.map(hit);
    const float footprint = mapping_.footprint(hit);
    const float strength = fbm(wind_frequency * p, wind.seen(wind_frequency * footprint));
    return std::abs(strength) * fbm(p, waves.seen(footprint));
  }

 private:
  TextureMapping3D mapping_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_FLOAT_TEXTURE_PLUGIN("windy", pssmlt::Windy)
