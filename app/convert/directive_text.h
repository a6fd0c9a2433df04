// Directives and their parameters as text, indented by the blocks they stand in.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/description.h"

namespace pssmlt {

std::string in_quotes(std::string_view text);
// `"float radius" 1` or `"point3 P" [ ... ]`, lines broken at about 100 characters.
std::string parameter_text(const Parameter& p, int indent);

class DirectiveText {
 public:
  const std::string& text() const { return text_; }
  void blank() { text_ += "\n"; }
  void line(const std::string& content);
  void begin(const std::string& content);  // and indents what follows
  void end(const std::string& content);    // the colour space is again what it was at begin()
  // `head` and the parameters, after a ColorSpace that they need. Throws Error at `where` if they
  // need two.
  void directive(const std::string& head, const ParameterSet& parameters, const Location& where);
  void color_space(const std::string& name);
  // The transformation directives that led to this one, from the first.
  void steps(const std::shared_ptr<const TransformStep>& last);

 private:
  std::string text_, space_ = "srgb";
  std::vector<std::string> outer_spaces_;  // of the open blocks
};

}  // namespace pssmlt
