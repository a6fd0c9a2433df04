// What was clipped while colours were converted, collected for the log of the scene's building.
#pragma once

#include <string>
#include <vector>

namespace pssmlt {

// Adds a message; safe from any thread. Beyond a hundred, messages are only counted.
void add_color_warning(std::string message);

// The messages since the last call, in the order they came; the last one says how many were left
// out, if any were.
std::vector<std::string> take_color_warnings();

}  // namespace pssmlt
