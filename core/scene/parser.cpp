#include "core/scene/parser.h"

#include <array>
#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/scene/parameter_list.h"
#include "core/scene/scene_state.h"
#include "core/scene/suggest.h"
#include "core/scene/tokenizer.h"

namespace pssmlt {
namespace {

// Include inside Include, deeper than any scene that is not recursive.
constexpr size_t deepest_include = 256;

enum class Where : uint8_t { Anywhere, Options, World };

class Parser {
 public:
  Parser(SceneDescription& scene, std::vector<std::string>* log)
      : scene_(scene),
        state_(
            scene,
            [this](const Location& where, const std::string& message) { fail(where, message); },
            log) {}

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
  static const std::array<Rule, 43>& rules();

  struct Source {
    Tokenizer* tokens;
    std::string canonical;
  };

  [[noreturn]] void fail(const Location& where, const std::string& message) const;
  const Rule& find_rule(const Token& token) const;
  void check_block(const Rule& rule, const Location& where) const;
  void directives(Tokenizer& tokens);
  Tokenizer& tokens() { return *open_.back().tokens; }
  ParameterSet parameters() { return read_parameters(tokens(), state_.color_space()); }
  std::string string_after(std::string_view directive);
  template <size_t N>
  std::array<double, N> numbers(std::string_view directive);

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
  void identity(const Location& where) { state_.replace(dmat4(1.0), where); }
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
  void world_end(const Location& where) {
    fail(where, "WorldEnd is pbrt-v3 syntax: in pbrt-v4 the world ends with the file; remove it");
  }

