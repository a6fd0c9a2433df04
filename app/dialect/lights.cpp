// v3's lights: factors that are colours, images by longitude and latitude, black bodies with a
// factor, spectra in absolute units.
#include <cmath>
#include <filesystem>

#include "app/dialect/translation.h"
#include "core/color/named_spectra.h"
#include "core/color/spectrum.h"
#include "core/color/spectrum_parameter.h"

namespace pssmlt::v3 {
namespace {

// Finds files alone; spectra need nothing else.
class Files final : public SceneResolver {
 public:
  explicit Files(const SceneDescription& scene) : scene_(scene) {}
  std::shared_ptr<const Texture<float>> float_texture(const std::string&,
                                                      const Location& where) override {
    throw Error(where, "a spectrum has no textures");
  }
  std::shared_ptr<const Texture<Rgb>> rgb_texture(const std::string&,
                                                  const Location& where) override {
    throw Error(where, "a spectrum has no textures");
  }
  std::string resolve_path(const std::string& name) const override {
    return (std::filesystem::path(scene_.directory) / name).string();
  }
  std::shared_ptr<const Material> material(const std::string&, const Location& where) override {
    throw Error(where, "a spectrum has no material");
  }

 private:
  const SceneDescription& scene_;
};

// Y of a spectrum where the constant spectrum 1 has Y = 1, which is v3's unit; today an emission
// spectrum is scaled to Y = 1.
float brightness(const Samples& samples) {
  const double y =
      xyz_integral([&](double lambda) { return evaluate(samples, lambda, Outside::Clamp); }).y;
  return static_cast<float>(y / xyz_integral([](double) { return 1.0; }).y);
}

// The factor that an emission in v3's units needs; black bodies lose their second number.
float take_brightness(const Translation& t, Parameter& p) {
  if (p.type == ParameterType::Blackbody && p.floats.size() == 2) {
    const float scale = p.floats[1];
    p.floats.resize(1);
    if (!(p.floats[0] >= 100.f)) return scale;  // whoever reads it refuses it
    return scale * brightness(blackbody_samples(static_cast<double>(p.floats[0])));
  }
  if (p.type != ParameterType::Spectrum || !t.old) return 1.f;
  if (p.strings.size() == 1 && named_spectrum(p.strings[0])) return 1.f;  // v3 has no names
  const Files files(t.scene);
  return brightness(spectrum_samples(p, files));
}

// Moves a colour's common factor to the light's "scale"; nullopt if it has a hue.
std::optional<float> grey_of(const Parameter& p) {
  const auto c = constant(p);
  if (!c || c->x != c->y || c->y != c->z) return std::nullopt;
  return c->x;
}

void set_scale(Directive& light, float factor) {
  if (factor == 1.f) return;
  const float given = take_number(light.parameters, "scale", 1.f);
  put(light.parameters, number("scale", given * factor, light.where));
}

// v3's "scale" is a colour. `emission`: the parameter that it multiplies.
void translate_scale(Translation& t, Directive& light, const char* emission) {
  const Parameter* const scale = find(light.parameters, "scale");
  if (scale == nullptr || scale->type == ParameterType::Float) return;
  const Parameter factor = *take(light.parameters, "scale");
  t.translated("light", light.type);
  if (const auto grey = grey_of(factor)) return set_scale(light, *grey);
  const auto hue = constant(factor);
  auto value = take(light.parameters, emission);
  if (!value) value = colour(emission, Rgb(1.f), factor.where);
  const auto base = constant(*value);
  if (!hue || !base)
    throw Error(factor.where, "\"scale\" of light \"" + light.type +
                                  "\" has a hue, which multiplies only an rgb \"" + emission +
                                  "\"");
  put(light.parameters, colour(emission, *hue * *base, value->where));
}

// An image takes the place of the colour, which must be grey.
void fold_into_scale(Directive& light, const char* emission) {
  const auto value = take(light.parameters, emission);
  if (!value) return;
  const auto grey = grey_of(*value);
  if (!grey)
    throw Error(value->where, "\"" + std::string(emission) + "\" of light \"" + light.type +
                                  "\" has a hue beside an image: multiply the image instead");
  set_scale(light, *grey);
}

void translate_image(Translation& t, LightDescription& light) {
  rename(light.parameters, "imagefile", "filename");
  const auto map = take(light.parameters, "mapname");
  const bool projection = light.type == "projection";
  if (projection && t.old && !has(light.parameters, "fov"))
    put(light.parameters, number("fov", 45.f, light.where));  // v3's default
  if (!map || (map->strings.size() == 1 && map->strings[0].empty())) return;
  t.translated("light", light.type);
  put(light.parameters, renamed(*map, "filename"));
  if (light.type == "infinite") fold_into_scale(light, "L");
  if (!projection) {
    put(light.parameters, text("mapping", {"equirectangular"}, map->where));
    return;
  }
  fold_into_scale(light, "I");
  // v3 projects the first row downwards.
  TransformPair& place = light.transform;
  const Transform flip = Transform::scale({1.0, -1.0, 1.0});
  place.start = place.start * flip;
  if (place.end) place.end = std::make_shared<const Transform>(*place.end * flip);
  place.steps =
      std::make_shared<TransformStep>("Scale 1 -1 1", std::array{true, true}, place.steps);
}

void translate_emission(Translation& t, Directive& light, const char* name) {
  translate_scale(t, light, name);
  if (Parameter* const value = find(light.parameters, name)) {
    const float factor = take_brightness(t, *value);
    if (factor != 1.f) t.translated("light", light.type);
    set_scale(light, factor);
  }
  if (!t.old) return;
  for (const char* dead : {"nsamples", "samples"}) take(light.parameters, dead);
}

}  // namespace

Rgb reflectance_of(const Translation& t, const Parameter& spectrum) {
  const Files files(t.scene);
  return spectrum_to_rgb(spectrum, SpectrumUse::Albedo, files);
}

void translate_lights(Translation& t) {
  for (LightDescription& light : t.scene.lights) {
    const bool radiance = light.type == "infinite" || light.type == "distant";
    translate_emission(t, light, radiance ? "L" : "I");
    translate_image(t, light);
  }
  for (Directive& light : t.scene.area_lights) {
    if (light.type == "area") {
      light.type = "diffuse";
      t.translated("light", "area");
    }
    translate_emission(t, light, "L");
  }
}

}  // namespace pssmlt::v3
