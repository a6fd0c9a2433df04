// What a scene file asks for, as plain data: nothing is loaded, no plugin is named, every name is
// resolved to an index where the file must have declared it. The builder turns it into a Scene;
// whoever overrides something from the command line edits it in between.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/transform.h"
#include "core/image/embedded_file.h"
#include "core/scene/parameters.h"

namespace pssmlt {

// One transformation directive as written, after those `before` it.
struct TransformStep {
  std::string text;  // "Translate 1 2 3": what gives the same matrices again
  std::array<bool, 2> active{true, true};
  mutable std::shared_ptr<const TransformStep> before;
  TransformStep(std::string t, std::array<bool, 2> a, std::shared_ptr<const TransformStep> b)
      : text(std::move(t)), active(a), before(std::move(b)) {}
  TransformStep(const TransformStep&) = delete;
  TransformStep& operator=(const TransformStep&) = delete;
  ~TransformStep();  // of long chains without recursion
};

// Transformations at the two ends of the shutter interval (pbrt's ActiveTransform).
struct TransformPair {
  Transform start;
  std::shared_ptr<const Transform> end;  // null: the same as start, that is, not animated
  std::shared_ptr<const TransformStep> steps = nullptr;  // the last; null: none or not asked for
  bool animated() const { return end != nullptr; }
};

// One directive as written: the plugin it names, its parameters (those of Attribute merged in) and,
// for what has a place (camera, texture, medium, light, shape), the current transformation, which
// maps the directive's space to the world. Its matrices are invertible.
struct Directive {
  std::string type;  // plugin name; "" if the scene does not give the directive
  ParameterSet parameters;
  Location where;
  TransformPair transform;
  bool given() const { return where.line != 0 || !type.empty(); }
};

struct CameraDescription : Directive {     // its transform is camera from world
  float start_time = 0.f, end_time = 1.f;  // when transform.start and .end hold (TransformTimes)
  std::string medium;                      // the medium around the camera, "" is vacuum
};

// Sampler x integrator: the image is the sum of the scene's layers.
struct LayerDescription {
  std::string name;         // "" for the implicit layer of a scene without LayerBegin
  ParameterSet parameters;  // of LayerBegin
  Directive sampler, integrator;
  Location where;
};

enum class TextureValue { Float, Spectrum };

struct TextureDescription : Directive {  // type is the texture class: "imagemap", ...
  std::string name;
  TextureValue value = TextureValue::Float;
};

struct MaterialDescription : Directive {
  std::string name;  // "" if inline (Material)
};

struct MediumDescription : Directive {
  std::string name;
};

struct LightDescription : Directive {
  std::string medium;  // around the light (the outside of MediumInterface), "" is vacuum
};

struct ShapeDescription : Directive {
  bool reverse_orientation = false;
  uint32_t material = 0;                      // into SceneDescription::materials
  int area_light = -1;                        // into SceneDescription::area_lights, -1: none
  std::string inside_medium, outside_medium;  // "" is vacuum; declared in SceneDescription::media
};

struct InstanceDescription {
  uint32_t object = 0;      // into SceneDescription::objects
  TransformPair transform;  // applied after what the object holds has been placed in it
  Location where;
};

struct ObjectDescription {  // ObjectBegin ... ObjectEnd; transforms inside are as if in the world
  std::string name;
  Location where;
  std::vector<ShapeDescription> shapes;
  std::vector<InstanceDescription> instances;  // of other objects; none contains itself
};

struct SceneDescription {
  std::string file;                     // the first file, as it was named; for text its given name
  std::string directory;                // of the first file: relative names in the scene start here
  std::vector<std::string> files_read;  // with everything included
  std::array<uint64_t, 2> hash{};       // of the (decompressed) text of all files, in reading order

  Directive film, filter, accelerator;
  CameraDescription camera;
  std::vector<LayerDescription> layers;  // at least one after parsing
  ParameterSet options;                  // Option: one value each
  std::string color_space = "srgb";      // in force at Film

  std::map<std::string, TransformPair, std::less<>> coordinate_systems;
  std::vector<TextureDescription> textures;    // in order of declaration: uses follow declarations
  std::vector<MaterialDescription> materials;  // [0] is the default: no type, no parameters
  std::vector<MediumDescription> media;
  std::vector<LightDescription> lights;
  std::vector<Directive> area_lights;  // one per AreaLightSource, shared by its shapes
  std::vector<ShapeDescription> shapes;
  std::vector<ObjectDescription> objects;
  std::vector<InstanceDescription> instances;
  // Images inside the files that were read; parameters name them as files.
  std::vector<std::shared_ptr<const EmbeddedFile>> embedded;
};

// Mixes text into a 128-bit state. Not cryptographic: it tells a checkpoint that the scene changed.
// The result depends on how the text is cut into calls.
void hash_text(std::array<uint64_t, 2>& state, std::string_view text);

}  // namespace pssmlt
