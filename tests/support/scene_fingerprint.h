// All that a scene description says, as text: equal texts, equal scenes, to the bit.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

#include "core/scene/description.h"

namespace pssmlt::test {

inline std::string fingerprint(const Parameter& p) {
  std::string text = fmt::format(" \"{} {}\"", to_string(p.type), p.name);
  for (const int v : p.ints) text += fmt::format(" {}", v);
  for (const float v : p.floats) text += fmt::format(" {:a}", v);
  for (const std::string& v : p.strings) text += " \"" + v + "\"";
  for (const uint8_t v : p.bools) text += v != 0 ? " true" : " false";
  if (p.type == ParameterType::Rgb) text += " in " + (p.color_space ? *p.color_space : "srgb");
  return text;
}

inline std::string fingerprint(const Transform& t) {
  std::string text = " at";
  for (const dmat4& m : {t.matrix(), t.inverse_matrix()})
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) text += fmt::format(" {:a}", m[c][r] + 0.0);
  return text;
}

inline std::string fingerprint(const TransformPair& t) {
  return fingerprint(t.start) + (t.end ? " to" + fingerprint(*t.end) : "");
}

inline std::string fingerprint(const Directive& d) {
  std::string text = d.type;
  for (const Parameter& p : d.parameters) text += fingerprint(p);
  return text + fingerprint(d.transform) + "\n";
}

inline std::string fingerprint(const SceneDescription& s, const ShapeDescription& shape) {
  std::string text = fingerprint(static_cast<const Directive&>(shape));
  text += fmt::format(" reversed {} in \"{}\" out \"{}\"\n material ", shape.reverse_orientation,
                      shape.inside_medium, shape.outside_medium);
  text += fingerprint(s.materials[shape.material]);
  if (shape.area_light >= 0)
    text += " emits " + fingerprint(s.area_lights[static_cast<size_t>(shape.area_light)]);
  return text;
}

// Names of the materials that have one.
inline std::set<std::string> material_names(const SceneDescription& s) {
  std::set<std::string> names;
  for (const MaterialDescription& m : s.materials)
    if (!m.name.empty()) names.insert(m.name);
  return names;
}

// Of named materials those of `names`: whoever writes a scene may name others.
inline std::string fingerprint(const SceneDescription& s, const std::set<std::string>& names) {
  std::string text = "film " + fingerprint(s.film) + "filter " + fingerprint(s.filter) +
                     "accelerator " + fingerprint(s.accelerator) + "camera " +
                     fingerprint(static_cast<const Directive&>(s.camera));
  text += fmt::format("from {} to {} in \"{}\", pixels {}\n", s.camera.start_time,
                      s.camera.end_time, s.camera.medium, s.color_space);
  for (const LayerDescription& l : s.layers) {
    text += "layer " + l.name + "\n" + fingerprint(l.sampler) + fingerprint(l.integrator);
    for (const Parameter& p : l.parameters) text += fingerprint(p);
  }
  for (const Parameter& p : s.options) text += "option" + fingerprint(p) + "\n";
  for (const TextureDescription& t : s.textures) {
    text += fmt::format("texture {} {} ", t.name, t.value == TextureValue::Float);
    text += fingerprint(static_cast<const Directive&>(t));
  }
  for (const MaterialDescription& m : s.materials)
    if (names.contains(m.name)) text += "material " + m.name + " " + fingerprint(m);
  for (const MediumDescription& m : s.media) text += "medium " + m.name + " " + fingerprint(m);
  for (const LightDescription& l : s.lights)
    text += "light in \"" + l.medium + "\" " + fingerprint(static_cast<const Directive&>(l));
  for (const ShapeDescription& shape : s.shapes) text += "shape " + fingerprint(s, shape);
  for (const ObjectDescription& o : s.objects) {
    text += "object " + o.name + "\n";
    for (const ShapeDescription& shape : o.shapes) text += "shape " + fingerprint(s, shape);
    for (const InstanceDescription& i : o.instances)
      text += "inside: instance of " + s.objects[i.object].name + fingerprint(i.transform) + "\n";
  }
  for (const InstanceDescription& i : s.instances)
    text += "instance of " + s.objects[i.object].name + fingerprint(i.transform) + "\n";
  return text;
}

inline std::string fingerprint(const SceneDescription& s) {
  return fingerprint(s, material_names(s));
}

}  // namespace pssmlt::test
