// A point that emits as measured lamps do: its intensity is an image over all directions.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.2.3. The image is a
// square equal-area map (Clarberg 2008) with the y axis of the light's space through its middle, of
// which the mean of red, green and blue counts; without one the light is a point light. Directions
// are sampled exactly in proportion to it. Blind spot: rays never meet the light.
#include "core/base/warp.h"
#include "core/light_point.h"
#include "core/plugin/plugin.h"
#include "core/sphere_map.h"

namespace pssmlt {
namespace {

class GoniometricLight final : public PointEmitter {
 public:
  static constexpr const char* summary = "Point whose intensity is an image over all directions";

  explicit GoniometricLight(Parameters& p) {
    intensity_ = p.rgb("I", Rgb(1.f), SpectrumUse::Illuminant, "W/sr", "Factor of the image.");
    const float scale = p.number("scale", 1.f, "", "Factor of the intensity.");
    const float power = p.number("power", -1.f, "W", "Total emitted power; negative: from I.");
    const std::string file = p.file("filename", "Image of intensity, a map of the sphere.");
    const SphereMapping mapping = read_sphere_mapping(p);
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (p.describing()) return;
    LightImage image =
        file.empty() ? LightImage{1, 1, {Rgb(1.f)}} : read_sphere_image(p, file, mapping);
    for (Rgb& pixel : image.pixels) pixel = Rgb((pixel.x + pixel.y + pixel.z) / 3.f);
    const glm::dmat3 linear(p.transform().matrix());
    // The image's z is the light's y.
    map_ = SphereMap(std::move(image), mapping, glm::dmat3(linear[0], linear[2], linear[1]));
    position_ = vec3(p.transform().point(dvec3(0.0)));
    intensity_ *= scale;
    if (power > 0.f && !(map_.mean() > 0.f)) p.fail("power", "the image is black");
    if (power > 0.f) intensity_ *= power / (4.f * pi * map_.mean());
  }

  float power() const override { return 4.f * pi * luminance(intensity_) * map_.mean(); }

 private:
  std::optional<vec3> sample_direction(const dvec2& u) const override {
    const auto sample = map_.sample(u);
    return sample ? std::optional(sample->direction) : std::nullopt;
  }
  float pdf_direction(const vec3& direction) const override { return map_.pdf(direction); }
  Rgb intensity(const vec3& direction) const override { return intensity_ * map_.value(direction); }

  SphereMap map_;
  Rgb intensity_{1.f};  // factor of the map [W/sr]
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "goniometric", pssmlt::GoniometricLight)
