// The parameter list that follows a directive: "type name" value, "type name" [ values ], ...
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/dialect.h"
#include "core/scene/tokenizer.h"

namespace pssmlt {

// Reads parameters as long as strings follow. Throws Error on an unknown type, a value of the wrong
// kind or number, a number that is not finite, and a name given twice. `old` collects what is in
// the types of older formats, which are errors if it is null.
ParameterSet read_parameters(Tokenizer& tokens,
                             const std::shared_ptr<const std::string>& color_space,
                             std::vector<OldSyntax>* old = nullptr);

// The type of this name in a scene file (aliases included), nullopt if there is none.
std::optional<ParameterType> parameter_type(std::string_view name);

// One value that is not a list, of a type that its spelling decides: "x" is a String, true a Bool,
// 1 an Integer, 1.5 a Float; of the given type if there is one.
Parameter read_single_value(Tokenizer& tokens, std::string name, std::optional<ParameterType> type);

}  // namespace pssmlt
