// The parser itself: one method for each directive that is not just a plugin with parameters.
// Internal to core/scene/parser*.cpp.
#pragma once

#include <array>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scene/dialect.h"
#include "core/scene/parameter_list.h"
#include "core/scene/scene_state.h"
#include "core/scene/tokenizer.h"

namespace pssmlt {

// The block of a scene that a directive may stand in.
enum class Where : uint8_t { Anywhere, Options, World };

class Parser {
 public:
  Parser(SceneDescription& scene, std::vector<std::string>* log, const ParseOptions& options)
      : scene_(scene),
        state_(
            scene,
            [this](const Location& where, const std::string& message) { fail(where, message); },
            log),
        log_(log),
        dialect_(options.dialect) {
    if (options.keep_steps) state_.keep_steps();
    if (dialect_ != nullptr) state_.allow_redeclaration(&old_);
  }

  // files: whether Include may open any. canonical: the text's own path, "" if it has none.
  void run(std::string_view text, std::shared_ptr<const std::string> name, bool files,
           std::string canonical);

 private:
  struct Rule {
    std::string_view name;
    Where where;
    void (Parser::*special)(const Location&);
    void (SceneState::*plugin)(std::string, ParameterSet, const Location&);
  };
  static const std::array<Rule, 46>& rules();

  struct Source {
    Tokenizer* tokens;
    std::string canonical;
  };

  [[noreturn]] void fail(const Location& where, const std::string& message) const;
  const Rule& find_rule(const Token& token) const;
  void check_block(const Rule& rule, const Location& where) const;
  void directives(Tokenizer& tokens);
  std::string instead_of_none(const Rule& rule, const Location& where);
  Tokenizer& tokens() { return *open_.back().tokens; }
  ParameterSet parameters();
  void old_syntax(const std::string& what, const Location& where, const std::string& advice);
  std::string string_after(std::string_view directive);
  template <size_t N>
  std::array<double, N> numbers(std::string_view directive);
  // A transformation that was just applied, for who wants them again.
  template <size_t N>
  void record(std::string_view directive, const std::array<double, N>& values, bool replaces);

  void active_transform(const Location& where);
  void attribute_begin(const Location& w) { state_.push(SceneState::Nested::Attribute, w); }
  void attribute_end(const Location& w) { state_.pop(SceneState::Nested::Attribute, w); }
  void transform_begin(const Location& w) { state_.push(SceneState::Nested::Transform, w); }
  void transform_end(const Location& w) { state_.pop(SceneState::Nested::Transform, w); }
  void color_space(const Location& w) { state_.set_color_space(string_after("ColorSpace"), w); }
  void coordinate_system(const Location& w) {
    state_.define_coordinates(string_after("CoordinateSystem"), w);
  }
  void coord_sys_transform(const Location& w) {
    state_.use_coordinates(string_after("CoordSysTransform"), w);
  }
  void concat_transform(const Location& where);
  void transform(const Location& where);
  void identity(const Location& where) {
    state_.replace(dmat4(1.0), where);
    if (state_.keeps_steps()) state_.record_step("Identity", true);
  }
  void translate(const Location& where);
  void scale(const Location& where);
  void rotate(const Location& where);
  void look_at(const Location& where);
  void transform_times(const Location& where);
  void include(const Location& where);
  void import(const Location& where);
  void read_file(std::string_view directive, const Location& where);
  void layer_end(const Location& w) { state_.layer_end(w); }
  void medium_interface(const Location& where);
  void named_material(const Location& w) { state_.use_material(string_after("NamedMaterial"), w); }
  void object_begin(const Location& w) { state_.object_begin(string_after("ObjectBegin"), w); }
  void object_end(const Location& w) { state_.object_end(w); }
  void object_instance(const Location& w) {
    state_.object_instance(string_after("ObjectInstance"), w);
  }
  void option(const Location& where);
  void reverse_orientation(const Location&) { state_.reverse_orientation(); }
  void texture(const Location& where);
  void world_begin(const Location& w) { state_.world_begin(w); }
  void world_end(const Location& where);
  void surface_integrator(const Location& where);
  void old_ignored(const Location& where);

  SceneDescription& scene_;
  SceneState state_;
  std::vector<std::string>* log_;
  const Dialect* dialect_;      // null: old syntax is an error
  std::vector<OldSyntax> old_;  // found so far
  Location world_ended_;        // line 0: not yet
  std::vector<Source> open_;    // the files being read, the innermost last
  bool files_ = false;
};

// N numbers, in brackets or not.
template <size_t N>
std::array<double, N> Parser::numbers(std::string_view directive) {
  std::array<double, N> values;
  const bool bracket = tokens().peek().kind == TokenKind::Open;
  if (bracket) tokens().next();
  for (double& value : values) {
    const Token token = tokens().next();
    if (token.kind != TokenKind::Word || !parse_number(token.text, value))
      tokens().fail(token, std::string(directive) + " must be followed by " + std::to_string(N) +
                               " finite numbers");
  }
  if (!bracket) return values;
  const Token token = tokens().next();
  if (token.kind != TokenKind::Close)
    tokens().fail(
        token, std::string(directive) + ": expected ']' after " + std::to_string(N) + " numbers");
  return values;
}

// A transformation as it is written; doubles are read back as they were.
template <size_t N>
std::string step_text(std::string_view directive, const std::array<double, N>& values) {
  std::string text(directive);
  if (N == 16) text += " [";
  for (const double v : values) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), v).ptr;
    text.append(" ").append(buffer.data(), end);
  }
  return N == 16 ? text + " ]" : text;
}

template <size_t N>
void Parser::record(std::string_view directive, const std::array<double, N>& values,
                    bool replaces) {
  if (state_.keeps_steps()) state_.record_step(step_text(directive, values), replaces);
}

}  // namespace pssmlt
