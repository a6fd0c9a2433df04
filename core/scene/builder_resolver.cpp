#include "core/scene/builder_resolver.h"

#include <algorithm>
#include <filesystem>

#include "core/plugin/registry.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

const char* form_name(TextureValue value) {
  return value == TextureValue::Float ? "float" : "spectrum";
}

}  // namespace

std::string owner_name(const std::string& kind, const std::string& name) {
  return kind + " \"" + name + "\"";
}

const TextureDescription& BuildResolver::find_texture(const std::string& name, TextureValue value,
                                                      const Location& where) const {
  std::vector<std::string> known;
  for (const TextureDescription& t : scene_.textures) {
    if (t.value != value) continue;
    if (t.name == name) return t;
    known.push_back(t.name);
  }
  const char* const kind = form_name(value);
  for (const TextureDescription& t : scene_.textures) {
    if (t.name == name) {
      throw Error(where, "texture \"" + name + "\" is not a " + kind + " texture");
    }
  }
  throw Error(where, std::string("no ") + kind + " texture is named \"" + name + "\"" +
                         suggestion(name, known));
}

template <typename T>
std::shared_ptr<const Texture<T>> BuildResolver::make_texture(
    const TextureDescription& description) {
  if (!in_progress_.insert(&description).second) {
    throw Error(description.where, "texture \"" + description.name + "\" contains itself");
  }
  const FoundPlugin found =
      Registry::instance().find("texture", description.type, description.where);
  Parameters parameters(description.parameters, description.where,
                        owner_name("texture", description.type), this);
  parameters.set_transform(to_render_ * description.transform.start);
  const auto create =
      std::is_same_v<T, float> ? found.descriptor->create : found.descriptor->create_rgb;
  if (!create) {
    throw Error(description.where, owner_name("texture", description.type) + " is a " +
                                       form_name(std::is_same_v<T, float> ? TextureValue::Spectrum
                                                                          : TextureValue::Float) +
                                       " texture only");
  }
  std::shared_ptr<const Texture<T>> made(static_cast<Texture<T>*>(create(parameters, {})));
  parameters.check_all_read();
  in_progress_.erase(&description);
  return made;
}

std::shared_ptr<const Texture<float>> BuildResolver::float_texture(const std::string& name,
                                                                   const Location& where) {
  const TextureDescription& description = find_texture(name, TextureValue::Float, where);
  auto& slot = float_textures_[&description];
  if (!slot) slot = make_texture<float>(description);
  return slot;
}

std::shared_ptr<const Texture<Rgb>> BuildResolver::rgb_texture(const std::string& name,
                                                               const Location& where) {
  const TextureDescription& description = find_texture(name, TextureValue::Spectrum, where);
  auto& slot = rgb_textures_[&description];
  if (!slot) slot = make_texture<Rgb>(description);
  return slot;
}

std::string BuildResolver::resolve_path(const std::string& name) const {
  const std::filesystem::path path(name);
  if (path.is_absolute() || scene_.directory.empty()) return name;
  return (std::filesystem::path(scene_.directory) / path).string();
}

std::shared_ptr<const Material> BuildResolver::material(const std::string& name,
                                                        const Location& where) {
  std::vector<std::string> known;
  for (uint32_t i = 0; i < scene_.materials.size(); ++i) {
    const std::string& other = scene_.materials[i].name;
    if (!other.empty() && other == name) return material(i);
    if (!other.empty()) known.push_back(other);
  }
  throw Error(where, "no material is named \"" + name + "\"" + suggestion(name, known));
}

std::shared_ptr<const Material> BuildResolver::material(uint32_t index) {
  if (const auto made = materials_.find(index); made != materials_.end()) return made->second;
  const MaterialDescription& description = scene_.materials[index];
  if (!in_progress_.insert(&description).second) {
    throw Error(description.where, "material \"" + description.name + "\" contains itself");
  }
  const std::string& type = description.type.empty() ? default_material_ : description.type;
  const FoundPlugin found = Registry::instance().find("material", type, description.where);
  Parameters parameters(description.parameters, description.where, owner_name("material", type),
                        this);
  parameters.set_transform(to_render_ * description.transform.start);
  std::shared_ptr<const Material> made = make_plugin<Material>(found, parameters);
  in_progress_.erase(&description);
  return materials_[index] = made;
}

std::shared_ptr<const Medium> BuildResolver::medium(const std::string& name,
                                                    const Location& where) {
  const auto found = std::ranges::find(scene_.media, name, &MediumDescription::name);
  // The parser has seen to it that every name used is declared.
  if (found == scene_.media.end()) throw Error(where, "medium \"" + name + "\" is not defined");
  auto& slot = media_[&*found];
  if (slot) return slot;
  if (found->transform.animated()) throw Error(found->where, "media cannot move");
  const FoundPlugin plugin = Registry::instance().find("medium", found->type, found->where);
  Parameters parameters(found->parameters, found->where, owner_name("medium", found->type), this);
  parameters.set_transform(to_render_ * found->transform.start);
  return slot = make_plugin<Medium>(plugin, parameters);
}

std::vector<std::string> BuildResolver::unused() const {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < scene_.materials.size(); ++i) {
    const MaterialDescription& m = scene_.materials[i];
    if (i == 0 || materials_.contains(i)) continue;
    names.push_back(owner_name("material", m.name.empty() ? m.type : m.name));
  }
  for (const TextureDescription& t : scene_.textures) {
    if (float_textures_.contains(&t) || rgb_textures_.contains(&t)) continue;
    names.push_back(owner_name("texture", t.name));
  }
  for (const MediumDescription& m : scene_.media) {
    if (!media_.contains(&m)) names.push_back(owner_name("medium", m.name));
  }
  return names;
}

}  // namespace pssmlt
