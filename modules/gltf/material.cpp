#include "modules/gltf/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/plugin/registry.h"

namespace pssmlt::gltf {
namespace {

vec3 color_of(const std::vector<double>& v, const vec3& fallback) {
  return v.size() < 3 ? fallback : vec3(dvec3(v[0], v[1], v[2]));
}

constexpr const char* medium_type = "homogeneous";

bool has_media() {
  const std::vector<std::string> names = Registry::instance().names("medium");
  return std::ranges::find(names, medium_type) != names.end();
}

}  // namespace

struct Materials::Source {
  const tinygltf::Material& material;
  int index = -1;
  bool vertex_colors = false;
  Textures::Context context;

  const tinygltf::Value* extension(const char* name) const {
    return gltf::extension(material.extensions, name);
  }
  TextureReference base_texture() const {
    const tinygltf::TextureInfo& t = material.pbrMetallicRoughness.baseColorTexture;
    return texture_reference(t.index, t.texCoord, t.extensions);
  }
  TextureReference emissive_texture() const {
    const tinygltf::TextureInfo& t = material.emissiveTexture;
    return texture_reference(t.index, t.texCoord, t.extensions);
  }
  TextureReference normal_texture() const {
    const tinygltf::NormalTextureInfo& t = material.normalTexture;
    return texture_reference(t.index, t.texCoord, t.extensions);
  }
  TextureReference roughness_texture() const {
    const tinygltf::TextureInfo& t = material.pbrMetallicRoughness.metallicRoughnessTexture;
    return texture_reference(t.index, t.texCoord, t.extensions);
  }
  vec3 emission() const {
    const tinygltf::Value* const strength = extension("KHR_materials_emissive_strength");
    const double factor = strength ? number(*strength, "emissiveStrength", 1.0) : 1.0;
    return glm::max(vec3(0.f),
                    static_cast<float>(factor) * color_of(material.emissiveFactor, vec3(0.f)));
  }
};

void Materials::leave_out(const Source& s, const std::string& what) {
  left_out_[what].insert(s.index);
}

std::vector<std::string> Materials::notes() const {
  std::vector<std::string> lines;
  for (const auto& [what, materials] : left_out_) {
    std::string list;
    for (const int m : materials) {
      if (list.size() > 60) {
        list += ", ...";
        break;
      }
      list += (list.empty() ? "" : ", ") + element("materials", m);
    }
    lines.push_back(what + " (" + list + ")");
  }
  return lines;
}

// Meshes carry two sets. Points that area lights draw know the first alone, so that emission comes
// first; what needs a third one uses the first.
void Materials::choose_sets(Source& s) const {
  std::vector<int> sets;
  const auto want = [&](const TextureReference& t) {
    if (t && std::ranges::find(sets, t.set) == sets.end()) sets.push_back(t.set);
  };
  want(s.emissive_texture());
  want(s.base_texture());
  want(s.roughness_texture());
  want(s.normal_texture());
  const std::pair<const char*, const char*> others[] = {
      {"KHR_materials_specular", "specularTexture"},
      {"KHR_materials_specular", "specularColorTexture"},
      {"KHR_materials_transmission", "transmissionTexture"},
      {"KHR_materials_clearcoat", "clearcoatTexture"},
      {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
      {"KHR_materials_sheen", "sheenColorTexture"},
      {"KHR_materials_sheen", "sheenRoughnessTexture"},
      {"KHR_materials_anisotropy", "anisotropyTexture"}};
  for (const auto& [name, texture] : others)
    if (const tinygltf::Value* const v = s.extension(name)) want(texture_reference(*v, texture));
  // Without textures coordinates still give tangents.
  s.context.sets = {sets.empty() ? 0 : sets[0], sets.size() < 2 ? -1 : sets[1]};
}

void Materials::opacity(Source& s, ShapeSurface& out) {
  const tinygltf::Material& m = s.material;
  if (m.alphaMode != "MASK" && m.alphaMode != "BLEND") return;
  const std::vector<double>& factor = m.pbrMetallicRoughness.baseColorFactor;
  FloatValue alpha = textures_.channel(s.context, "alpha", s.base_texture(), "a",
                                       factor.size() == 4 ? factor[3] : 1.0);
  if (s.vertex_colors) alpha = textures_.by_vertex_opacity(s.context, "alpha", alpha);
  if (m.alphaMode == "MASK") alpha = textures_.threshold(s.context, "alpha", alpha, m.alphaCutoff);
  if (!alpha.texture.empty() || alpha.constant < 1.0) out.alpha = alpha;
}

void Materials::emission(Source& s, ShapeSurface& out) {
  const vec3 factor = s.emission();
  if (factor == vec3(0.f)) return;
  // The strength apart, so that colours stay colours.
  const float strength = std::max(1.f, std::max(factor.x, std::max(factor.y, factor.z)));
  ParameterWriter light(s.context.where);
  write(light, "L",
        textures_.color(s.context, "emission", s.emissive_texture(), factor / strength, true));
  light.number("scale", static_cast<double>(strength)).flag("twosided", s.material.doubleSided);
  out.emission = light.take();
}

// As path tracers do it: the surface emits its colour and reflects nothing.
void Materials::unlit(Source& s, ShapeSurface& out) {
  const vec3 factor = color_of(s.material.pbrMetallicRoughness.baseColorFactor, vec3(1.f));
  ParameterWriter light(s.context.where);
  write(light, "L", textures_.color(s.context, "basecolor", s.base_texture(), factor, true));
  light.flag("twosided", true);
  out.emission = light.take();
  ParameterWriter material(s.context.where);
  material.text("type", "diffuse").rgb("reflectance", vec3(0.f));
  target_.state.named_material(s.context.name, material.take(), s.context.where);
  leave_out(s, "unlit materials emit their colour and light the scene");
  if (s.vertex_colors) leave_out(s, "colours of vertices of unlit materials are left out");
}

void Materials::base(Source& s, ParameterWriter& out) {
  const tinygltf::PbrMetallicRoughness& pbr = s.material.pbrMetallicRoughness;
  ColorValue color = textures_.color(s.context, "basecolor", s.base_texture(),
                                     color_of(pbr.baseColorFactor, vec3(1.f)), true);
  if (s.vertex_colors) color = textures_.by_vertex_color(s.context, "basecolor", color);
  write(out, "basecolor", color);
  const TextureReference texture = s.roughness_texture();
  write(out, "metallic",
        textures_.channel(s.context, "metallic", texture, "b", pbr.metallicFactor));
  write(out, "roughness",
        textures_.channel(s.context, "roughness", texture, "g", pbr.roughnessFactor));
  if (const TextureReference normals = s.normal_texture()) {
    write(out, "normals", textures_.color(s.context, "normals", normals, vec3(1.f), false));
    out.number("normalscale", s.material.normalTexture.scale);
  }
}

void Materials::specular(Source& s, ParameterWriter& out) {
  if (const auto* const v = s.extension("KHR_materials_ior"))
    out.number("ior", number(*v, "ior", 1.5));
  const auto* const v = s.extension("KHR_materials_specular");
  if (!v) return;
  write(out, "specular",
        textures_.channel(s.context, "specular", texture_reference(*v, "specularTexture"), "a",
                          number(*v, "specularFactor", 1.0)));
  write(out, "specularcolor",
        textures_.color(s.context, "specularcolor", texture_reference(*v, "specularColorTexture"),
                        color_of(numbers(*v, "specularColorFactor"), vec3(1.f)), true));
}

void Materials::body(Source& s, ParameterWriter& out, ShapeSurface& surface) {
  const auto* const transmission = s.extension("KHR_materials_transmission");
  if (transmission)
    write(out, "transmission",
          textures_.channel(s.context, "transmission",
                            texture_reference(*transmission, "transmissionTexture"), "r",
                            number(*transmission, "transmissionFactor", 0.0)));
  const auto* const volume = s.extension("KHR_materials_volume");
  if (volume && transmission) {
    const double thickness = number(*volume, "thicknessFactor", 0.0);
    out.number("thickness", thickness);
    if (thickness > 0.0) absorb(s, *volume, surface);
  }
  if (const auto* const v = s.extension("KHR_materials_dispersion"))
    out.number("dispersion", number(*v, "dispersion", 0.0));
}

// What is left of white light after attenuationDistance is attenuationColor.
void Materials::absorb(Source& s, const tinygltf::Value& volume, ShapeSurface& surface) {
  const double distance = number(volume, "attenuationDistance", 0.0);
  const vec3 color = color_of(numbers(volume, "attenuationColor"), vec3(1.f));
  if (!(distance > 0.0) || color == vec3(1.f)) return;
  if (!has_media()) return leave_out(s, "absorption inside bodies is left out: there are no media");
  vec3 absorption;
  for (int c = 0; c < 3; ++c)
    absorption[c] = static_cast<float>(
        -std::log(std::clamp(static_cast<double>(color[c]), 1e-6, 1.0)) / distance);
  ParameterWriter out(s.context.where);
  out.text("type", medium_type).rgb("sigma_a", absorption).rgb("sigma_s", vec3(0.f));
  surface.medium = s.context.name;
  target_.state.named_medium(surface.medium, out.take(), s.context.where);
}

void Materials::coat(Source& s, ParameterWriter& out) {
  const auto* const v = s.extension("KHR_materials_clearcoat");
  if (!v) return;
  const double factor = number(*v, "clearcoatFactor", 0.0);
  write(out, "clearcoat",
        textures_.channel(s.context, "clearcoat", texture_reference(*v, "clearcoatTexture"), "r",
                          factor));
  write(out, "clearcoatroughness",
        textures_.channel(s.context, "clearcoatroughness",
                          texture_reference(*v, "clearcoatRoughnessTexture"), "g",
                          number(*v, "clearcoatRoughnessFactor", 0.0)));
  if (texture_reference(*v, "clearcoatNormalTexture"))
    leave_out(s, "clearcoatNormalTexture is left out: the coat has the base's normals");
}

void Materials::sheen(Source& s, ParameterWriter& out) {
  const auto* const v = s.extension("KHR_materials_sheen");
  if (!v) return;
  write(out, "sheencolor",
        textures_.color(s.context, "sheencolor", texture_reference(*v, "sheenColorTexture"),
                        color_of(numbers(*v, "sheenColorFactor"), vec3(0.f)), true));
  write(
      out, "sheenroughness",
      textures_.channel(s.context, "sheenroughness", texture_reference(*v, "sheenRoughnessTexture"),
                        "a", number(*v, "sheenRoughnessFactor", 0.0)));
}

void Materials::anisotropy(Source& s, ParameterWriter& out) {
  const auto* const v = s.extension("KHR_materials_anisotropy");
  if (!v) return;
  out.number("anisotropy", number(*v, "anisotropyStrength", 0.0));
  out.number("anisotropyrotation",
             number(*v, "anisotropyRotation", 0.0) * 180.0 / std::numbers::pi);
  if (const TextureReference map = texture_reference(*v, "anisotropyTexture"))
    write(out, "anisotropymap", textures_.color(s.context, "anisotropymap", map, vec3(1.f), false));
}

void Materials::principled(Source& s, ShapeSurface& surface) {
  ParameterWriter out(s.context.where);
  out.text("type", "principled");
  base(s, out);
  specular(s, out);
  body(s, out, surface);
  coat(s, out);
  sheen(s, out);
  anisotropy(s, out);
  emission(s, surface);
  target_.state.named_material(s.context.name, out.take(), s.context.where);
}

const ShapeSurface& Materials::get(int index, bool vertex_colors, const std::string& pointer) {
  static const tinygltf::Material plain;
  const std::pair key(index, vertex_colors);
  if (const auto known = made_.find(key); known != made_.end()) return known->second;
  const tinygltf::Material& material =
      index < 0 ? plain : document_.get(document_.model().materials, index, "materials", pointer);
  const std::string here = index < 0 ? "the default material" : element("materials", index);
  Source s{material, index, vertex_colors, {}};
  s.context.where = document_.at(here);
  s.context.pointer = here;
  s.context.name = document_.label() + ": " + here + (vertex_colors ? " with vertex colours" : "");
  choose_sets(s);
  ShapeSurface out;
  out.material = s.context.name;
  out.needs = {
      s.context.sets, vertex_colors,
      static_cast<bool>(s.normal_texture()) || s.extension("KHR_materials_anisotropy") != nullptr};
  opacity(s, out);
  if (s.extension("KHR_materials_unlit"))
    unlit(s, out);
  else
    principled(s, out);
  if (s.extension("KHR_materials_pbrSpecularGlossiness"))
    leave_out(s, "KHR_materials_pbrSpecularGlossiness is left out: metallic-roughness is used");
  return made_[key] = std::move(out);
}

}  // namespace pssmlt::gltf
