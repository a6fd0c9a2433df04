// Parallel light from one direction, as from the sun but without its extent.
//
// Source: Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 12.3. L, though the
// format calls it radiance, is the irradiance of a surface that faces the light; "illuminance"
// replaces its magnitude. Blind spot: rays never meet it, so only connections find it.
#include "core/light_infinite.h"
#include "core/plugin/plugin.h"

namespace pssmlt {
namespace {

class DistantLight final : public Light {
 public:
  static constexpr const char* summary = "Parallel light from one direction";

  explicit DistantLight(Parameters& p) {
    irradiance_ = p.rgb("L", Rgb(1.f), SpectrumUse::Illuminant, "W/m^2",
                        "Irradiance of a surface that faces the light.");
    const float scale = p.number("scale", 1.f, "", "Factor of L.");
    const vec3 from = p.point("from", vec3(0.f), "m", "The light flies from here ...");
    const vec3 to = p.point("to", vec3(0.f, 0.f, 1.f), "m", "... toward here.");
    const float illuminance =
        p.number("illuminance", -1.f, "W/m^2", "Magnitude of the irradiance; negative: from L.");
    if (scale < 0.f) p.fail("scale", "\"scale\" must not be negative");
    if (p.describing()) return;
    const dvec3 d = p.transform().vector(dvec3(to) - dvec3(from));
    if (!(glm::length(d) > 0.0)) p.fail("to", "\"to\" must differ from \"from\"");
    direction_ = vec3(glm::normalize(d));
    irradiance_ *= scale;
    if (illuminance > 0.f) irradiance_ *= illuminance;
  }

  EndpointTraits traits() const override { return {.delta_direction = true, .infinite = true}; }
  void prepare(const SceneBounds& bounds) override { disk_.set(bounds); }
  float power() const override { return disk_.area() * luminance(irradiance_); }

  std::optional<Emission> emit(const vec2& u_position, const dvec2&) const override {
    Emission e;
    e.from = disk_.sample(direction_, u_position);
    e.direction = direction_;
    e.value = irradiance_;
    e.pdf_position = disk_.pdf();
    e.pdf_direction = 1.f;
    return e;
  }
  std::optional<Toward> toward(const vec3&, const vec2&) const override {
    Toward t;
    t.at.normal = direction_;
    t.wi = -direction_;
    t.distance = infinity;
    t.value = irradiance_;
    t.pdf_toward = 1.f;
    t.pdf_position = disk_.pdf();
    t.pdf_direction = 1.f;
    return t;
  }
  EmissionValue evaluate(const EndpointPoint&, const vec3&) const override {
    return {irradiance_, 1.f, disk_.pdf(), 1.f};
  }
  float pdf_toward(const vec3&, const EndpointPoint&) const override { return 1.f; }

 private:
  EntryDisk disk_;
  vec3 direction_{0.f, 0.f, 1.f};  // of flight
  Rgb irradiance_{0.f};            // [W/m^2]
};

}  // namespace
}  // namespace pssmlt

PSSMLT_PLUGIN(Light, "distant", pssmlt::DistantLight)
