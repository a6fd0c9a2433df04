// Versions of what this program was built with.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pssmlt {

// "Embree" -> "3.13.5", ...
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace pssmlt
