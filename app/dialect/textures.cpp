// v3's textures, and textures that the translation of materials needs.
#include <algorithm>

#include "app/dialect/translation.h"

namespace pssmlt::v3 {
namespace {

const TextureDescription* find_texture(const SceneDescription& scene, const std::string& name,
                                       TextureValue value) {
  const auto found = std::ranges::find_if(scene.textures, [&](const TextureDescription& d) {
    return d.name == name && d.value == value;
  });
  return found == scene.textures.end() ? nullptr : &*found;
}

// v3 filters images by an ellipse unless "trilinear" asks for less.
void translate_image(Translation& t, TextureDescription& d) {
  ParameterSet& set = d.parameters;
  const bool old_names = has(set, "trilinear") || has(set, "gamma");
  if (has(set, "trilinear") || (t.old && !has(set, "filter"))) {
    const bool trilinear = take_flag(set, "trilinear", false);
    put(set, text("filter", {trilinear ? "trilinear" : "ewa"}, d.where));
  }
  if (const auto gamma = take(set, "gamma")) {
    std::string encoding;
    if (gamma->type == ParameterType::Bool && gamma->bools.size() == 1) {
      encoding = gamma->bools[0] != 0 ? "sRGB" : "linear";
    } else if (gamma->type == ParameterType::Float && gamma->floats.size() == 1) {
      encoding = "gamma " + std::to_string(gamma->floats[0]);
    } else {
      throw Error(gamma->where, "parameter \"gamma\" must be one bool or float");
    }
    put(set, text("encoding", {encoding}, gamma->where));
  }
  if (old_names || t.old) t.translated("texture", "imagemap");
}

// v3 multiplies two textures of the same kind; today the second factor is a number.
void translate_scale(Translation& t, TextureDescription& d) {
  ParameterSet& set = d.parameters;
  if (!has(set, "tex1") && !has(set, "tex2")) return;
  t.translated("texture", "scale");
  auto first = take(set, "tex1"), second = take(set, "tex2");
  if (!first) first = number("tex1", 1.f, d.where);
  if (!second) second = number("tex2", 1.f, d.where);
  const auto is_grey = [](const Parameter& p) {
    const auto c = constant(p);
    return c && c->x == c->y && c->y == c->z;
  };
  if (!is_grey(*second) && is_grey(*first)) std::swap(first, second);
  const auto a = constant(*first), b = constant(*second);
  const bool colours = d.value == TextureValue::Spectrum;
  if (a && b) {
    d.type = "constant";
    put(set, colours ? colour("value", *a * *b, d.where) : number("value", a->x * b->x, d.where));
    return;
  }
  if (colours && a && !b) std::swap(first, second);
  put(set, renamed(*first, "tex"));
  if (colours && constant(*second) && !is_grey(*second))
    throw Error(second->where, "texture \"" + d.name +
                                   "\": a texture times a colour has no counterpart; split it "
                                   "into the colour channels, or use a grey factor");
  if (!colours) return put(set, renamed(*second, "scale"));
  if (const auto grey = constant(*second)) return put(set, number("scale", grey->x, d.where));
  t.dropped("the hue of the second factor of texture \"" + d.name + "\"");
  make_float_texture(t, second->strings.empty() ? "" : second->strings[0], second->where);
  put(set, renamed(*second, "scale"));
}

// (s, t, 0) as a colour.
void translate_uv(Translation& t, TextureDescription& d) {
  t.translated("texture", "uv");
  d.type = "bilerp";
  put(d.parameters, colour("v00", {0.f, 0.f, 0.f}, d.where));
  put(d.parameters, colour("v10", {1.f, 0.f, 0.f}, d.where));
  put(d.parameters, colour("v01", {0.f, 1.f, 0.f}, d.where));
  put(d.parameters, colour("v11", {1.f, 1.f, 0.f}, d.where));
}

}  // namespace

void make_float_texture(Translation& t, const std::string& name, const Location& where) {
  if (find_texture(t.scene, name, TextureValue::Float) != nullptr) return;
  const TextureDescription* const source = find_texture(t.scene, name, TextureValue::Spectrum);
  if (source == nullptr) throw Error(where, "no texture is named \"" + name + "\"");
  TextureDescription copy = *source;
  copy.value = TextureValue::Float;
  for (Parameter& p : copy.parameters) {
    if (p.type == ParameterType::Texture && p.strings.size() == 1)
      make_float_texture(t, p.strings[0], p.where);
    if (p.type != ParameterType::Rgb) continue;
    p = number(p.name, *constant_luminance(p), p.where);
  }
  t.scene.textures.push_back(std::move(copy));
}

Parameter as_share(Translation& t, const Parameter& colour, std::string name) {
  if (const auto value = constant_luminance(colour))
    return number(std::move(name), std::clamp(*value, 0.f, 1.f), colour.where);
  if (colour.type != ParameterType::Texture || colour.strings.size() != 1)
    throw Error(colour.where, "parameter \"" + colour.name + "\" must be rgb, float or a texture");
  make_float_texture(t, colour.strings[0], colour.where);
  return renamed(colour, std::move(name));
}

Parameter scaled(Translation& t, const Parameter& value, const Rgb& factor, std::string name) {
  if (factor == Rgb(1.f)) return renamed(value, std::move(name));
  if (const auto c = constant(value)) {
    Parameter result = colour(std::move(name), *c * factor, value.where);
    result.color_space = value.color_space;
    return result;
  }
  if (factor.x != factor.y || factor.y != factor.z)
    throw Error(value.where,
                "parameter \"" + value.name + "\": a texture times a colour has no counterpart");
  TextureDescription d;
  d.type = "scale";
  d.where = value.where;
  d.name = "v3: " + value.name + " " + std::to_string(t.scene.textures.size());
  d.value = TextureValue::Spectrum;
  d.parameters = {renamed(value, "tex"), number("scale", factor.x, value.where)};
  t.scene.textures.push_back(d);
  return texture(std::move(name), d.name, value.where);
}

void translate_textures(Translation& t) {
  // By index, on a copy: float textures may be added on the way.
  const size_t count = t.scene.textures.size();
  for (size_t i = 0; i < count; ++i) {
    TextureDescription d = t.scene.textures[i];
    if (d.type == "imagemap") translate_image(t, d);
    if (d.type == "scale") translate_scale(t, d);
    if (d.type == "uv") translate_uv(t, d);
    if (t.old) take(d.parameters, "aamode");
    t.scene.textures[i] = std::move(d);
  }
}

}  // namespace pssmlt::v3
