// Who cannot see the light that an oracle counts, and why.
#pragma once

#include <string>

#include "app/stress/case.h"
#include "core/scene/builder.h"

namespace pssmlt::stress {

// Why the scene's integrator finds nothing, or (`all`) not all, of the light of `classes`; "" if it
// does. Told from what it says that it sees.
std::string blindness(const BuiltScene& built, const std::string& classes, int max_depth, bool all);
// Why an integrator that sees the light in principle does not find it at this point; "" if it does.
std::string practical_blindness(const Point& point, const Layer& layer);

}  // namespace pssmlt::stress
