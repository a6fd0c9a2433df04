// v3's materials that are one of today's under another name, and roughness.
#include <array>
#include <cmath>
#include <utility>

#include "app/dialect/translation.h"

namespace pssmlt::v3 {
namespace {

// The width of the lobe that v3 gives a roughness: a fit to how its roughness looked before.
float width_of(float roughness) {
  const float x = std::log(std::max(roughness, 1e-3f));
  return 1.62142f + x * (0.819955f + x * (0.1734f + x * (0.0171201f + x * 0.000640711f)));
}

// Nothing but white is left of a colour that a material had.
void drop_unless_white(Translation& t, ParameterSet& set, const std::string& name,
                       const std::string& material) {
  const auto p = take(set, name);
  if (p && constant(*p) != Rgb(1.f)) t.dropped(name + " of " + material);
}

void matte(Translation& t, MaterialDescription& m) {
  m.type = "diffuse";
  put(m.parameters, renamed(take_colour(t, m.parameters, "Kd", 0.5f, m.where), "reflectance"));
  const auto sigma = take(m.parameters, "sigma");
  if (sigma && constant_luminance(*sigma) != 0.f) t.dropped("sigma of matte");
}

void metal(Translation& t, MaterialDescription& m) {
  m.type = "conductor";
  drop_unless_white(t, m.parameters, "Kr", "metal");
  translate_roughness(t, m.parameters, 0.01f, true, m.where);
}

void mirror(Translation& t, MaterialDescription& m) {
  m.type = "conductor";
  put(m.parameters, renamed(take_colour(t, m.parameters, "Kr", 0.9f, m.where), "reflectance"));
  put(m.parameters, number("roughness", 0.f, m.where));
  for (const char* name : {"uroughness", "vroughness", "remaproughness"})
    if (take(m.parameters, name)) t.dropped(std::string(name) + " of mirror");
}

void glass(Translation& t, MaterialDescription& m) {
  m.type = "dielectric";
  drop_unless_white(t, m.parameters, "Kr", "glass");
  drop_unless_white(t, m.parameters, "Kt", "glass");
  rename(m.parameters, "index", "eta");
  translate_roughness(t, m.parameters, 0.f, false, m.where);
}

void translucent(Translation& t, MaterialDescription& m) {
  m.type = "diffusetransmission";
  ParameterSet& set = m.parameters;
  const Parameter kd = take_colour(t, set, "Kd", 0.25f, m.where);
  const Parameter ks = take_colour(t, set, "Ks", 0.25f, m.where);
  if (constant(ks) != Rgb(0.f)) t.dropped("Ks of translucent");
  for (const char* name : {"roughness", "uroughness", "vroughness", "remaproughness"})
    take(set, name);
  for (const auto& [from, to] :
       {std::pair{"reflect", "reflectance"}, std::pair{"transmit", "transmittance"}}) {
    const Parameter factor = take_colour(t, set, from, 0.5f, m.where);
    const auto constant_factor = constant(factor);
    if (constant_factor) {
      put(set, scaled(t, kd, *constant_factor, to));
    } else if (const auto constant_kd = constant(kd)) {
      put(set, scaled(t, factor, *constant_kd, to));
    } else {
      throw Error(factor.where, std::string("material \"translucent\": Kd and ") + from +
                                    " cannot both be textures");
    }
  }
}

// v3's share is of the first material, and may be a colour.
void mix(Translation& t, MaterialDescription& m) {
  ParameterSet& set = m.parameters;
  const std::string first = take_text(set, "namedmaterial1", "");
  const std::string second = take_text(set, "namedmaterial2", "");
  if (first.empty() || second.empty())
    throw Error(m.where, "material \"mix\" needs \"namedmaterial1\" and \"namedmaterial2\"");
  const Parameter amount = take_colour(t, set, "amount", 0.5f, m.where);
  const auto c = constant(amount);
  if (!c || c->x != c->y || c->y != c->z) t.dropped("the hue of amount of mix");
  put(set, as_share(t, amount, "amount"));
  put(set, text("materials", {second, first}, m.where));
}

void hair(Translation&, MaterialDescription& m) { rename(m.parameters, "color", "reflectance"); }

void subsurface(Translation& t, MaterialDescription& m) {
  const std::string was = m.type;
  if (was == "kdsubsurface") rename(m.parameters, "Kd", "reflectance");
  m.type = "subsurface";
  drop_unless_white(t, m.parameters, "Kr", was);
  drop_unless_white(t, m.parameters, "Kt", was);
  translate_roughness(t, m.parameters, 0.f, false, m.where);
}

void nothing(Translation&, MaterialDescription& m) {
  m.type = "interface";
  m.parameters.clear();
}

[[noreturn]] void fourier(Translation&, MaterialDescription& m) {
  throw Error(m.where,
              "material \"fourier\" has no counterpart: tables of this kind are not read; use "
              "\"measured\" or a material with parameters");
}

void plastic(Translation& t, MaterialDescription& m) { translate_plastic(t, m); }
void substrate(Translation& t, MaterialDescription& m) { translate_substrate(t, m); }
void disney(Translation& t, MaterialDescription& m) { translate_disney(t, m); }

struct Rule {
  std::string_view name;
  void (*translate)(Translation&, MaterialDescription&);
};
// "uber" stands apart, since it changes shapes as well.
constexpr std::array<Rule, 12> rules = {{{"matte", matte},
                                         {"plastic", plastic},
                                         {"metal", metal},
                                         {"mirror", mirror},
                                         {"glass", glass},
                                         {"translucent", translucent},
                                         {"substrate", substrate},
                                         {"disney", disney},
                                         {"kdsubsurface", subsurface},
                                         {"fourier", fourier},
                                         {"none", nothing},
                                         {"uber", nullptr}}};

const Rule* find_rule(std::string_view name) {
  for (const Rule& rule : rules)
    if (rule.name == name) return &rule;
  return nullptr;
}

}  // namespace

// "none" is also today's, though not liked.
bool is_old_material(const std::string& type) {
  return type != "none" && find_rule(type) != nullptr;
}

Parameter take_colour(const Translation& t, ParameterSet& set, std::string_view name,
                      float fallback, const Location& where) {
  auto given = take(set, name);
  if (!given) return colour(std::string(name), Rgb(fallback), where);
  if (given->type != ParameterType::Spectrum) return std::move(*given);
  return colour(given->name, reflectance_of(t, *given), given->where);
}

float take_index(ParameterSet& set, const std::string& owner) {
  rename(set, "index", "eta");
  const auto eta = take(set, "eta");
  if (!eta) return 1.5f;
  const auto value = constant_luminance(*eta);
  if (!value || !(*value > 1.f))
    throw Error(eta->where, "\"eta\" of material \"" + owner + "\" must be one number above 1");
  return *value;
}

void translate_roughness(Translation& t, ParameterSet& set, float fallback, bool general,
                         const Location& where) {
  auto both = general ? take(set, "roughness") : std::nullopt;
  auto u = take(set, "uroughness"), v = take(set, "vroughness");
  bool remap = take_flag(set, "remaproughness", true);
  if (!both) both = number("roughness", fallback, where);
  if (!u) u = both;
  if (!v) v = both;
  const auto cu = constant_luminance(*u), cv = constant_luminance(*v);
  if (!cu || !cv) {  // the curve of a texture cannot be changed
    if (remap) t.dropped("v3's curve of roughness, of textures");
    put(set, renamed(*u, "uroughness"));
    put(set, renamed(*v, "vroughness"));
    put(set, flag("remaproughness", remap, where));
    return;
  }
  const bool smooth = !general && *cu == 0.f && *cv == 0.f;
  const auto width = [&](float r) { return smooth ? 0.f : remap ? width_of(r) : r; };
  if (*cu == *cv) {
    put(set, number("roughness", width(*cu), u->where));
  } else {
    put(set, number("uroughness", width(*cu), u->where));
    put(set, number("vroughness", width(*cv), v->where));
  }
  put(set, flag("remaproughness", false, where));
}

void translate_materials(Translation& t) {
  const size_t count = t.scene.materials.size();
  for (size_t i = 0; i < count; ++i) {
    MaterialDescription m = t.scene.materials[i];  // a copy: others may be added on the way
    const std::string was = m.type;
    const Rule* const rule = find_rule(m.type);
    const bool bumped = has(m.parameters, "bumpmap");
    rename(m.parameters, "bumpmap", "displacement");
    if (rule != nullptr && rule->translate != nullptr) {
      rule->translate(t, m);
    } else if (rule != nullptr) {
      translate_uber(t, m, static_cast<uint32_t>(i));
    } else if (m.type == "mix" && has(m.parameters, "namedmaterial1")) {
      mix(t, m);
    } else if (m.type == "hair" && has(m.parameters, "color")) {
      hair(t, m);
    } else if (m.type == "subsurface" && t.old) {
      subsurface(t, m);
    } else if (!bumped) {
      continue;
    }
    t.translated("material", was);
    t.scene.materials[i] = std::move(m);
  }
}

}  // namespace pssmlt::v3
