#include "core/scene/parameter_list.h"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "core/color/color_space.h"
#include "core/scene/suggest.h"

namespace pssmlt {
namespace {

struct TypeName {
  std::string_view name;
  ParameterType type;
};

constexpr std::array<TypeName, 16> type_names = {{
    {"integer", ParameterType::Integer},
    {"float", ParameterType::Float},
    {"point2", ParameterType::Point2},
    {"vector2", ParameterType::Vector2},
    {"point3", ParameterType::Point3},
    {"point", ParameterType::Point3},
    {"vector3", ParameterType::Vector3},
    {"vector", ParameterType::Vector3},
    {"normal", ParameterType::Normal},
    {"normal3", ParameterType::Normal},
    {"bool", ParameterType::Bool},
    {"string", ParameterType::String},
    {"texture", ParameterType::Texture},
    {"spectrum", ParameterType::Spectrum},
    {"rgb", ParameterType::Rgb},
    {"blackbody", ParameterType::Blackbody},
}};

constexpr std::string_view spaces = " \t\n\r\f\v";

// A token as a message shows it: whole if it is short.
std::string shown(const Token& token) {
  if (token.kind == TokenKind::End) return "the end of the file";
  constexpr size_t longest = 40;
  std::string text(token.text.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  if (token.text.size() > longest) text += "...";
  return token.kind == TokenKind::String ? "the string \"" + text + "\"" : "'" + text + "'";
}

bool looks_infinite(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  std::string lower(text.substr(0, 4));
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return lower.starts_with("nan") || lower.starts_with("inf");
}

// Whether text is a number except for its size: digits with a sign, point or exponent.
bool looks_numeric(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos &&
         text.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
}

class ListReader {
 public:
  explicit ListReader(Tokenizer& tokens, std::vector<OldSyntax>* old = nullptr)
      : tokens_(tokens), old_(old) {}

  Parameter declaration();
  void values(Parameter& p, const Token& declared);
  void value(Parameter& p, const Token& token);

 private:
  void number(Parameter& p, const Token& token);
  void integer(Parameter& p, const Token& token);
  void boolean(Parameter& p, const Token& token);
  void fast_numbers(Parameter& p);
  void check_count(const Parameter& p, const Token& declared);
  [[noreturn]] void fail_value(const Parameter& p, const Token& token, const char* expected);

  Tokenizer& tokens_;
  std::vector<OldSyntax>* old_;  // null: old types are errors
};

std::string described(const Parameter& p) {
  return "parameter \"" + std::string(to_string(p.type)) + " " + p.name + "\"";
}

void ListReader::fail_value(const Parameter& p, const Token& token, const char* expected) {
  tokens_.fail(token, described(p) + ": expected " + expected + ", found " + shown(token));
}

// Colours in older formats; of "xyz" the components are still to be converted.
bool is_old_type(std::string_view name) { return name == "color" || name == "xyz"; }

ParameterType required_type(Tokenizer& tokens, const Token& token, std::string_view name,
                            bool old_types) {
  if (const auto type = parameter_type(name)) return *type;
  if (is_old_type(name) && old_types) return ParameterType::Rgb;
  if (is_old_type(name))
    tokens.fail(token, "parameter type \"" + std::string(name) +
                           "\" is pbrt-v3 syntax; use \"rgb\" or \"spectrum\"");
  std::vector<std::string> known;
  for (const TypeName& t : type_names) known.emplace_back(t.name);
  tokens.fail(token, "unknown parameter type \"" + std::string(name.substr(0, 40)) + "\"" +
                         suggestion(name, known));
}

void xyz_to_rgb(std::vector<float>& values) {
  for (size_t i = 0; i + 2 < values.size(); i += 3) {
    const dvec3 rgb = rec709_from_xyz() * dvec3(values[i], values[i + 1], values[i + 2]);
    for (int c = 0; c < 3; ++c) values[i + static_cast<size_t>(c)] = static_cast<float>(rgb[c]);
  }
}

Parameter ListReader::declaration() {
  const Token token = tokens_.next();
  const std::string text = tokens_.unescape(token);
  const size_t type_begin = std::min(text.find_first_not_of(spaces), text.size());
  const size_t type_end = std::min(text.find_first_of(spaces, type_begin), text.size());
  const size_t name_begin = std::min(text.find_first_not_of(spaces, type_end), text.size());
  const size_t name_end = std::min(text.find_first_of(spaces, name_begin), text.size());
  if (name_begin == name_end)
    tokens_.fail(token, "expected a parameter's \"type name\", found " + shown(token));
  if (text.find_first_not_of(spaces, name_end) != std::string::npos)
    tokens_.fail(token, "a parameter's name has no spaces: " + shown(token));
  Parameter p;
  const std::string_view type = std::string_view(text).substr(type_begin, type_end - type_begin);
  p.type = required_type(tokens_, token, type, old_ != nullptr);
  p.name = text.substr(name_begin, name_end - name_begin);
  p.where = tokens_.where(token);
  values(p, token);
  if (is_old_type(type)) old_->push_back({"type \"" + std::string(type) + "\"", p.where});
  if (type == "xyz") xyz_to_rgb(p.floats);
  return p;
}

// The fast path; anything else falls out of it and is read, or complained about, token by token.
void ListReader::fast_numbers(Parameter& p) {
  switch (p.type) {
    case ParameterType::Integer:
      tokens_.append_numbers(p.ints);
      break;
    case ParameterType::Bool:
    case ParameterType::String:
    case ParameterType::Texture:
      break;
    case ParameterType::Spectrum:
      if (p.strings.empty()) tokens_.append_numbers(p.floats);
      break;
    default:
      tokens_.append_numbers(p.floats);
  }
}

void ListReader::values(Parameter& p, const Token& declared) {
  Token token = tokens_.next();
  if (token.kind != TokenKind::Open) {
    if (token.kind == TokenKind::End)
      tokens_.fail(declared, described(p) + " has no value: the file ends here");
    value(p, token);
  } else {
    while (true) {
      fast_numbers(p);
      token = tokens_.next();
      if (token.kind == TokenKind::Close) break;
      if (token.kind == TokenKind::End)
        tokens_.fail(declared, described(p) + " does not end: ']' is missing");
      value(p, token);
    }
  }
  check_count(p, declared);
}

void ListReader::value(Parameter& p, const Token& token) {
  switch (p.type) {
    case ParameterType::Bool:
      return boolean(p, token);
    case ParameterType::Integer:
      return integer(p, token);
    case ParameterType::String:
    case ParameterType::Texture:
      if (token.kind != TokenKind::String) fail_value(p, token, "a string in quotes");
      p.strings.push_back(tokens_.unescape(token));
      return;
    case ParameterType::Spectrum:
      if (token.kind == TokenKind::String) {
        if (!p.floats.empty()) fail_value(p, token, "a number");
        p.strings.push_back(tokens_.unescape(token));
        return;
      }
      if (!p.strings.empty()) fail_value(p, token, "a string in quotes");
      return number(p, token);
    default:
      return number(p, token);
  }
}

void ListReader::number(Parameter& p, const Token& token) {
  if (token.kind != TokenKind::Word) fail_value(p, token, "a number");
  float value = 0.f;
  if (!parse_number(token.text, value)) {
    if (looks_infinite(token.text)) fail_value(p, token, "a finite number");
    double wide = 0.0;
    if (parse_number(token.text, wide) || looks_numeric(token.text))
      fail_value(p, token, "a number that single precision can hold");
    fail_value(p, token, "a number");
  }
  p.floats.push_back(value);
}

void ListReader::integer(Parameter& p, const Token& token) {
  int value = 0;
  if (token.kind != TokenKind::Word || !parse_number(token.text, value)) {
    const bool digits = token.kind == TokenKind::Word &&
                        token.text.find_first_not_of("0123456789+-") == std::string_view::npos;
    fail_value(p, token, digits ? "an integer of 32 bits" : "an integer");
  }
  p.ints.push_back(value);
}

void ListReader::boolean(Parameter& p, const Token& token) {
  const bool possible = token.kind == TokenKind::Word || token.kind == TokenKind::String;
  if (!possible || (token.text != "true" && token.text != "false"))
    fail_value(p, token, "true or false");
  p.bools.push_back(token.text == "true" ? 1 : 0);
}

void ListReader::check_count(const Parameter& p, const Token& declared) {
  size_t group = 1;
  switch (p.type) {
    case ParameterType::Point2:
    case ParameterType::Vector2:
      group = 2;
      break;
    case ParameterType::Point3:
    case ParameterType::Vector3:
    case ParameterType::Normal:
    case ParameterType::Rgb:
      group = 3;
      break;
    case ParameterType::Spectrum:
      group = 2;
      break;  // wavelength and value
    default:
      break;
  }
  if (p.floats.size() % group != 0)
    tokens_.fail(declared, described(p) + " has " + std::to_string(p.floats.size()) +
                               " numbers, which is not a multiple of " + std::to_string(group));
}

// Names seen in one list: compared one by one while they are few, hashed when they are many.
class NamesSeen {
 public:
  const Parameter* earlier(const ParameterSet& list, const std::string& name) {
    constexpr size_t few = 32;
    if (list.size() < few) {
      const auto found = std::ranges::find(list, name, &Parameter::name);
      return found == list.end() ? nullptr : &*found;
    }
    for (; hashed_ < list.size(); ++hashed_) names_.insert(list[hashed_].name);
    if (!names_.contains(name)) return nullptr;
    return &*std::ranges::find(list, name, &Parameter::name);
  }

 private:
  std::unordered_set<std::string> names_;
  size_t hashed_ = 0;
};

}  // namespace

std::optional<ParameterType> parameter_type(std::string_view name) {
  const auto found = std::ranges::find(type_names, name, &TypeName::name);
  return found == type_names.end() ? std::nullopt : std::optional(found->type);
}

ParameterSet read_parameters(Tokenizer& tokens,
                             const std::shared_ptr<const std::string>& color_space,
                             std::vector<OldSyntax>* old) {
  ParameterSet list;
  NamesSeen seen;
  ListReader reader(tokens, old);
  while (tokens.peek().kind == TokenKind::String) {
    Parameter p = reader.declaration();
    if (const Parameter* const first = seen.earlier(list, p.name))
      tokens.fail(p.where, "parameter \"" + p.name + "\" is given twice, first at " +
                               to_string(first->where));
    p.color_space = color_space;
    list.push_back(std::move(p));
  }
  return list;
}

Parameter read_single_value(Tokenizer& tokens, std::string name,
                            std::optional<ParameterType> type) {
  const Token token = tokens.next();
  Parameter p;
  p.name = std::move(name);
  p.where = tokens.where(token);
  int whole = 0;
  if (type)
    p.type = *type;
  else if (token.kind == TokenKind::String)
    p.type = ParameterType::String;
  else if (token.text == "true" || token.text == "false")
    p.type = ParameterType::Bool;
  else
    p.type = parse_number(token.text, whole) ? ParameterType::Integer : ParameterType::Float;
  ListReader(tokens).value(p, token);
  return p;
}

}  // namespace pssmlt
