// "Did you mean": the nearest of a list of known names to one that is not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pssmlt {

// " (did you mean 'x'?)" for the candidate that differs from `wrong` by the fewest edits
// (insertion, deletion, substitution, swap of neighbours; case counts little), "" if none is near.
std::string suggestion(std::string_view wrong, std::span<const std::string> candidates);

}  // namespace pssmlt
