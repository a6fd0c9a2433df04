// A scene on its way from pbrt-v3's names to today's, and what has been done to it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/dialect/parameter_edit.h"
#include "core/scene/description.h"

namespace pssmlt::v3 {

struct Translation {
  Translation(SceneDescription& description, bool is_old) : scene(description), old(is_old) {}

  SceneDescription& scene;
  bool old;                               // the scene is in v3's format: its defaults hold
  std::map<uint32_t, Parameter> opacity;  // of materials, by index, for the shapes that have them
  std::set<uint32_t> opacity_used;

  // Counts an object whose name or parameters were old: `kind` in the singular.
  void translated(const std::string& kind, const std::string& name);
  // What has no counterpart and changes the picture; said once each.
  void dropped(const std::string& what) { dropped_.insert(what); }
  // The lines for the log; none if nothing was done.
  std::vector<std::string> report() const;

 private:
  struct Done {
    int count = 0;
    std::set<std::string> names;
  };
  std::map<std::string, Done> done_;
  std::set<std::string> dropped_;
};

// Film, filter, camera, samplers, integrators (options.cpp).
void translate_options(Translation& t);
void translate_textures(Translation& t);
void translate_media(Translation& t);
void translate_lights(Translation& t);
void translate_shapes(Translation& t);
// Also of the materials that are added on the way.
void translate_materials(Translation& t);

// Whether names that only v3 had stand anywhere.
bool has_old_names(const SceneDescription& scene);
bool is_old_material(const std::string& type);

// A texture of colours read as one of numbers, with all that it refers to; its name stays, since
// the two kinds have names of their own.
void make_float_texture(Translation& t, const std::string& name, const Location& where);
// A number in [0, 1] per point from a colour: constant, or the name of a float texture.
Parameter as_share(Translation& t, const Parameter& colour, std::string name);
// The parameter times a factor: a constant, or a new texture.
Parameter scaled(Translation& t, const Parameter& colour, const Rgb& factor, std::string name);

// Materials of several layers or parts (coats.cpp): each changes m, a copy of a description's.
void translate_plastic(Translation& t, MaterialDescription& m);
void translate_substrate(Translation& t, MaterialDescription& m);
void translate_uber(Translation& t, MaterialDescription& m, uint32_t index);
void translate_disney(Translation& t, MaterialDescription& m);
// v3's "roughness", "uroughness", "vroughness" and "remaproughness" as widths of the lobe. The
// fallback holds where neither the general nor the axis' parameter is given; `general`: whether
// the material has "roughness" at all.
void translate_roughness(Translation& t, ParameterSet& set, float fallback, bool general,
                         const Location& where);
// Takes a colour parameter, spectra as rgb; grey if it is not given.
Parameter take_colour(const Translation& t, ParameterSet& set, std::string_view name,
                      float fallback, const Location& where);
// The colour of a reflectance spectrum.
Rgb reflectance_of(const Translation& t, const Parameter& spectrum);
// "eta", or "index" as it was called before.
float take_index(ParameterSet& set, const std::string& owner);

}  // namespace pssmlt::v3
