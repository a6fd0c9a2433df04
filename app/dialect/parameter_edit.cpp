#include "app/dialect/parameter_edit.h"

#include <algorithm>
#include <utility>

namespace pssmlt::v3 {
namespace {

Parameter made(ParameterType type, std::string name, const Location& where) {
  Parameter p;
  p.type = type;
  p.name = std::move(name);
  p.where = where;
  return p;
}

[[noreturn]] void refuse(const Parameter& p, std::string_view wanted) {
  throw Error(p.where,
              "parameter \"" + p.name + "\" must be one value of type " + std::string(wanted));
}

}  // namespace

Parameter* find(ParameterSet& set, std::string_view name) {
  const auto found = std::ranges::find(set, name, &Parameter::name);
  return found == set.end() ? nullptr : &*found;
}

bool has(const ParameterSet& set, std::string_view name) {
  return std::ranges::find(set, name, &Parameter::name) != set.end();
}

std::optional<Parameter> take(ParameterSet& set, std::string_view name) {
  const auto found = std::ranges::find(set, name, &Parameter::name);
  if (found == set.end()) return std::nullopt;
  Parameter p = std::move(*found);
  set.erase(found);
  return p;
}

void rename(ParameterSet& set, std::string_view from, std::string_view to) {
  if (Parameter* const p = find(set, from)) p->name = to;
}

void put(ParameterSet& set, Parameter parameter) {
  std::erase_if(set, [&](const Parameter& p) { return p.name == parameter.name; });
  set.push_back(std::move(parameter));
}

Parameter number(std::string name, float value, const Location& where) {
  Parameter p = made(ParameterType::Float, std::move(name), where);
  p.floats = {value};
  return p;
}

Parameter integer(std::string name, int value, const Location& where) {
  Parameter p = made(ParameterType::Integer, std::move(name), where);
  p.ints = {value};
  return p;
}

Parameter flag(std::string name, bool value, const Location& where) {
  Parameter p = made(ParameterType::Bool, std::move(name), where);
  p.bools = {static_cast<uint8_t>(value ? 1 : 0)};
  return p;
}

Parameter text(std::string name, std::vector<std::string> values, const Location& where) {
  Parameter p = made(ParameterType::String, std::move(name), where);
  p.strings = std::move(values);
  return p;
}

Parameter colour(std::string name, const Rgb& value, const Location& where) {
  Parameter p = made(ParameterType::Rgb, std::move(name), where);
  p.floats = {value.x, value.y, value.z};
  return p;
}

Parameter texture(std::string name, std::string texture, const Location& where) {
  Parameter p = made(ParameterType::Texture, std::move(name), where);
  p.strings = {std::move(texture)};
  return p;
}

Parameter renamed(Parameter parameter, std::string name) {
  parameter.name = std::move(name);
  return parameter;
}

float take_number(ParameterSet& set, std::string_view name, float fallback) {
  const auto p = take(set, name);
  if (!p) return fallback;
  if (p->type != ParameterType::Float || p->floats.size() != 1) refuse(*p, "float");
  return p->floats[0];
}

int take_integer(ParameterSet& set, std::string_view name, int fallback) {
  const auto p = take(set, name);
  if (!p) return fallback;
  if (p->type != ParameterType::Integer || p->ints.size() != 1) refuse(*p, "integer");
  return p->ints[0];
}

bool take_flag(ParameterSet& set, std::string_view name, bool fallback) {
  const auto p = take(set, name);
  if (!p) return fallback;
  if (p->type != ParameterType::Bool || p->bools.size() != 1) refuse(*p, "bool");
  return p->bools[0] != 0;
}

std::string take_text(ParameterSet& set, std::string_view name, const std::string& fallback) {
  const auto p = take(set, name);
  if (!p) return fallback;
  if (p->type != ParameterType::String || p->strings.size() != 1) refuse(*p, "string");
  return p->strings[0];
}

std::optional<Rgb> constant(const Parameter& p) {
  if (p.type == ParameterType::Float && p.floats.size() == 1) return Rgb(p.floats[0]);
  if (p.type == ParameterType::Rgb && p.floats.size() == 3)
    return Rgb(p.floats[0], p.floats[1], p.floats[2]);
  return std::nullopt;
}

std::optional<float> constant_luminance(const Parameter& p) {
  const auto c = constant(p);
  if (!c) return std::nullopt;
  // The weights of a grey value do not add up to 1 to the last bit.
  return c->x == c->y && c->y == c->z ? c->x : luminance(*c);
}

}  // namespace pssmlt::v3
