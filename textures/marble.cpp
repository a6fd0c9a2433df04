// Marble: layers across the y axis of the texture's space, shifted by a sum of octaves of Perlin's
// noise and coloured by a table of greys with a dark vein.
//
// Source: Perlin 1985, An Image Synthesizer, with pbrt-v4's colours. Cubic Bezier curves through
// four neighbours of the table follow each other by one colour, so that they do not join: the jumps
// are the sharp edges of the veins.
#include <algorithm>
#include <array>

#include "core/plugin/plugin.h"
#include "core/texture_mapping.h"
#include "core/texture_parameters.h"

namespace pssmlt {
namespace {

constexpr Rgb grey{0.58f, 0.58f, 0.6f}, middle{0.5f, 0.5f, 0.5f}, warm{0.6f, 0.59f, 0.58f},
    vein{0.2f, 0.2f, 0.33f};
constexpr std::array<Rgb, 9> colours = {grey, grey, grey, middle, warm, grey, grey, vein, grey};
constexpr int curves = static_cast<int>(colours.size()) - 3;
constexpr float brightness = 1.5f;

// The cubic Bezier curve with the control points c[0] to c[3] at t in [0, 1].
Rgb bezier(const Rgb* c, float t) {
  const float s = 1.f - t;
  return s * s * s * c[0] + 3.f * s * s * t * c[1] + 3.f * s * t * t * c[2] + t * t * t * c[3];
}

class Marble final : public Texture<Rgb> {
 public:
  static constexpr const char* summary = "grey layers with dark veins, bent by noise";

  explicit Marble(Parameters& p)
      : mapping_(p),
        octaves_(read_octaves(p)),
        scale_(p.number("scale", 1.f, "", "factor of the position")),
        variation_(p.number("variation", 0.2f, "", "factor of the noise that bends the layers")) {}

  Rgb evaluate(const Hit& hit) const override {
    const vec3 p = scale_ * mapping_.map(hit);
    const float footprint = std::abs(scale_) * mapping_.footprint(hit);
    const float height = p.y + variation_ * fbm(p, octaves_.seen(footprint));
    const float place = (0.5f + 0.5f * std::sin(height)) * static_cast<float>(curves);
    if (!std::isfinite(place)) return Rgb(place);
    const int curve = std::clamp(static_cast<int>(place), 0, curves - 1);
    return brightness *
           bezier(&colours[static_cast<size_t>(curve)], place - static_cast<float>(curve));
  }

 private:
  TextureMapping3D mapping_;
  Octaves octaves_;
  float scale_, variation_;
};

}  // namespace
}  // namespace pssmlt

PSSMLT_SPECTRUM_TEXTURE_PLUGIN("marble", pssmlt::Marble)
