#include "core/scene/parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/image/embedded_file.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

using enum ParameterType;

// Numbers of the value array that make one value of the type.
size_t components(ParameterType type) {
  switch (type) {
    case Point2:
    case Vector2:
      return 2;
    case Point3:
    case Vector3:
    case Normal:
    case ParameterType::Rgb:
      return 3;
    default:
      return 1;
  }
}

size_t count(const Parameter& p) {
  switch (p.type) {
    case Integer:
      return p.ints.size();
    case Bool:
      return p.bools.size();
    case String:
    case ParameterType::Texture:
      return p.strings.size();
    case Spectrum:
      return p.strings.empty() ? (p.floats.empty() ? 0 : 1) : p.strings.size();
    default:
      return p.floats.size() / components(p.type);
  }
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string shortest(float value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string shortest(const vec3& v) {
  return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z);
}

const Parameter* lookup(const ParameterSet* set, std::string_view name) {
  if (set == nullptr) return nullptr;
  const auto found = std::ranges::find(*set, name, &Parameter::name);
  return found == set->end() ? nullptr : &*found;
}

std::vector<std::string> to_strings(std::span<const std::string_view> views) {
  return {views.begin(), views.end()};
}

}  // namespace

std::string_view to_string(ParameterType type) {
  switch (type) {
    case Integer:
      return "integer";
    case Float:
      return "float";
    case Point2:
      return "point2";
    case Vector2:
      return "vector2";
    case Point3:
      return "point3";
    case Vector3:
      return "vector3";
    case Normal:
      return "normal";
    case Bool:
      return "bool";
    case String:
      return "string";
    case ParameterType::Texture:
      return "texture";
    case Spectrum:
      return "spectrum";
    case ParameterType::Rgb:
      return "rgb";
    case Blackbody:
      return "blackbody";
  }
  return "unknown";
}

Parameters::Parameters(const ParameterSet& set, Location where, std::string owner,
                       SceneResolver* resolver)
    : set_(&set), where_(std::move(where)), owner_(std::move(owner)), resolver_(resolver) {}

Parameters Parameters::describing(std::vector<ParameterDoc>& docs) {
  Parameters result;
  result.docs_ = &docs;
  return result;
}

const Parameter* Parameters::find(std::string_view name,
                                  std::initializer_list<ParameterType> accepted) {
  asked_.emplace_back(name);
  const Parameter* const p = lookup(set_, name);
  if (p == nullptr) return nullptr;
  p->was_read = true;
  if (std::ranges::find(accepted, p->type) != accepted.end()) return p;
  std::string wanted;
  for (const ParameterType type : accepted)
    wanted += (wanted.empty() ? "" : " or ") + in_quotes(to_string(type));
  fail_at(*p, "has type " + in_quotes(to_string(p->type)) + ", must be " + wanted);
}

const Parameter* Parameters::find_one(std::string_view name,
                                      std::initializer_list<ParameterType> accepted) {
  const Parameter* const p = find(name, accepted);
  if (p == nullptr) return nullptr;
  if (count(*p) != 1) fail_at(*p, "must have one value, has " + std::to_string(count(*p)));
  check_finite(*p);
  return p;
}

void Parameters::fail_at(const Parameter& p, const std::string& message) const {
  throw Error(p.where, "parameter " + in_quotes(p.name) + " of " + owner_ + " " + message);
}

void Parameters::check_finite(const Parameter& p) const {
  if (!std::ranges::all_of(p.floats, [](float f) { return std::isfinite(f); }))
    fail_at(p, "is not finite");
}

void Parameters::document(std::string_view name, std::string_view type, std::string fallback,
                          std::string_view unit, std::string_view doc) {
  if (docs_ == nullptr) return;
  // A parameter that is read in two ways is described by the first.
  if (std::ranges::find(*docs_, name, &ParameterDoc::name) != docs_->end()) return;
  docs_->push_back({std::string(name), std::string(type), std::move(fallback), std::string(unit),
                    std::string(doc)});
}

float Parameters::number(std::string_view name, float fallback, std::string_view unit,
                         std::string_view doc) {
  document(name, "float", shortest(fallback), unit, doc);
  const Parameter* const p = find_one(name, {Float});
  return p != nullptr ? p->floats[0] : fallback;
}

int Parameters::integer(std::string_view name, int fallback, std::string_view unit,
                        std::string_view doc) {
  document(name, "integer", std::to_string(fallback), unit, doc);
  const Parameter* const p = find_one(name, {Integer});
  return p != nullptr ? p->ints[0] : fallback;
}

bool Parameters::flag(std::string_view name, bool fallback, std::string_view doc) {
  document(name, "bool", fallback ? "true" : "false", "", doc);
  const Parameter* const p = find_one(name, {Bool});
  return p != nullptr ? p->bools[0] != 0 : fallback;
}

std::string Parameters::text(std::string_view name, std::string_view fallback,
                             std::string_view doc) {
  document(name, "string", in_quotes(fallback), "", doc);
  const Parameter* const p = find_one(name, {String});
  return p != nullptr ? p->strings[0] : std::string(fallback);
}

