// Lets one thread listen to the rays of its own samples: what `--pixel` prints.
#pragma once

#include <functional>
#include <string>

namespace pssmlt {

// Called with one line for every ray and connection of this thread; an empty function ends it.
void set_path_log(std::function<void(const std::string&)> listener);

}  // namespace pssmlt