  SceneDescription& scene_;
  SceneState state_;
  std::vector<Source> open_;  // the files being read, the innermost last
  bool files_ = false;
};

const std::array<Parser::Rule, 43>& Parser::rules() {
  using S = SceneState;
  using P = Parser;
  static const std::array<Rule, 43> table = {{
      {"Accelerator", Where::Options, nullptr, &S::accelerator},
      {"ActiveTransform", Where::Anywhere, &P::active_transform, nullptr},
      {"AreaLightSource", Where::World, nullptr, &S::area_light},
      {"Attribute", Where::Anywhere, nullptr, &S::attribute},
      {"AttributeBegin", Where::World, &P::attribute_begin, nullptr},
      {"AttributeEnd", Where::World, &P::attribute_end, nullptr},
      {"Camera", Where::Options, nullptr, &S::camera},
      {"ColorSpace", Where::Anywhere, &P::color_space, nullptr},
      {"ConcatTransform", Where::Anywhere, &P::concat_transform, nullptr},
      {"CoordSysTransform", Where::Anywhere, &P::coord_sys_transform, nullptr},
      {"CoordinateSystem", Where::Anywhere, &P::coordinate_system, nullptr},
      {"Film", Where::Options, nullptr, &S::film},
      {"Identity", Where::Anywhere, &P::identity, nullptr},
      {"Import", Where::World, &P::import, nullptr},
      {"Include", Where::Anywhere, &P::include, nullptr},
      {"Integrator", Where::Options, nullptr, &S::integrator},
      {"LayerBegin", Where::Options, nullptr, &S::layer_begin},
      {"LayerEnd", Where::Options, &P::layer_end, nullptr},
      {"LightSource", Where::World, nullptr, &S::light},
      {"LookAt", Where::Anywhere, &P::look_at, nullptr},
      {"MakeNamedMaterial", Where::World, nullptr, &S::named_material},
      {"MakeNamedMedium", Where::Anywhere, nullptr, &S::named_medium},
      {"Material", Where::World, nullptr, &S::material},
      {"MediumInterface", Where::Anywhere, &P::medium_interface, nullptr},
      {"NamedMaterial", Where::World, &P::named_material, nullptr},
      {"ObjectBegin", Where::World, &P::object_begin, nullptr},
      {"ObjectEnd", Where::World, &P::object_end, nullptr},
      {"ObjectInstance", Where::World, &P::object_instance, nullptr},
      {"Option", Where::Anywhere, &P::option, nullptr},
      {"PixelFilter", Where::Options, nullptr, &S::filter},
      {"ReverseOrientation", Where::World, &P::reverse_orientation, nullptr},
      {"Rotate", Where::Anywhere, &P::rotate, nullptr},
      {"Sampler", Where::Options, nullptr, &S::sampler},
      {"Scale", Where::Anywhere, &P::scale, nullptr},
      {"Shape", Where::World, nullptr, &S::shape},
      {"Texture", Where::World, &P::texture, nullptr},
      {"Transform", Where::Anywhere, &P::transform, nullptr},
      {"TransformBegin", Where::Anywhere, &P::transform_begin, nullptr},
      {"TransformEnd", Where::Anywhere, &P::transform_end, nullptr},
      {"TransformTimes", Where::Options, &P::transform_times, nullptr},
      {"Translate", Where::Anywhere, &P::translate, nullptr},
      {"WorldBegin", Where::Options, &P::world_begin, nullptr},
      {"WorldEnd", Where::Anywhere, &P::world_end, nullptr},
  }};
  return table;
}

// Quotes the line from the text that is open, or from the file if that is closed already.
void Parser::fail(const Location& where, const std::string& message) const {
  for (const Source& source : open_)
    if (source.tokens->name() == where.file) source.tokens->fail(where, message);
  throw Error(where, message);
}

const Parser::Rule& Parser::find_rule(const Token& token) const {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const Rule*> map;
    for (const Rule& rule : rules()) map.emplace(rule.name, &rule);
    return map;
  }();
  const auto found = by_name.find(token.text);
  if (found != by_name.end() && token.kind == TokenKind::Word) return *found->second;
  const Tokenizer& tokens = *open_.back().tokens;
  std::vector<std::string> known;
  for (const Rule& rule : rules()) known.emplace_back(rule.name);
  const std::string text(token.text.substr(0, 40));
  if (token.kind == TokenKind::Word)
    tokens.fail(token, "unknown directive '" + text + "'" + suggestion(text, known));
  tokens.fail(token, "expected a directive, found " +
                         (token.kind == TokenKind::String ? "\"" + text + "\"" : "'" + text + "'"));
}

void Parser::check_block(const Rule& rule, const Location& where) const {
  const std::string name(rule.name);
  if (rule.where == Where::Options && state_.block() == Block::World)
    fail(where, name + " must come before WorldBegin");
  if (rule.where == Where::World && state_.block() == Block::Options)
    fail(where, name + " must come after WorldBegin");
  const bool of_layer = name == "Sampler" || name == "Integrator" || name == "LayerEnd" ||
                        name == "WorldBegin";  // which complains about the open layer itself
  if (state_.in_layer() && !of_layer)
    fail(where,
         name + " between LayerBegin and LayerEnd: only Sampler and Integrator may be there");
}

void Parser::directives(Tokenizer& tokens) {
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    const Rule& rule = find_rule(token);
    const Location where = tokens.where(token);
    check_block(rule, where);
    if (rule.special != nullptr) {
      (this->*rule.special)(where);
    } else {
      std::string name = string_after(rule.name);
      // Names that a scene makes up are checked where they are kept.
      const bool made_up =
          rule.name.starts_with("Make") || rule.name == "LayerBegin" || rule.name == "Attribute";
      if (name.empty() && !made_up) fail(where, std::string(rule.name) + " needs a type, not \"\"");
      (state_.*rule.plugin)(std::move(name), parameters(), where);
    }
  }
}

void Parser::run(std::string_view text, std::shared_ptr<const std::string> name, bool files,
                 std::string canonical) {
  files_ = files;
  scene_.files_read.push_back(*name);
  hash_text(scene_.hash, text);
  Tokenizer tokenizer(text, std::move(name));
  open_.push_back({&tokenizer, std::move(canonical)});
  directives(tokenizer);
  state_.finish(tokenizer.where(tokenizer.peek()));
  open_.pop_back();
}

std::string Parser::string_after(std::string_view directive) {
  const Token token = tokens().next();
  if (token.kind != TokenKind::String)
    tokens().fail(token, std::string(directive) + " must be followed by a string in quotes");
  return tokens().unescape(token);
}

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

void Parser::active_transform(const Location&) {
  const Token token = tokens().next();
  if (token.text == "All")
    state_.activate(true, true);
  else if (token.text == "StartTime")
    state_.activate(true, false);
  else if (token.text == "EndTime")
    state_.activate(false, true);
  else
    tokens().fail(token, "ActiveTransform must be followed by All, StartTime or EndTime");
}

// The file lists the matrix column by column, which is how glm stores it.
dmat4 to_matrix(const std::array<double, 16>& values) {
  dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = values[static_cast<size_t>(i)];
  return m;
}

void Parser::concat_transform(const Location& where) {
  state_.concatenate(to_matrix(numbers<16>("ConcatTransform")), where);
}

