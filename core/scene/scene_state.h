// What the directives of a scene file mean: pbrt-v4's graphics state and the description it fills.
// Knows nothing of tokens; the parser calls one method a directive.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/scene/description.h"
#include "core/scene/dialect.h"

namespace pssmlt {

enum class Block : uint8_t { Options, World };

class SceneState {
 public:
  // Throws an Error at the place; the parser provides one that can quote text in memory.
  using Fail = std::function<void(const Location&, const std::string&)>;
  SceneState(SceneDescription& scene, Fail fail, std::vector<std::string>* log);

  Block block() const { return block_; }
  bool in_layer() const { return in_layer_; }
  bool in_object() const { return in_object_; }
  const std::string& outside_medium() const { return now_.outside_medium; }
  const std::shared_ptr<const std::string>& color_space() const { return now_.color_space; }

  // Directives with a plugin's name and parameters.
  void accelerator(std::string type, ParameterSet parameters, const Location& where);
  void area_light(std::string type, ParameterSet parameters, const Location& where);
  void attribute(std::string target, ParameterSet parameters, const Location& where);
  void camera(std::string type, ParameterSet parameters, const Location& where);
  void film(std::string type, ParameterSet parameters, const Location& where);
  void filter(std::string type, ParameterSet parameters, const Location& where);
  void integrator(std::string type, ParameterSet parameters, const Location& where);
  void layer_begin(std::string name, ParameterSet parameters, const Location& where);
  void light(std::string type, ParameterSet parameters, const Location& where);
  void material(std::string type, ParameterSet parameters, const Location& where);
  void named_material(std::string name, ParameterSet parameters, const Location& where);
  void named_medium(std::string name, ParameterSet parameters, const Location& where);
  void sampler(std::string type, ParameterSet parameters, const Location& where);
  void shape(std::string type, ParameterSet parameters, const Location& where);
  void texture(std::string name, const std::string& value, std::string type,
               ParameterSet parameters, const Location& where);
  void option(Parameter option);

  // Directives that change the graphics state.
  void set_color_space(const std::string& name, const Location& where);
  void use_material(const std::string& name, const Location& where);
  void medium_interface(std::string inside, std::string outside, const Location& where);
  void reverse_orientation() { now_.reverse_orientation = !now_.reverse_orientation; }
  void layer_end(const Location& where);
  void world_begin(const Location& where);

  // Nesting. kind: what opened the state and must close it.
  enum class Nested : uint8_t { Attribute, Transform, Object };
  void push(Nested kind, const Location& where);
  void pop(Nested kind, const Location& where);
  void object_begin(const std::string& name, const Location& where);
  void object_end(const Location& where);
  void object_instance(const std::string& name, const Location& where);

  // Transformations: the active ones are multiplied from the right, or replaced. Exporters write
  // singular matrices over empty groups, so that one is an error (at the matrix) only when
  // something is placed with it.
  void concatenate(const Transform& t, const Location& where);
  void concatenate(const dmat4& m, const Location& where);
  void replace(const dmat4& m, const Location& where);
  void define_coordinates(const std::string& name, const Location& where);
  void use_coordinates(const std::string& name, const Location& where);
  void activate(bool start, bool end) { now_.active = {start, end}; }
  void transform_times(float start, float end, const Location& where);
  // Names of textures and materials may be declared again, as older formats have it: uses that
  // follow mean the new one. Each time goes to `again`.
  void allow_redeclaration(std::vector<OldSyntax>* again) { again_ = again; }
  // The name under which a texture that a parameter names is declared.
  const std::string& texture_name(const std::string& name) const;

  // From here on the placed directives keep how they were placed. `text` is the directive that was
  // just applied; it replaces all steps before if it replaces the matrices.
  void keep_steps() { keep_steps_ = true; }
  bool keeps_steps() const { return keep_steps_; }
  void record_step(std::string text, bool replaces);

  // An imported file starts with the current state, must be balanced in itself, and leaves only
  // what it declared.
  class Import;
  // Checks what can be known at the end only: nesting, names used but never declared.
  void finish(const Location& end);

 private:
  struct GraphicsState {
    std::array<Transform, 2> ctm;      // at the start and the end of the shutter interval
    std::array<Location, 2> singular;  // where the ctm became singular; line 0: it is not
    std::array<bool, 2> active{true, true};
    std::shared_ptr<const TransformStep> steps;
    float start_time = 0.f, end_time = 1.f;
    bool reverse_orientation = false;
    uint32_t material = 0;
    int area_light = -1;
    std::string inside_medium, outside_medium;
    std::shared_ptr<const std::string> color_space;
    // What Attribute gave for shape, light, material, medium, texture; shared by nested states.
    std::array<std::shared_ptr<const ParameterSet>, 5> attributes;
  };
  enum Target : size_t { ShapeTarget, LightTarget, MaterialTarget, MediumTarget, TextureTarget };
  struct Pushed {
    Nested kind;
    Location where;
    GraphicsState state;
  };
  struct PendingName {
    std::string name;
    Location where;
  };

  void note(const Location& where, const std::string& message);
  [[noreturn]] void fail(const Location& where, const std::string& message) const;
  [[noreturn]] void fail_unclosed(const Pushed& open) const;
  void check_new(const std::map<std::string, Location, std::less<>>& known, const char* kind,
                 const std::string& name, const Location& where) const;
  // The current transformation for what stands at `where`. Throws if it is singular.
  TransformPair placement(const Location& where) const;
  Directive placed(std::string type, ParameterSet parameters, const Location& where) const;
  void set_singular(size_t i, const Location& where);
  std::string redeclare_texture(const std::string& name, bool is_float, const Location& where);
  ParameterSet with_attributes(ParameterSet parameters, Target target) const;
  std::string take_type(ParameterSet& parameters, const char* kind, const std::string& name,
                        const Location& where) const;
  void remember_medium(const std::string& name, const Location& where);
  void check_media() const;
  void resolve_materials();
  void resolve_instances();
  void check_nesting() const;

  SceneDescription& scene_;
  Fail fail_;
  std::vector<std::string>* log_;
  Block block_ = Block::Options;
  GraphicsState now_;
  std::vector<Pushed> pushed_;
  size_t import_base_ = 0;  // states below belong to the importing file
  bool in_object_ = false, in_layer_ = false, noted_transform_begin_ = false;
  bool keep_steps_ = false;
  std::vector<OldSyntax>* again_ = nullptr;  // null: declaring a name again is an error
  std::map<std::string, std::string, std::less<>> texture_names_;  // declared again: the last
  Directive sampler_, integrator_;                                 // outside layers

  // Where each name was declared.
  std::map<std::string, Location, std::less<>> float_textures_, spectrum_textures_, media_, layers_;
  std::map<std::string, uint32_t, std::less<>> materials_, objects_;
  // Names may be used before they are declared: shapes then hold pending_bit | index of the name.
  std::vector<PendingName> pending_materials_;
  std::map<std::string, uint32_t, std::less<>> pending_index_;
  // Names of the instances in the order of the file, and what each stands in: the world, or the
  // object of this index.
  struct PendingInstance : PendingName {
    int inside = -1;
  };
  std::vector<PendingInstance> instance_names_;
  std::map<std::string, Location, std::less<>> media_used_;
};

class SceneState::Import {
 public:
  explicit Import(SceneState& state);
  // Call at the end of the imported text.
  void finish();

 private:
  SceneState& state_;
  GraphicsState saved_;
  std::map<std::string, TransformPair, std::less<>> coordinates_;
  size_t base_;
};

}  // namespace pssmlt
