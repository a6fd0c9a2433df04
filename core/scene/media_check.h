// Whether what surfaces say about the media around them fits together.
#pragma once

#include <string>

#include "core/scene/scene.h"

namespace pssmlt {

// Follows a few thousand rays from the camera from surface to surface. A warning that names two
// surfaces of which one says that another medium lies between them than the other does, if that is
// met by more than a hundredth of the rays; "" if not. What such a scene shows depends on the end
// that a path is followed from, so that techniques disagree. Always the same for the same scene.
std::string contradicting_media(const Scene& scene);

}  // namespace pssmlt
