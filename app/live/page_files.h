// The live page's files, from app/live/page/, compiled in by app/live/page.cmake.
#pragma once

#include <vector>

#include "app/live/live.h"

namespace pssmlt {

std::vector<LiveFile> live_page_files();

}  // namespace pssmlt
