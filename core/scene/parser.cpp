#include "core/scene/parser.h"

#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/scene/import.h"
#include "core/scene/parser_directives.h"
#include "core/scene/suggest.h"

namespace pssmlt {

// Include inside Include, deeper than any scene that is not recursive.
static constexpr size_t deepest_include = 256;

const std::array<Parser::Rule, 46>& Parser::rules() {
  using S = SceneState;
  using P = Parser;
  static const std::array<Rule, 46> table = {{
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
      {"Renderer", Where::Options, &P::old_ignored, nullptr},
      {"ReverseOrientation", Where::World, &P::reverse_orientation, nullptr},
      {"Rotate", Where::Anywhere, &P::rotate, nullptr},
      {"Sampler", Where::Options, nullptr, &S::sampler},
      {"Scale", Where::Anywhere, &P::scale, nullptr},
      {"Shape", Where::World, nullptr, &S::shape},
      {"SurfaceIntegrator", Where::Options, &P::surface_integrator, nullptr},
      {"Texture", Where::World, &P::texture, nullptr},
      {"Transform", Where::Anywhere, &P::transform, nullptr},
      {"TransformBegin", Where::Anywhere, &P::transform_begin, nullptr},
      {"TransformEnd", Where::Anywhere, &P::transform_end, nullptr},
      {"TransformTimes", Where::Options, &P::transform_times, nullptr},
      {"Translate", Where::Anywhere, &P::translate, nullptr},
      {"VolumeIntegrator", Where::Options, &P::old_ignored, nullptr},
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
    if (world_ended_.line != 0)
      fail(where, std::string(rule.name) + " after the WorldEnd at " + to_string(world_ended_) +
                      ": one file describes one picture");
    check_block(rule, where);
    if (rule.special != nullptr) {
      (this->*rule.special)(where);
    } else {
      std::string name = string_after(rule.name);
      // Names that a scene makes up are checked where they are kept; no area light is one too.
      const bool made_up = rule.name.starts_with("Make") || rule.name == "LayerBegin" ||
                           rule.name == "Attribute" || rule.name == "AreaLightSource";
      if (name.empty() && !made_up) name = instead_of_none(rule, where);
      (state_.*rule.plugin)(std::move(name), parameters(), where);
    }
  }
}

// Directives without a type are errors, but old formats have a material of that name: none.
std::string Parser::instead_of_none(const Rule& rule, const Location& where) {
  const std::string message = std::string(rule.name) + " needs a type, not \"\"";
  if (rule.name != "Material" || dialect_ == nullptr) fail(where, message);
  old_.push_back({message, where, false});
  return "none";
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
  if (dialect_ != nullptr) dialect_->translate(scene_, old_, log_);
  open_.pop_back();
}

// Syntax of older formats: an error unless there is a dialect that knows them.
void Parser::old_syntax(const std::string& what, const Location& where, const std::string& advice) {
  if (dialect_ == nullptr) fail(where, what + advice);
  old_.push_back({what, where});
}

void Parser::world_end(const Location& where) {
  old_syntax("WorldEnd", where,
             " is pbrt-v3 syntax: in pbrt-v4 the world ends with the file; remove it");
  if (state_.block() == Block::Options) fail(where, "WorldEnd without WorldBegin");
  world_ended_ = where;
}

void Parser::surface_integrator(const Location& where) {
  old_syntax("SurfaceIntegrator", where, " is pbrt-v2 syntax; use Integrator");
  std::string name = string_after("SurfaceIntegrator");
  state_.integrator(std::move(name), parameters(), where);
}

// What chose parts of the program that have no choice any more.
void Parser::old_ignored(const Location& where) {
  old_syntax("Renderer or VolumeIntegrator", where,
             " is pbrt-v2 syntax; Integrator alone says how to render");
  string_after("this directive");
  parameters();
}

ParameterSet Parser::parameters() {
  ParameterSet list =
      read_parameters(tokens(), state_.color_space(), dialect_ != nullptr ? &old_ : nullptr);
  for (Parameter& p : list)
    if (p.type == ParameterType::Texture)
      for (std::string& name : p.strings) name = state_.texture_name(name);
  return list;
}

std::string Parser::string_after(std::string_view directive) {
  const Token token = tokens().next();
  if (token.kind != TokenKind::String)
    tokens().fail(token, std::string(directive) + " must be followed by a string in quotes");
  return tokens().unescape(token);
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
  if (directive == "Import" && is_importable(path)) {
    const std::string label = path + "#" + std::to_string(scene_.files_read.size());
    return import_file({path, where, label, false}, state_, scene_, log_);
  }
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
  std::string value = string_after("Texture");
  if (value == "color" && dialect_ != nullptr) {
    old_syntax("Texture of \"color\"", where, "");
    value = "spectrum";
  }
  std::string type = string_after("Texture");
  state_.texture(std::move(name), value, std::move(type), parameters(), where);
}

SceneDescription parse_file(const std::string& path, std::vector<std::string>* log,
                            const ParseOptions& options) {
  if (is_importable(path)) return import_scene(path, log);
  const std::string text = read_text(path, {});
  SceneDescription scene;
  scene.file = path;
  scene.directory = std::filesystem::path(path).parent_path().string();
  std::error_code ignored;
  const std::string canonical = std::filesystem::weakly_canonical(path, ignored).string();
  Parser(scene, log, options).run(text, std::make_shared<const std::string>(path), true, canonical);
  return scene;
}

SceneDescription parse_string(std::string_view text, const std::string& name,
                              const std::string& directory, std::vector<std::string>* log,
                              const ParseOptions& options) {
  SceneDescription scene;
  scene.file = name;
  scene.directory = directory;
  Parser(scene, log, options)
      .run(text, std::make_shared<const std::string>(name), !directory.empty(), "");
  return scene;
}

}  // namespace pssmlt
