// What a plugin's last line needs: PSSMLT_PLUGIN(Kind, "name", Class, aliases...).
#pragma once

#include <memory>

#include "core/scene/parameters.h"

namespace pssmlt {

// Raised by hand whenever a header that plugins include changes its layout or meaning.
inline constexpr int abi_version = 13;

class Integrator;
class Sampler;
class Shape;
class Light;
class Camera;
class Material;
class Medium;
class Filter;
struct RasterFrame;

// Kinds that have no class of their own name.
struct AreaLight {};  // lights that shapes carry (AreaLightSource)
struct TextureKind {};

// Another name that a scene may use. If `sampler` is not empty, the alias stands for this plugin
// under that sampler, which gets the parameters that the plugin does not know.
struct PluginAlias {
  const char* name = nullptr;
  const char* sampler = "";
};

// What the constructor gets besides its parameters.
struct PluginArguments {
  const RasterFrame* frame = nullptr;           // cameras
  std::shared_ptr<const Shape> shape;           // area lights
  std::shared_ptr<const Texture<float>> alpha;  // area lights: cut-outs of their shape
};

struct PluginDescriptor {
  int abi = abi_version;
  const char* compiler = __VERSION__;
  const char* kind = nullptr;
  const char* name = nullptr;
  const char* summary = nullptr;  // one line, from Class::summary
  const PluginAlias* aliases = nullptr;
  int alias_count = 0;
  // Returns an owning pointer to the kind's base class; throws Error. Textures: the second makes
  // Texture<Rgb>, the first Texture<float>; one of the two is null if the texture has no such form.
  void* (*create)(Parameters&, const PluginArguments&) = nullptr;
  void* (*create_rgb)(Parameters&, const PluginArguments&) = nullptr;
};

// How each kind is constructed and which base pointer the registry gets.
template <typename Kind>
struct PluginKind {
  template <typename C>
  static void* create(Parameters& p, const PluginArguments&) {
    return static_cast<Kind*>(new C(p));
  }
};
template <>
struct PluginKind<Camera> {
  template <typename C>
  static void* create(Parameters& p, const PluginArguments& a) {
    return static_cast<Camera*>(new C(p, *a.frame));
  }
};
template <>
struct PluginKind<AreaLight> {
  template <typename C>
  static void* create(Parameters& p, const PluginArguments& a) {
    return static_cast<Light*>(new C(p, a));
  }
};
template <typename C, typename T>
void* create_texture(Parameters& p, const PluginArguments&) {
  return static_cast<Texture<T>*>(new C(p));
}

}  // namespace pssmlt

#define PSSMLT_EXPORT extern "C" __attribute__((visibility("default")))

// Registers a plugin; the file's last line. Class needs `static constexpr const char* summary`.
#define PSSMLT_PLUGIN(Kind, plugin_name, Class, ...)                                  \
  static const ::pssmlt::PluginAlias pssmlt_aliases[] = {{nullptr, ""}, __VA_ARGS__}; \
  PSSMLT_EXPORT const ::pssmlt::PluginDescriptor pssmlt_plugin_descriptor;            \
  const ::pssmlt::PluginDescriptor pssmlt_plugin_descriptor = {                       \
      ::pssmlt::abi_version,                                                          \
      __VERSION__,                                                                    \
      #Kind,                                                                          \
      plugin_name,                                                                    \
      Class::summary,                                                                 \
      pssmlt_aliases + 1,                                                             \
      static_cast<int>(sizeof(pssmlt_aliases) / sizeof(pssmlt_aliases[0])) - 1,       \
      &::pssmlt::PluginKind<::pssmlt::Kind>::create<Class>,                           \
      nullptr};

#define PSSMLT_TEXTURE_DESCRIPTOR(plugin_name, text, create_float, create_colour)    \
  PSSMLT_EXPORT const ::pssmlt::PluginDescriptor pssmlt_plugin_descriptor;           \
  const ::pssmlt::PluginDescriptor pssmlt_plugin_descriptor = {                      \
      ::pssmlt::abi_version, __VERSION__,  "Texture", plugin_name, text, nullptr, 0, \
      create_float,          create_colour};

// Registers a texture that exists for float and for Rgb: Class is a template over the value.
#define PSSMLT_TEXTURE_PLUGIN(plugin_name, Class)                             \
  PSSMLT_TEXTURE_DESCRIPTOR(plugin_name, Class<float>::summary,               \
                            (&::pssmlt::create_texture<Class<float>, float>), \
                            (&::pssmlt::create_texture<Class<::pssmlt::Rgb>, ::pssmlt::Rgb>))
// Registers a texture of float alone and one of Rgb alone: Class is no template.
#define PSSMLT_FLOAT_TEXTURE_PLUGIN(plugin_name, Class)  \
  PSSMLT_TEXTURE_DESCRIPTOR(plugin_name, Class::summary, \
                            (&::pssmlt::create_texture<Class, float>), nullptr)
#define PSSMLT_SPECTRUM_TEXTURE_PLUGIN(plugin_name, Class)        \
  PSSMLT_TEXTURE_DESCRIPTOR(plugin_name, Class::summary, nullptr, \
                            (&::pssmlt::create_texture<Class, ::pssmlt::Rgb>))
