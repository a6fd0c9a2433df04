// Lets one thread listen to the rays of its own samples: what `--pixel` prints and what benchmarks
// replay.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/ray.h"

namespace pssmlt {

// Called with one line for every ray and connection of this thread; an empty function ends it.
void set_path_log(std::function<void(const std::string&)> listener);

// A ray as it was traced.
struct RecordedRay {
  Ray ray;
  bool shadow = false;
};
// Appends every ray of this thread to `rays` until called with null.
void record_rays(std::vector<RecordedRay>* rays);

}  // namespace pssmlt
