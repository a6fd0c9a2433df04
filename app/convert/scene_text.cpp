#include "app/convert/scene_text.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "app/convert/directive_text.h"
#include "app/convert/file_names.h"

namespace pssmlt {
namespace {

class SceneWriter {
 public:
  SceneWriter(const SceneDescription& scene, const std::filesystem::path& folder)
      : scene_(scene), files_(scene.directory, folder) {}

  std::string write();

 private:
  void options();
  void camera();
  void layers();
  void world();
  void instances(const std::vector<InstanceDescription>& all);
  void textures();
  void media();
  void name_shared_materials();
  void named_materials();
  void lights();
  void shapes(const std::vector<ShapeDescription>& all);
  void block(const std::vector<ShapeDescription>& all, size_t begin, size_t end);
  void surface(const ShapeDescription& shape);
  void plain(const std::string& word, const std::string& kind, const Directive& d);
  // In a block of its own if it has a place or a medium around it.
  void placed(const std::string& head, const std::string& kind, const Directive& d,
              const ParameterSet& first, const std::string& medium);
  static ParameterSet typed(const Directive& d);

  const SceneDescription& scene_;
  FileNames files_;
  DirectiveText out_;
  std::map<uint32_t, std::string> names_;  // of materials that several blocks use
};

// True if the shapes need the same graphics state.
bool same_state(const ShapeDescription& a, const ShapeDescription& b) {
  return a.transform.steps == b.transform.steps && a.reverse_orientation == b.reverse_orientation &&
         a.material == b.material && a.area_light == b.area_light &&
         a.inside_medium == b.inside_medium && a.outside_medium == b.outside_medium;
}

size_t end_of_block(const std::vector<ShapeDescription>& all, size_t begin) {
  size_t end = begin + 1;
  while (end < all.size() && same_state(all[begin], all[end])) ++end;
  return end;
}

ParameterSet SceneWriter::typed(const Directive& d) {
  Parameter type;
  type.type = ParameterType::String;
  type.name = "type";
  type.strings = {d.type};
  return {type};
}

void SceneWriter::plain(const std::string& word, const std::string& kind, const Directive& d) {
  if (d.type.empty()) return;
  out_.directive(word + " " + in_quotes(d.type), files_.moved(kind, d), d.where);
}

void SceneWriter::placed(const std::string& head, const std::string& kind, const Directive& d,
                         const ParameterSet& first, const std::string& medium) {
  const bool own_block = d.transform.steps != nullptr || !medium.empty();
  if (own_block) out_.begin("AttributeBegin");
  out_.steps(d.transform.steps);
  if (!medium.empty()) out_.line("MediumInterface \"\" " + in_quotes(medium));
  ParameterSet parameters = first;
  for (Parameter& p : files_.moved(kind, d)) parameters.push_back(std::move(p));
  out_.directive(head, parameters, d.where);
  if (own_block) out_.end("AttributeEnd");
}

void SceneWriter::options() {
  for (const Parameter& p : scene_.options) out_.line("Option " + parameter_text(p, 4));
  out_.color_space(scene_.color_space);
  // The film's file is written, not read: its name is no reference.
  if (!scene_.film.type.empty())
    out_.directive("Film " + in_quotes(scene_.film.type), scene_.film.parameters,
                   scene_.film.where);
  plain("PixelFilter", "filter", scene_.filter);
  plain("Accelerator", "accelerator", scene_.accelerator);
  layers();
  camera();
}

void SceneWriter::camera() {
  const CameraDescription& c = scene_.camera;
  if (!c.given()) return;
  if (c.start_time != 0.f || c.end_time != 1.f)
    out_.line(fmt::format("TransformTimes {} {}", c.start_time, c.end_time));
  out_.steps(c.transform.steps);
  if (!c.medium.empty()) out_.line("MediumInterface \"\" " + in_quotes(c.medium));
  plain("Camera", "camera", c);
}

void SceneWriter::layers() {
  for (const LayerDescription& layer : scene_.layers) {
    const bool named = !layer.name.empty();
    if (named) {
      out_.directive("LayerBegin " + in_quotes(layer.name), layer.parameters, layer.where);
    }
    plain("Sampler", "sampler", layer.sampler);
    plain("Integrator", "integrator", layer.integrator);
    if (named) out_.line("LayerEnd");
  }
}

void SceneWriter::textures() {
  for (const TextureDescription& t : scene_.textures) {
    const char* const value = t.value == TextureValue::Float ? "float" : "spectrum";
    placed("Texture " + in_quotes(t.name) + " " + in_quotes(value) + " " + in_quotes(t.type),
           "texture", t, {}, "");
  }
}

void SceneWriter::media() {
  for (const MediumDescription& m : scene_.media)
    placed("MakeNamedMedium " + in_quotes(m.name), "medium", m, typed(m), "");
}

// Inline materials that shapes of several blocks have get names.
void SceneWriter::name_shared_materials() {
  std::map<uint32_t, int> blocks;
  const auto count = [&blocks](const std::vector<ShapeDescription>& all) {
    for (size_t i = 0; i < all.size(); i = end_of_block(all, i)) ++blocks[all[i].material];
  };
  count(scene_.shapes);
  for (const ObjectDescription& object : scene_.objects) count(object.shapes);
  std::set<std::string> taken;
  for (const MaterialDescription& m : scene_.materials) taken.insert(m.name);
  for (const auto& [index, uses] : blocks) {
    const MaterialDescription& m = scene_.materials[index];
    if (index == 0 || !m.name.empty() || uses < 2) continue;
    std::string name = fmt::format("{} {}", m.type, index);
    while (!taken.insert(name).second) name += "'";
    names_[index] = name;
  }
}

void SceneWriter::named_materials() {
  for (uint32_t i = 1; i < scene_.materials.size(); ++i) {
    const MaterialDescription& m = scene_.materials[i];
    const auto given = names_.find(i);
    if (m.name.empty() && given == names_.end()) continue;
    const std::string& name = m.name.empty() ? given->second : m.name;
    placed("MakeNamedMaterial " + in_quotes(name), "material", m, typed(m), "");
  }
}

void SceneWriter::lights() {
  for (const LightDescription& light : scene_.lights)
    placed("LightSource " + in_quotes(light.type), "light", light, {}, light.medium);
}

// The state of a block of shapes.
void SceneWriter::surface(const ShapeDescription& shape) {
  out_.steps(shape.transform.steps);
  if (shape.reverse_orientation) out_.line("ReverseOrientation");
  if (!shape.inside_medium.empty() || !shape.outside_medium.empty()) {
    out_.line("MediumInterface " + in_quotes(shape.inside_medium) + " " +
              in_quotes(shape.outside_medium));
  }
  const MaterialDescription& material = scene_.materials[shape.material];
  const auto given = names_.find(shape.material);
  if (!material.name.empty() || given != names_.end()) {
    const std::string& name = material.name.empty() ? given->second : material.name;
    out_.line("NamedMaterial " + in_quotes(name));
  } else if (shape.material != 0) {
    plain("Material", "material", material);
  }
  if (shape.area_light >= 0) {
    plain("AreaLightSource", "arealight",
          scene_.area_lights[static_cast<size_t>(shape.area_light)]);
  }
}

void SceneWriter::block(const std::vector<ShapeDescription>& all, size_t begin, size_t end) {
  const ShapeDescription& first = all[begin];
  const bool bare = first.transform.steps == nullptr && !first.reverse_orientation &&
                    first.material == 0 && first.area_light < 0 && first.inside_medium.empty() &&
                    first.outside_medium.empty();
  if (!bare) out_.begin("AttributeBegin");
  surface(first);
  for (size_t i = begin; i < end; ++i) plain("Shape", "shape", all[i]);
  if (!bare) out_.end("AttributeEnd");
}

void SceneWriter::shapes(const std::vector<ShapeDescription>& all) {
  for (size_t i = 0; i < all.size(); i = end_of_block(all, i)) block(all, i, end_of_block(all, i));
}

void SceneWriter::world() {
  out_.blank();
  out_.line("WorldBegin");
  // What surrounds the camera surrounds nothing else by that.
  if (!scene_.camera.medium.empty()) out_.line("MediumInterface \"\" \"\"");
  media();
  textures();
  name_shared_materials();
  named_materials();
  lights();
  shapes(scene_.shapes);
  for (const ObjectDescription& object : scene_.objects) {
    out_.begin("ObjectBegin " + in_quotes(object.name));
    shapes(object.shapes);
    instances(object.instances);
    out_.end("ObjectEnd");
  }
  instances(scene_.instances);
}

void SceneWriter::instances(const std::vector<InstanceDescription>& all) {
  for (const InstanceDescription& instance : all) {
    out_.begin("AttributeBegin");
    out_.steps(instance.transform.steps);
    out_.line("ObjectInstance " + in_quotes(scene_.objects[instance.object].name));
    out_.end("AttributeEnd");
  }
}

std::string SceneWriter::write() {
  out_.line("# " + std::filesystem::path(scene_.file).filename().string() +
            ", written by pssmlt convert.");
  options();
  world();
  return out_.text();
}

}  // namespace

std::string scene_text(const SceneDescription& scene, const std::filesystem::path& folder) {
  return SceneWriter(scene, folder).write();
}

}  // namespace pssmlt