std::string Parameters::choice(std::string_view name, std::string_view fallback,
                               std::span<const std::string_view> choices, std::string_view doc) {
  std::string all;
  for (const std::string_view c : choices) all += (all.empty() ? "" : ", ") + in_quotes(c);
  document(name, "string: " + all, in_quotes(fallback), "", doc);
  const Parameter* const p = find_one(name, {String});
  if (p == nullptr) return std::string(fallback);
  const std::string& given = p->strings[0];
  if (std::ranges::find(choices, given) == choices.end())
    fail_at(*p, "is " + in_quotes(given) + ", must be one of " + all +
                    suggestion(given, to_strings(choices)));
  return given;
}

std::string Parameters::file(std::string_view name, std::string_view doc) {
  document(name, "string: file", "\"\"", "", doc);
  const Parameter* const p = find_one(name, {String});
  if (p == nullptr) return "";
  const std::string& given = p->strings[0];
  if (find_embedded_file(given)) return given;
  const std::string path = resolver_ != nullptr ? resolver_->resolve_path(given) : given;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    fail_at(*p, "names a file that does not exist: " + in_quotes(path));
  if (std::filesystem::is_directory(path, ignored))
    fail_at(*p, "names a directory, not a file: " + in_quotes(path));
  return path;
}

vec3 Parameters::point(std::string_view name, const vec3& fallback, std::string_view unit,
                       std::string_view doc) {
  document(name, "point3", shortest(fallback), unit, doc);
  const Parameter* const p = find_one(name, {Point3});
  return p != nullptr ? vec3(p->floats[0], p->floats[1], p->floats[2]) : fallback;
}

vec3 Parameters::vector(std::string_view name, const vec3& fallback, std::string_view doc) {
  document(name, "vector3", shortest(fallback), "", doc);
  const Parameter* const p = find_one(name, {Vector3});
  return p != nullptr ? vec3(p->floats[0], p->floats[1], p->floats[2]) : fallback;
}

std::vector<float> Parameters::numbers(std::string_view name, std::string_view unit,
                                       std::string_view doc) {
  document(name, "float[]", "", unit, doc);
  const Parameter* const p = find(name, {Float});
  if (p == nullptr) return {};
  check_finite(*p);
  return p->floats;
}

std::vector<int> Parameters::integers(std::string_view name, std::string_view unit,
                                      std::string_view doc) {
  document(name, "integer[]", "", unit, doc);
  const Parameter* const p = find(name, {Integer});
  return p != nullptr ? p->ints : std::vector<int>();
}

template <typename V>
std::vector<V> Parameters::tuples(std::string_view name, ParameterType type, std::string_view unit,
                                  std::string_view doc) {
  document(name, std::string(to_string(type)) + "[]", "", unit, doc);
  const Parameter* const p = find(name, {type});
  if (p == nullptr) return {};
  check_finite(*p);
  constexpr size_t n = V::length();
  if (p->floats.size() % n != 0)
    fail_at(*p, "must have a multiple of " + std::to_string(n) + " numbers, has " +
                    std::to_string(p->floats.size()));
  std::vector<V> result(p->floats.size() / n);
  for (size_t i = 0; i < p->floats.size(); ++i)
    result[i / n][static_cast<int>(i % n)] = p->floats[i];
  return result;
}

std::vector<vec2> Parameters::points2(std::string_view name, std::string_view unit,
                                      std::string_view doc) {
  return tuples<vec2>(name, Point2, unit, doc);
}

std::vector<vec3> Parameters::points3(std::string_view name, std::string_view unit,
                                      std::string_view doc) {
  return tuples<vec3>(name, Point3, unit, doc);
}

std::vector<vec3> Parameters::vectors3(std::string_view name, std::string_view doc) {
  return tuples<vec3>(name, Vector3, "", doc);
}

std::vector<vec3> Parameters::normals(std::string_view name, std::string_view doc) {
  return tuples<vec3>(name, Normal, "", doc);
}

std::vector<pssmlt::Rgb> Parameters::rgbs(std::string_view name, std::string_view unit,
                                          std::string_view doc) {
  return tuples<vec3>(name, ParameterType::Rgb, unit, doc);
}

std::vector<std::string> Parameters::texts(std::string_view name, std::string_view doc) {
  document(name, "string[]", "", "", doc);
  const Parameter* const p = find(name, {String});
  return p != nullptr ? p->strings : std::vector<std::string>();
}

bool Parameters::has(std::string_view name) const { return lookup(set_, name) != nullptr; }

std::optional<ParameterType> Parameters::type(std::string_view name) const {
  const Parameter* const p = lookup(set_, name);
  return p != nullptr ? std::optional(p->type) : std::nullopt;
}

void Parameters::check_all_read() const {
  if (set_ == nullptr) return;
  const auto unread = std::ranges::find(*set_, false, &Parameter::was_read);
  if (unread == set_->end()) return;
  const bool known = std::ranges::find(asked_, unread->name) != asked_.end();
  throw Error(unread->where, (known ? "unused parameter " : "unknown parameter ") +
                                 in_quotes(unread->name) + " of " + owner_ +
                                 suggestion(unread->name, asked_));
}

void Parameters::note(const std::string& message) const {
  if (resolver_ != nullptr) resolver_->note(owner_ + ": " + message);
}

void Parameters::fail(const std::string& message) const {
  throw Error(where_, owner_.empty() ? message : owner_ + ": " + message);
}

void Parameters::fail(std::string_view name, const std::string& message) const {
  const Parameter* const p = lookup(set_, name);
  throw Error(p != nullptr ? p->where : where_, owner_.empty() ? message : owner_ + ": " + message);
}

}  // namespace pssmlt
