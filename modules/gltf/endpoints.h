// Cameras and lights as directives.
#pragma once

#include <optional>

#include "core/scene/import.h"
#include "core/shape.h"
#include "modules/gltf/nodes.h"

namespace pssmlt::gltf {

// Film and camera of a scene that is this file: the first camera of the tree, or one that sees all
// of `bounds`.
void declare_camera(const Document& document, const ImportTarget& target,
                    const std::vector<PlacedNode>& nodes, const Bounds& bounds);
// Lights of KHR_lights_punctual; their number.
int declare_lights(const Document& document, const ImportTarget& target,
                   const std::vector<PlacedNode>& nodes);
// Names of all cameras of the tree, in its order.
std::vector<std::string> camera_names(const Document& document,
                                      const std::vector<PlacedNode>& nodes);

}  // namespace pssmlt::gltf
