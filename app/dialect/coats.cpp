// v3's materials that add up lobes. v3 puts a Lambertian lobe beside a glossy one; here the base
// lies under the coat, and its reflectance is what shows the same colour through it.
#include <algorithm>
#include <cmath>

#include "app/dialect/translation.h"
#include "core/coat.h"

namespace pssmlt::v3 {
namespace {

constexpr float plastic_eta = 1.5f;
// A coat in front of a base, as its plugin makes it by default [mean free paths].
constexpr float coat_thickness = 0.01f;

bool is_black(const Parameter& p) { return constant(p) == Rgb(0.f); }

// What the parts of a material share.
struct Parts {
  Parameter diffuse;   // the Lambertian lobe
  Parameter specular;  // factor of the coat's reflection
  float eta = plastic_eta;
  ParameterSet roughness;              // as translated
  std::optional<Parameter> bump = {};  // "displacement"
};

MaterialDescription part(const MaterialDescription& m, const char* type) {
  MaterialDescription d;
  d.type = type;
  d.where = m.where;
  return d;
}

std::string add_named(Translation& t, MaterialDescription m) {
  m.name = "v3: " + m.type + " " + std::to_string(t.scene.materials.size());
  t.scene.materials.push_back(m);
  return m.name;
}

// m becomes a mixture, with `amount` of b.
void make_mix(Translation& t, MaterialDescription& m, MaterialDescription a, MaterialDescription b,
              Parameter amount) {
  const std::string first = add_named(t, std::move(a)), second = add_named(t, std::move(b));
  m.type = "mix";
  m.parameters = {std::move(amount), text("materials", {first, second}, m.where)};
}

MaterialDescription diffuse_part(const MaterialDescription& m, const Parts& parts) {
  MaterialDescription d = part(m, "diffuse");
  d.parameters = {renamed(parts.diffuse, "reflectance")};
  if (parts.bump) d.parameters.push_back(*parts.bump);
  return d;
}

// The geometric mean of both widths, of which the loss in the coat is that.
float mean_width(ParameterSet roughness) {
  const auto value = [&](const char* name, float fallback) {
    const Parameter* const p = find(roughness, name);
    return p == nullptr ? fallback : constant_luminance(*p).value_or(0.f);
  };
  const float both = value("roughness", 0.f);
  return std::sqrt(value("uroughness", both) * value("vroughness", both));
}

MaterialDescription coated_part(Translation& t, const MaterialDescription& m, const Parts& parts) {
  MaterialDescription d = part(m, "coateddiffuse");
  const float width = mean_width(parts.roughness);
  if (const auto seen = constant(parts.diffuse)) {
    const Coat coat(parts.eta, coat_thickness, width);
    Parameter base = colour("reflectance", coat.base_of(*seen, parts.eta), m.where);
    base.color_space = parts.diffuse.color_space;
    d.parameters = {std::move(base)};
  } else {
    TextureDescription base;
    base.type = "undercoat";
    base.where = m.where;
    base.name = "v3: base " + std::to_string(t.scene.textures.size());
    base.value = TextureValue::Spectrum;
    base.parameters = {renamed(parts.diffuse, "tex"), number("eta", parts.eta, m.where),
                       number("width", width, m.where)};
    t.scene.textures.push_back(base);
    d.parameters = {texture("reflectance", base.name, m.where)};
  }
  d.parameters.push_back(number("eta", parts.eta, m.where));
  for (const Parameter& p : parts.roughness) d.parameters.push_back(p);
  if (parts.bump) d.parameters.push_back(*parts.bump);
  return d;
}

void become(MaterialDescription& m, MaterialDescription made) {
  m.type = made.type;
  m.parameters = std::move(made.parameters);
}

// A Lambertian lobe and `specular` times the reflection of a coat. A coat reflects all that it
// reflects: a factor below 1 is the share of the surface that has a coat.
void add_lobes(Translation& t, MaterialDescription& m, const Parts& parts) {
  const std::string was = m.type;
  if (is_black(parts.specular)) return become(m, diffuse_part(m, parts));
  const auto share = constant_luminance(parts.specular);
  const auto hue = constant(parts.specular);
  if (!hue || hue->x != hue->y || hue->y != hue->z) t.dropped("the hue of Ks of " + was);
  if (share && *share >= 1.f) return become(m, coated_part(t, m, parts));
  if (parts.bump) {  // parts with bumps of their own are not mixed
    t.dropped("Ks of " + was + " with a bump map");
    return become(m, coated_part(t, m, parts));
  }
  Parameter amount = as_share(t, parts.specular, "amount");
  MaterialDescription base = diffuse_part(m, parts), coated = coated_part(t, m, parts);
  make_mix(t, m, std::move(base), std::move(coated), std::move(amount));
}

Parts take_parts(Translation& t, ParameterSet& set, float kd, float ks, float roughness,
                 bool general, const Location& where) {
  Parts parts{
      take_colour(t, set, "Kd", kd, where), take_colour(t, set, "Ks", ks, where), plastic_eta, {}};
  translate_roughness(t, set, roughness, general, where);
  for (const char* name : {"roughness", "uroughness", "vroughness", "remaproughness"})
    if (auto p = take(set, name)) parts.roughness.push_back(std::move(*p));
  parts.bump = take(set, "displacement");
  return parts;
}

// Parameters that no rule took are left for the material that will refuse them.
void keep_unknown(MaterialDescription& m, ParameterSet rest) {
  for (Parameter& p : rest) m.parameters.push_back(std::move(p));
}

ParameterSet smooth(const Location& where) { return {number("roughness", 0.f, where)}; }

// v3's opacity, which is the shapes' today.
void take_opacity(Translation& t, ParameterSet& set, uint32_t index) {
  const Parameter opacity = take_colour(t, set, "opacity", 1.f, t.scene.materials[index].where);
  const auto c = constant(opacity);
  if (c == Rgb(1.f)) return;
  if (!c || c->x != c->y || c->y != c->z) t.dropped("the hue of opacity of uber");
  t.opacity.emplace(index, as_share(t, opacity, "alpha"));
}

}  // namespace

void translate_plastic(Translation& t, MaterialDescription& m) {
  ParameterSet set = std::move(m.parameters);
  add_lobes(t, m, take_parts(t, set, 0.25f, 0.25f, 0.1f, true, m.where));
  keep_unknown(m, std::move(set));
}

// Ks is the reflectance at normal incidence: it gives the coat's index of refraction.
void translate_substrate(Translation& t, MaterialDescription& m) {
  constexpr float highest_eta = 2.5f;
  ParameterSet set = std::move(m.parameters);
  Parts parts = take_parts(t, set, 0.5f, 0.5f, 0.1f, false, m.where);
  const auto ks = constant_luminance(parts.specular);
  if (!ks) t.dropped("Ks of substrate, a texture");
  if (is_black(parts.specular)) {
    become(m, diffuse_part(m, parts));
  } else {
    const float root = std::sqrt(std::clamp(ks.value_or(0.04f), 0.f, 0.99f));
    const float eta = (1.f + root) / (1.f - root);
    if (eta > highest_eta) t.dropped("what Ks of substrate reflects beyond an index of 2.5");
    parts.eta = std::clamp(eta, 1.01f, highest_eta);
    parts.diffuse = scaled(t, parts.diffuse, Rgb(1.f - root * root), "Kd");
    become(m, coated_part(t, m, parts));
  }
  keep_unknown(m, std::move(set));
}

void translate_uber(Translation& t, MaterialDescription& m, uint32_t index) {
  ParameterSet set = std::move(m.parameters);
  take_opacity(t, set, index);
  const float eta = take_index(set, m.type);
  const Parameter kr = take_colour(t, set, "Kr", 0.f, m.where);
  const Parameter kt = take_colour(t, set, "Kt", 0.f, m.where);
  Parts parts = take_parts(t, set, 0.25f, 0.25f, 0.1f, true, m.where);
  parts.eta = eta;
  if (is_black(parts.specular) && !is_black(kr)) {
    parts.specular = renamed(kr, "Ks");
    parts.roughness = smooth(m.where);
  } else if (!is_black(kr) && is_black(kt)) {
    t.dropped("Kr of uber beside Ks");
  }
  const float through = is_black(kt) ? 0.f : constant_luminance(kt).value_or(0.5f);
  if (through <= 0.f) {
    add_lobes(t, m, parts);
    return keep_unknown(m, std::move(set));
  }
  if (!constant(kt)) t.dropped("Kt of uber, a texture, taken as 0.5");
  MaterialDescription glass = part(m, "dielectric");
  glass.parameters = {number("eta", eta, m.where)};
  // The share of glass takes away from the other lobes what v3 adds to them.
  const float share = std::min(through, 1.f);
  if (share >= 1.f || (is_black(parts.diffuse) && is_black(kr))) {
    become(m, std::move(glass));
    return keep_unknown(m, std::move(set));
  }
  if (const auto kd = constant(parts.diffuse))
    parts.diffuse = colour("Kd", glm::min(*kd / (1.f - share), Rgb(1.f)), m.where);
  else
    parts.diffuse = scaled(t, parts.diffuse, Rgb(1.f / (1.f - share)), "Kd");
  parts.bump = std::nullopt;
  MaterialDescription rest = part(m, "uber");
  add_lobes(t, rest, parts);
  make_mix(t, m, std::move(rest), std::move(glass), number("amount", share, m.where));
  keep_unknown(m, std::move(set));
}

// The nearest: a metal and a coated base, mixed by "metallic", or glass.
void translate_disney(Translation& t, MaterialDescription& m) {
  ParameterSet set = std::move(m.parameters);
  for (const char* name :
       {"speculartint", "anisotropic", "sheen", "clearcoat", "scatterdistance", "flatness"}) {
    const auto p = take(set, name);
    if (p && constant(*p) != Rgb(0.f)) t.dropped(std::string(name) + " of disney");
  }
  for (const char* name : {"sheentint", "clearcoatgloss", "difftrans"}) take(set, name);
  if (take_flag(set, "thin", false)) t.dropped("thin of disney");
  Parts parts{take_colour(t, set, "color", 0.5f, m.where),
              colour("Ks", Rgb(1.f), m.where),
              take_index(set, m.type),
              {}};
  const Parameter roughness = take_colour(t, set, "roughness", 0.5f, m.where);
  const auto width = constant_luminance(roughness);
  if (!width) t.dropped("roughness of disney, a texture, taken as 0.5");
  parts.roughness = {number("roughness", width.value_or(0.5f) * width.value_or(0.5f), m.where),
                     flag("remaproughness", false, m.where)};
  parts.bump = take(set, "displacement");
  const auto transmission = take(set, "spectrans"), metallic = take(set, "metallic");
  const float through = transmission ? constant_luminance(*transmission).value_or(0.f) : 0.f;
  MaterialDescription coated = coated_part(t, m, parts), metal = part(m, "conductor");
  metal.parameters = parts.roughness;
  metal.parameters.push_back(renamed(parts.diffuse, "reflectance"));
  if (parts.bump) metal.parameters.push_back(*parts.bump);
  if (through > 0.5f) {
    MaterialDescription glass = part(m, "dielectric");
    glass.parameters = parts.roughness;
    glass.parameters.push_back(number("eta", parts.eta, m.where));
    become(m, std::move(glass));
  } else if (!metallic || constant_luminance(*metallic) == 0.f) {
    become(m, std::move(coated));
  } else if (parts.bump || constant_luminance(*metallic).value_or(0.f) >= 1.f) {
    const bool more_metal = constant_luminance(*metallic).value_or(1.f) >= 0.5f;
    become(m, more_metal ? std::move(metal) : std::move(coated));
  } else {
    Parameter amount = as_share(t, *metallic, "amount");
    make_mix(t, m, std::move(coated), std::move(metal), std::move(amount));
  }
  keep_unknown(m, std::move(set));
}

}  // namespace pssmlt::v3
