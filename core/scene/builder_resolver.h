// Makes textures and materials when something in the scene first needs them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/scene/builder.h"

namespace pssmlt {

// Textures and materials are built on demand: what nothing refers to is neither loaded nor checked.
class BuildResolver final : public SceneResolver {
 public:
  // to_render: world to render space, for the textures' transforms; log: where notes go.
  BuildResolver(const SceneDescription& scene, const Transform& to_render,
                const std::string& default_material, std::vector<std::string>& log)
      : scene_(scene), to_render_(to_render), default_material_(default_material), log_(log) {}

  std::shared_ptr<const Texture<float>> float_texture(const std::string& name,
                                                      const Location& where) override;
  std::shared_ptr<const Texture<Rgb>> rgb_texture(const std::string& name,
                                                  const Location& where) override;
  std::string resolve_path(const std::string& name) const override;
  std::shared_ptr<const Material> material(const std::string& name, const Location& where) override;
  void note(const std::string& line) override { log_.push_back(line); }
  // Medium by name; throws Error at `where`.
  std::shared_ptr<const Medium> medium(const std::string& name, const Location& where);
  // By index into the description's materials.
  std::shared_ptr<const Material> material(uint32_t index);
  // Declared things that nothing used so far.
  std::vector<std::string> unused() const;
  bool any_textures() const { return !float_textures_.empty() || !rgb_textures_.empty(); }

 private:
  const TextureDescription& find_texture(const std::string& name, TextureValue value,
                                         const Location& where) const;
  template <typename T>
  std::shared_ptr<const Texture<T>> make_texture(const TextureDescription& description);

  const SceneDescription& scene_;
  Transform to_render_;
  std::string default_material_;
  std::vector<std::string>& log_;
  std::map<const TextureDescription*, std::shared_ptr<const Texture<float>>> float_textures_;
  std::map<const TextureDescription*, std::shared_ptr<const Texture<Rgb>>> rgb_textures_;
  std::map<uint32_t, std::shared_ptr<const Material>> materials_;
  std::map<const MediumDescription*, std::shared_ptr<const Medium>> media_;
  std::set<const void*> in_progress_;  // to report materials and textures that contain themselves
};

// `kind "name"`, as messages call a directive.
std::string owner_name(const std::string& kind, const std::string& name);

}  // namespace pssmlt