void Parser::transform(const Location& where) {
  state_.replace(to_matrix(numbers<16>("Transform")), where);
}

void Parser::translate(const Location& where) {
  const auto v = numbers<3>("Translate");
  state_.concatenate(Transform::translate({v[0], v[1], v[2]}), where);
}

void Parser::scale(const Location& where) {
  const auto v = numbers<3>("Scale");
  state_.concatenate(Transform::scale({v[0], v[1], v[2]}), where);
}

void Parser::rotate(const Location& where) {
  const auto v = numbers<4>("Rotate");
  if (v[1] == 0.0 && v[2] == 0.0 && v[3] == 0.0) fail(where, "Rotate about an axis of length 0");
  state_.concatenate(Transform::rotate(v[0], {v[1], v[2], v[3]}), where);
}

void Parser::look_at(const Location& where) {
  const auto v = numbers<9>("LookAt");
  const dmat4 m = Transform::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!Transform::is_invertible(m))
    fail(where, "LookAt is singular: eye and target coincide, or up is along the view");
  state_.concatenate(Transform(m), where);
}

void Parser::transform_times(const Location& where) {
  const auto v = numbers<2>("TransformTimes");
  state_.transform_times(static_cast<float>(v[0]), static_cast<float>(v[1]), where);
}

void Parser::include(const Location& where) { read_file("Include", where); }

void Parser::import(const Location& where) {
  SceneState::Import scope(state_);
  read_file("Import", where);
  scope.finish();
}

void Parser::read_file(std::string_view directive, const Location& where) {
  const std::string named = string_after(directive);
  if (!files_)
    fail(where,
         std::string(directive) + " is not possible here: the scene is not read from a file");
  const std::string path = (std::filesystem::path(scene_.directory) / named).string();
  std::error_code ignored;
  const std::string canonical = std::filesystem::weakly_canonical(path, ignored).string();
  for (const Source& source : open_)
    if (source.canonical == canonical)
      fail(where, std::string(directive) + " of '" + path + "', which is being read already");
  if (open_.size() >= deepest_include)
    fail(where, std::string(directive) + ": files are nested too deeply");
  const std::string text = read_text(path, where);
  scene_.files_read.push_back(path);
  hash_text(scene_.hash, text);
  Tokenizer tokenizer(text, std::make_shared<const std::string>(path));
  open_.push_back({&tokenizer, canonical});
  directives(tokenizer);
  open_.pop_back();
}

void Parser::medium_interface(const Location& where) {
  std::string inside = string_after("MediumInterface");
  const bool two = tokens().peek().kind == TokenKind::String;
  std::string outside = two ? string_after("MediumInterface") : inside;
  state_.medium_interface(std::move(inside), std::move(outside), where);
}

// Option "name" value; as in a parameter, the name may have a type before it. Capitals, '-' and
// '_' of the name do not count, as in pbrt.
void Parser::option(const Location& where) {
  const std::string declared = string_after("Option");
  const size_t space = declared.find(' ');
  std::optional<ParameterType> type;
  if (space != std::string::npos) {
    type = parameter_type(declared.substr(0, space));
    if (!type) fail(where, "Option has the unknown type \"" + declared.substr(0, space) + "\"");
  }
  std::string name;
  for (const char c : declared.substr(space == std::string::npos ? 0 : space + 1))
    if (c != '-' && c != '_') name += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  Parameter option = read_single_value(tokens(), std::move(name), type);
  option.where = where;
  state_.option(std::move(option));
}

void Parser::texture(const Location& where) {
  std::string name = string_after("Texture");
  const std::string value = string_after("Texture");
  std::string type = string_after("Texture");
  state_.texture(std::move(name), value, std::move(type), parameters(), where);
}

}  // namespace

SceneDescription parse_file(const std::string& path, std::vector<std::string>* log) {
  const std::string text = read_text(path, {});
  SceneDescription scene;
  scene.file = path;
  scene.directory = std::filesystem::path(path).parent_path().string();
  std::error_code ignored;
  const std::string canonical = std::filesystem::weakly_canonical(path, ignored).string();
  Parser(scene, log).run(text, std::make_shared<const std::string>(path), true, canonical);
  return scene;
}

SceneDescription parse_string(std::string_view text, const std::string& name,
                              const std::string& directory, std::vector<std::string>* log) {
  SceneDescription scene;
  scene.file = name;
  scene.directory = directory;
  Parser(scene, log).run(text, std::make_shared<const std::string>(name), !directory.empty(), "");
  return scene;
}

}  // namespace pssmlt
