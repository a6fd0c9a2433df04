// pbrt-v3's format, translated to today's. A scene is known to be in it by its syntax or by names
// that only v3 had; then v3's defaults hold as well. What each name becomes: docs/pbrt-v3.md.
#pragma once

#include "core/scene/dialect.h"

namespace pssmlt {

const Dialect& pbrt_v3();

}  // namespace pssmlt
