// A word of the vocabulary as text of a scene.
#pragma once

#include <string>
#include <vector>

#include "tests/vocabulary/vocabulary.h"

namespace pssmlt::test {

// A list of parameters, cut into one declaration with its values each.
std::vector<std::string> declarations_of(const std::string& list);
// "type name", without quotes; "itself" of the plugin's own row.
std::string declaration_of(const Word& word);
std::string name_of(const std::string& declaration);
// The parameters, and after them what the plugin needs and they do not give.
std::string with_needed(const Word& word, const std::string& parameters);
// The directive that uses the word with these parameters: `Material "diffuse" ...`. Textures are
// named "t"; a medium is "m" and fills what follows.
std::string directive_of(const Word& word, const std::string& parameters);
// True if the word stands before WorldBegin.
bool is_option(const Word& word);

}  // namespace pssmlt::test
