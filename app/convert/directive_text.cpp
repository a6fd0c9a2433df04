#include "app/convert/directive_text.h"

#include <fmt/format.h>

#include <vector>

namespace pssmlt {
namespace {

constexpr int indent_width = 2, line_width = 100;

// The values, cut into as many as a line may break between.
std::vector<std::string> values(const Parameter& p) {
  std::vector<std::string> texts;
  for (const int v : p.ints) texts.push_back(std::to_string(v));
  for (const float v : p.floats) texts.push_back(fmt::format("{}", v));  // the shortest that is v
  for (const std::string& v : p.strings) texts.push_back(in_quotes(v));
  for (const uint8_t v : p.bools) texts.emplace_back(v != 0 ? "true" : "false");
  return texts;
}

const std::string* space_of(const ParameterSet& parameters, const Location& where) {
  static const std::string rec709 = "srgb";
  const std::string* found = nullptr;
  for (const Parameter& p : parameters) {
    if (p.type != ParameterType::Rgb) continue;
    const std::string* const space = p.color_space ? p.color_space.get() : &rec709;
    if (found != nullptr && *found != *space)
      throw Error(where, "colours in two colour spaces (" + *found + ", " + *space +
                             ") stand in one directive, by Attribute: this cannot be written");
    found = space;
  }
  return found;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::string_view values = "\b\f\n\r\t\\\"", names = "bfnrt\\\"";
  std::string result = "\"";
  for (const char c : text) {
    const size_t which = values.find(c);
    if (which == std::string_view::npos)
      result += c;
    else
      result.append("\\").append(1, names[which]);
  }
  return result + "\"";
}

std::string parameter_text(const Parameter& p, int indent) {
  std::string text = in_quotes(std::string(to_string(p.type)) + " " + p.name);
  const std::vector<std::string> all = values(p);
  if (all.size() == 1) return text + " " + all[0];
  text += " [";
  size_t line_start = 0;
  for (const std::string& value : all) {
    if (text.size() - line_start + value.size() + static_cast<size_t>(indent) > line_width) {
      text += "\n" + std::string(static_cast<size_t>(indent), ' ');
      line_start = text.size();
    }
    text += " " + value;
  }
  return text + " ]";
}

void DirectiveText::line(const std::string& content) {
  text_.append(outer_spaces_.size() * indent_width, ' ').append(content).append("\n");
}

void DirectiveText::begin(const std::string& content) {
  line(content);
  outer_spaces_.push_back(space_);
}

void DirectiveText::end(const std::string& content) {
  space_ = outer_spaces_.back();
  outer_spaces_.pop_back();
  line(content);
}

void DirectiveText::color_space(const std::string& name) {
  if (name == space_) return;
  line("ColorSpace " + in_quotes(name));
  space_ = name;
}

void DirectiveText::directive(const std::string& head, const ParameterSet& parameters,
                              const Location& where) {
  if (const std::string* const space = space_of(parameters, where)) color_space(*space);
  const int inner = (static_cast<int>(outer_spaces_.size()) + 2) * indent_width;
  std::string text = head;
  size_t length = head.size();
  for (const Parameter& p : parameters) {
    const std::string one = parameter_text(p, inner);
    const bool fits = length + one.size() + 2 < line_width && one.find('\n') == std::string::npos;
    text += fits ? " " : "\n" + std::string(static_cast<size_t>(inner), ' ');
    length = fits ? length + 1 + one.size() : one.size();
    text += one;
  }
  line(text);
}

void DirectiveText::steps(const std::shared_ptr<const TransformStep>& last) {
  std::vector<const TransformStep*> all;
  for (const TransformStep* s = last.get(); s != nullptr; s = s->before.get()) all.push_back(s);
  std::array<bool, 2> active{true, true};
  for (auto step = all.rbegin(); step != all.rend(); ++step) {
    if ((*step)->active != active) {
      active = (*step)->active;
      line(std::string("ActiveTransform ") + (!active[1]   ? "StartTime"
                                              : !active[0] ? "EndTime"
                                                           : "All"));
    }
    line((*step)->text);
  }
  if (active != std::array{true, true}) line("ActiveTransform All");
}

}  // namespace pssmlt
